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

    /// The component of a vector in sensor axes along this axis.
    #[must_use]
    pub fn of(self, in_sensor: [f64; 3]) -> f64 {
        let component = in_sensor[self.index()];
        match self {
            Self::PlusX | Self::PlusY | Self::PlusZ => component,
            Self::MinusX | Self::MinusY | Self::MinusZ => -component,
        }
    }
}
