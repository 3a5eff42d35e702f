//! How a sensor sits in the device.

use serde::{Deserialize, Serialize};

/// A sensor axis with its sign, written `"+x"` or `"-z"`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Axis {
    /// Along sensor x.
    #[serde(rename = "+x")]
    PlusX,
    /// Against sensor x.
    #[serde(rename = "-x")]
    MinusX,
    /// Along sensor y.
    #[serde(rename = "+y")]
    PlusY,
    /// Against sensor y.
    #[serde(rename = "-y")]
    MinusY,
    /// Along sensor z.
    #[serde(rename = "+z")]
    PlusZ,
    /// Against sensor z.
    #[serde(rename = "-z")]
    MinusZ,
}

impl Axis {
    /// Index of the sensor axis: x 0, y 1, z 2.
    #[must_use]
    pub fn index(self) -> usize {
        match self {
            Self::PlusX | Self::MinusX => 0,
            Self::PlusY | Self::MinusY => 1,
            Self::PlusZ | Self::MinusZ => 2,
        }
    }

    /// 1 along the sensor axis, -1 against it.
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Self::PlusX | Self::PlusY | Self::PlusZ => 1.0,
            Self::MinusX | Self::MinusY | Self::MinusZ => -1.0,
        }
    }
}
