//! Device profiles: what a device writes on its card, declared and never guessed.

mod axes;
mod check;
mod check_sensors;
mod clock;
mod csv;
mod images;
mod layout;
mod no_target;

pub use axes::Axis;
pub use clock::{Anchor, ClockSpec, Epoch, TimeUnit};
pub use csv::{AccelerationColumns, CsvFormat, RangeColumns, RowTime};
pub use images::{ImageTime, Images};
pub use layout::{Endian, HeaderField, PacketLayout, PacketStamp, SampleOrder, Scalar, StampAt, Step};
pub use no_target::NoTarget;

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
        ("axivity-cwa", include_str!("../../profiles/axivity-cwa.toml")),
        ("pupil-neon", include_str!("../../profiles/pupil-neon.toml")),
        ("pupil-invisible", include_str!("../../profiles/pupil-invisible.toml")),
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
    /// When boot-relative clocks were zero.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub clock: Option<ClockSpec>,
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

/// The accelerometer's files. Exactly one of `packets`, `csv` and `cwa`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AccelerationStream {
    /// Patterns relative to the card; `*` stays within a folder, `**` does not.
    pub files: Vec<String>,
    /// Nominal sample rate, Hz.
    pub rate_hz: f64,
    /// Longer steps between samples are gaps, s; [`Profile::gap_s`] where it is not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gap_s: Option<f64>,
    /// Counts to g.
    pub g_per_count: f64,
    /// Counts at 0 g, per sensor axis.
    #[serde(default)]
    pub zero_g_counts: [f64; 3],
    /// The sensor's full scale in g, such as 2 for a sensor set to +-2 g; readings far beyond it are none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub full_scale_g: Option<f64>,
    /// Device right, down, forward as sensor axes.
    pub axes: [Axis; 3],
    /// Other channels, or columns, that are carried along.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<String>,
    /// Binary packets.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub packets: Option<PacketLayout>,
    /// Columns of a CSV file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub csv: Option<AccelerationColumns>,
    /// Axivity CWA files, which describe themselves.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cwa: Option<CwaFiles>,
}

/// Axivity CWA files (AX3, AX6). Their times are wall-clock times in the study's zone; samples are in g; the gyroscope's
/// channels are carried along as `gyro_x`, `gyro_y`, `gyro_z` where they are named in `extra`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CwaFiles {
    /// The time that the device's clock shows: [`Epoch::Unix`] where it was set to UTC, else [`Epoch::LocalAtStart`].
    pub epoch: Epoch,
}

/// The range sensor's files. Exactly one of `packets` and `csv`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RangeStream {
    /// Patterns relative to the card; `*` stays within a folder, `**` does not.
    pub files: Vec<String>,
    /// Nominal sample rate, Hz.
    pub rate_hz: f64,
    /// Longer steps between samples are gaps, s; [`Profile::gap_s`] where it is not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gap_s: Option<f64>,
    /// Counts to mm.
    pub mm_per_count: f64,
    /// The numbers and words that stand for 'no target', as they stand in the files; those of the usual drivers where none are given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub no_target: Option<Vec<NoTarget>>,
    /// Other channels, or columns, that are carried along.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub extra: Vec<String>,
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
