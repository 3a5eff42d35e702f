//! From counts to physical units.

use super::no_target::{NoTargetReadings, WORD_COUNT};
use super::possible::PossibleCounts;
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
        /// The sensor's full scale, g; none where it is not known.
        full_scale_g: Option<f64>,
    },
    /// Counts of a range sensor.
    Range {
        /// Counts to mm.
        mm_per_count: f64,
        /// The readings that say 'no target'.
        no_target: NoTargetReadings,
    },
}

impl From<&AccelerationStream> for Converter {
    fn from(stream: &AccelerationStream) -> Self {
        Self::Acceleration {
            g_per_count: stream.g_per_count,
            zero_g_counts: stream.zero_g_counts,
            axes: stream.axes,
            full_scale_g: stream.full_scale_g,
        }
    }
}

impl From<&RangeStream> for Converter {
    fn from(stream: &RangeStream) -> Self {
        Self::Range { mm_per_count: stream.mm_per_count, no_target: NoTargetReadings::new(stream.no_target.clone()) }
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

    /// The count that stands for a word in a file; none for a word that means nothing.
    pub(super) fn count_of_word(&self, field: &[u8]) -> Option<f64> {
        match self {
            Self::Range { no_target, .. } if no_target.is_word(field) => Some(WORD_COUNT),
            _ => None,
        }
    }

    /// The counts that the sensor can give; none for a range sensor, whose readings are judged where the range is made.
    pub(super) fn possible_counts(&self) -> Option<PossibleCounts> {
        match self {
            Self::Acceleration { g_per_count, zero_g_counts, full_scale_g, .. } => {
                Some(PossibleCounts::new(*g_per_count, *zero_g_counts, *full_scale_g))
            }
            Self::Range { .. } => None,
        }
    }

    /// The channels in physical units: x, y, z in g (device frame), or the range in mm. `counts`: one list per channel of
    /// [`Self::channels`], all of one length.
    #[must_use]
    pub fn convert(&self, counts: &[Vec<f64>]) -> Vec<Vec<f32>> {
        match self {
            Self::Acceleration { g_per_count, zero_g_counts, axes, .. } => {
                let along = |axis: &Axis| {
                    let (index, sign) = (axis.index(), axis.sign());
                    let zero = zero_g_counts[index];
                    scaled(counts.get(index), |count| (count - zero) * (sign * g_per_count))
                };
                axes.iter().map(along).collect()
            }
            Self::Range { mm_per_count, no_target } => {
                vec![scaled(counts.first(), |count| no_target.recorded_mm(count, *mm_per_count))]
            }
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "24 bits hold every count of a 16-bit sensor")]
fn scaled(counts: Option<&Vec<f64>>, scale: impl Fn(f64) -> f64) -> Vec<f32> {
    counts.into_iter().flatten().map(|count| scale(*count) as f32).collect()
}
