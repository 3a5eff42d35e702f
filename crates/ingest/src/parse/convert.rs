//! From counts to physical units.

use crate::profile::{AccelerationStream, Axis, RangeStream};

/// From counts to physical units and the device frame.
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

    /// The channels in physical units: x, y, z in g (device frame), or the range in mm. `counts`: one list per channel of
    /// [`Self::channels`], all of one length.
    #[must_use]
    pub fn convert(&self, counts: &[Vec<f64>]) -> Vec<Vec<f32>> {
        match self {
            Self::Acceleration { g_per_count, zero_g_counts, axes } => {
                let along = |axis: &Axis| {
                    let (index, sign) = (axis.index(), axis.sign());
                    let zero = zero_g_counts[index];
                    scaled(counts.get(index), |count| (count - zero) * (sign * g_per_count))
                };
                axes.iter().map(along).collect()
            }
            Self::Range { mm_per_count } => vec![scaled(counts.first(), |count| count * mm_per_count)],
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "24 bits hold every count of a 16-bit sensor")]
fn scaled(counts: Option<&Vec<f64>>, scale: impl Fn(f64) -> f64) -> Vec<f32> {
    counts.into_iter().flatten().map(|count| scale(*count) as f32).collect()
}
