//! From counts to samples in physical units.

use model::UtcNs;

use crate::profile::{AccelerationStream, Axis, RangeStream};
use crate::sample::Sample;

/// From counts to samples in physical units and the device frame.
#[derive(Debug, Clone, PartialEq)]
pub enum Converter {
    /// Counts of an accelerometer.
    Acceleration {
        /// Counts to g.
        g_per_count: f64,
        /// Counts at 0 g, per sensor axis.
        zero_g_counts: [f64; 3],
        /// Device right, down, forward as sensor axes.
        axes: [Axis; 3],
    },
    /// Counts of a range sensor.
    Range {
        /// Counts to mm.
        mm_per_count: f64,
    },
}

impl From<&AccelerationStream> for Converter {
    fn from(stream: &AccelerationStream) -> Self {
        Self::Acceleration { g_per_count: stream.g_per_count, zero_g_counts: stream.zero_g_counts, axes: stream.axes }
    }
}

impl From<&RangeStream> for Converter {
    fn from(stream: &RangeStream) -> Self {
        Self::Range { mm_per_count: stream.mm_per_count }
    }
}

impl Converter {
    /// The channels that it takes, in order.
    #[must_use]
    pub fn channels(&self) -> &'static [&'static str] {
        match self {
            Self::Acceleration { .. } => &["x", "y", "z"],
            Self::Range { .. } => &["range"],
        }
    }

    /// The sample. `counts`: sensor x, y, z of an accelerometer; the first one of a range sensor.
    #[must_use]
    pub fn sample(&self, time: UtcNs, counts: [f64; 3]) -> Sample {
        match self {
            Self::Acceleration { g_per_count, zero_g_counts, axes } => {
                let in_sensor: [f64; 3] = std::array::from_fn(|i| (counts[i] - zero_g_counts[i]) * g_per_count);
                Sample::Acceleration { time, g: axes.map(|axis| axis.of(in_sensor)) }
            }
            Self::Range { mm_per_count } => Sample::Range { time, mm: counts[0] * mm_per_count },
        }
    }
}
