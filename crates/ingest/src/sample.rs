//! One sample of a sensor.

use model::UtcNs;

/// One sample of a sensor, in physical units and the device frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sample {
    /// Specific force.
    Acceleration {
        /// The time at which it was sampled.
        time: UtcNs,
        /// In g, device frame: x right, y down, z forward. At rest and upright, y is -1.
        g: [f64; 3],
    },
    /// Reading of the range sensor.
    Range {
        /// The time at which it was sampled.
        time: UtcNs,
        /// In mm, as the sensor gave it: codes (8190, 8191: no target) included.
        mm: f64,
    },
}

impl Sample {
    /// The time at which the sample was taken.
    #[must_use]
    pub fn time(&self) -> UtcNs {
        match self {
            Self::Acceleration { time, .. } | Self::Range { time, .. } => *time,
        }
    }
}
