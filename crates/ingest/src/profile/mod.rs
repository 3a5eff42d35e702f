//! Device profiles: what a device writes on its card, declared and never guessed.

mod axes;
mod check;
mod images;
mod layout;

pub use axes::Axis;
pub use images::{ImageTime, Images};
pub use layout::{
    AccelerationColumns, Endian, HeaderField, PacketLayout, RangeColumns, SampleOrder, Scalar, TimeColumn, TimeUnit,
};

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::config::{self, ConfigError};
use crate::devices::{self, Shelf};

/// The version of the profile file that this program reads.
const PROFILE_SCHEMA_VERSION: u32 = 1;

const SHELF: Shelf = Shelf {
    kind: "device profile",
    built_in: &[
        ("aim2-packets", include_str!("../../profiles/aim2-packets.toml")),
        ("csv", include_str!("../../profiles/csv.toml")),
    ],
    marks: &["acceleration", "range", "images"],
};

/// A device profile. `docs/devices.md` describes every key.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Profile {
    /// Version of this layout: 1.
    pub schema_version: u32,
    /// Name, for people.
    pub name: String,
    /// Version of this profile; a changed profile should have another.
    pub version: String,
    /// Camera pitch minus sensor pitch, degrees.
    pub mount_pitch_deg: f64,
    /// The accelerometer, if the device has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub acceleration: Option<AccelerationStream>,
    /// The range sensor, if the device has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub range: Option<RangeStream>,
    /// The camera's files, if the device has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub images: Option<Images>,
}

/// The accelerometer's files. Exactly one of `packets` and `csv`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AccelerationStream {
    /// Patterns relative to the card; `*` stays within a folder, `**` does not.
    pub files: Vec<String>,
    /// Nominal sample rate, Hz. Packets: the step between a packet's samples is its inverse.
    pub rate_hz: f64,
    /// Counts to g.
    pub g_per_count: f64,
    /// Counts at 0 g, per sensor axis.
    #[serde(default)]
    pub zero_g_counts: [f64; 3],
    /// Device right, down, forward as sensor axes.
    pub axes: [Axis; 3],
    /// Binary packets.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub packets: Option<PacketLayout>,
    /// Columns of a CSV file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub csv: Option<AccelerationColumns>,
}

/// The range sensor's files. Exactly one of `packets` and `csv`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RangeStream {
    /// Patterns relative to the card; `*` stays within a folder, `**` does not.
    pub files: Vec<String>,
    /// Nominal sample rate, Hz. Packets: the step between a packet's samples is its inverse.
    pub rate_hz: f64,
    /// Counts to mm.
    pub mm_per_count: f64,
    /// Binary packets.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub packets: Option<PacketLayout>,
    /// Columns of a CSV file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub csv: Option<RangeColumns>,
}

impl Profile {
    /// The profile of that name: `devices_dir/NAME.toml` if there is one, else the built-in one. A name that ends in
    /// `.toml` is a path, relative to `devices_dir`. The folder need not exist.
    ///
    /// # Errors
    /// [`ConfigError`]: [`UnknownName`](ConfigError::UnknownName) lists the names that exist; the others say what is
    /// wrong with the file.
    pub fn load(name_or_path: &str, devices_dir: &Path) -> Result<Self, ConfigError> {
        let (path, profile): (_, Self) = devices::find(&SHELF, name_or_path, devices_dir)?;
        profile.check(&path).map(|()| profile)
    }

    /// The profile in a file.
    ///
    /// # Errors
    /// [`ConfigError`] when the file cannot be read or contradicts itself.
    pub fn read_file(path: &Path) -> Result<Self, ConfigError> {
        let profile: Self = config::read_toml(path)?;
        profile.check(path).map(|()| profile)
    }

    /// Whether the values make sense together. [`Self::load`] and [`Self::read_file`] have done so. `path` is only for
    /// messages.
    ///
    /// # Errors
    /// [`ConfigError::Invalid`] with the first key that does not.
    pub fn check(&self, path: &Path) -> Result<(), ConfigError> {
        check::check(self).map_err(|wrong| ConfigError::Invalid {
            path: path.to_owned(),
            key: wrong.key,
            fact: wrong.fact,
            remedy: wrong.remedy.to_owned(),
        })
    }
}
