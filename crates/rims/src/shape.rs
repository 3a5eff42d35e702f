//! The shapes of rims that are looked for.

use std::fmt::{Display, Formatter};
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// A shape of rims that can be found without marks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RimShape {
    /// Round rims.
    Circle,
    /// Square and rectangular plates with a well.
    Rectangle,
}

impl RimShape {
    /// The name of the shape in study.toml and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Circle => "circle",
            Self::Rectangle => "rectangle",
        }
    }
}

impl Display for RimShape {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        f.pad(self.name())
    }
}

/// The error for a text that is not the name of a [`RimShape`].
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("'{0}' is not one of: circle, rectangle")]
pub struct UnknownRimShape(String);

impl FromStr for RimShape {
    type Err = UnknownRimShape;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let named = [Self::Circle, Self::Rectangle].into_iter().find(|shape| shape.name() == text);
        named.ok_or_else(|| UnknownRimShape(text.to_owned()))
    }
}
