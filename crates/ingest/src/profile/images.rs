//! Where the images are, and when they were taken.

use serde::{Deserialize, Serialize};

/// The camera's files.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Images {
    /// Patterns relative to the card; `*` stays within a folder, `**` does not.
    pub files: Vec<String>,
    /// What gives an image its time.
    pub time: ImageTime,
}

/// What gives an image its time.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "from", rename_all = "snake_case", deny_unknown_fields)]
pub enum ImageTime {
    /// The file's name.
    Name {
        /// strptime pattern of the name, with or without its extension. UTC if it ends in a literal `Z`; the offset that
        /// it holds if it has `%z`, `%:z` or `%s`; else in the study's time zone.
        pattern: String,
    },
    /// EXIF `DateTimeOriginal` with `SubSecTimeOriginal`, and `OffsetTimeOriginal` if present; else in the study's zone.
    Exif {},
}
