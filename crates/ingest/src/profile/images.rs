//! The files of the images, and the source of their times.

use serde::{Deserialize, Serialize};

/// The camera's files.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Images {
    /// Patterns relative to the card; `*` stays within a folder, `**` does not.
    pub files: Vec<String>,
    /// The source of an image's time.
    pub time: ImageTime,
}

/// The source of an image's time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "from", rename_all = "snake_case", deny_unknown_fields)]
pub enum ImageTime {
    /// The file's name.
    Name {
        /// strptime pattern of the name, with or without its extension. UTC if it ends in a literal `Z`; the offset that
        /// it holds if it has `%z`, `%:z` or `%s`; else in the study's time zone.
        pattern: String,
    },
    /// EXIF `DateTimeOriginal` with `SubSecTimeOriginal`, by `OffsetTimeOriginal` or else `OffsetTime` if present; else in
    /// the study's zone.
    Exif {},
    /// The file's name, which EXIF checks; where only one of them gives a time, that one.
    Both {
        /// As for `Name`.
        pattern: String,
        /// Seconds that the two may be apart; an image whose times are further apart is not used.
        #[serde(default = "default_tolerance_s")]
        tolerance_s: f64,
    },
}

fn default_tolerance_s() -> f64 {
    2.0
}

impl ImageTime {
    /// The pattern of the name, if the name counts.
    pub(crate) fn pattern(&self) -> Option<&str> {
        match self {
            Self::Name { pattern } | Self::Both { pattern, .. } => Some(pattern),
            Self::Exif {} => None,
        }
    }
}
