//! The setting of who marks.

use std::fmt::{Display, Formatter};
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// The source of a study's marks.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MarksSource {
    /// The study's files of marks. No picture is decoded.
    #[default]
    Manual,
    /// The program, which finds rims in the selected images. Of the files of marks, those of the rater `auto` that a person has made or
    /// corrected count; others are not read.
    Auto,
    /// Both. Where rater `auto` has a file for an image, the file counts, and the image is not searched.
    Both,
}

impl MarksSource {
    /// All sources.
    pub const ALL: [Self; 3] = [Self::Manual, Self::Auto, Self::Both];

    /// The name in study.toml and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Manual => "manual",
            Self::Auto => "auto",
            Self::Both => "both",
        }
    }

    /// Whether the files of marks of all raters are read.
    #[must_use]
    pub fn reads_all(self) -> bool {
        self != Self::Auto
    }

    /// Whether rims are looked for in pictures.
    #[must_use]
    pub fn searches(self) -> bool {
        self != Self::Manual
    }
}

impl Display for MarksSource {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        f.pad(self.name())
    }
}

/// The error of a text that is not the name of a [`MarksSource`].
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("'{0}' is not one of: manual, auto, both")]
pub struct UnknownMarksSource(String);

impl FromStr for MarksSource {
    type Err = UnknownMarksSource;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let named = Self::ALL.into_iter().find(|source| source.name() == text);
        named.ok_or_else(|| UnknownMarksSource(text.to_owned()))
    }
}
