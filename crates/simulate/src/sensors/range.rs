//! A model of the range sensor VL53L0X, as AIM-2 logs it.

use rand::Rng;

use super::motion::{HeadPose, Motion};

/// Seconds between new readings, which is the sensor's own period. The log at 128 Hz holds four or five copies of each reading.
const READING_PERIOD_S: f64 = 0.033;

/// The code that the sensor gives when no target answers.
const NO_TARGET: i16 = 8190;

/// The share of the triples of readings that have a [`NO_TARGET`] code among them.
const NO_TARGET_SHARE: f64 = 0.04;

/// The largest noise of a reading, in mm.
const NOISE_MM: f64 = 4.0;

/// The readings of a whole recording. Each of them is held until the next one.
///
/// The noise comes in triples (+n, 0, -n), so that the median of any window with a few readings is exactly the distance. Here
/// the noise must not hide an error of arithmetic.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RangeSensor {
    readings: Vec<i16>,
}

impl RangeSensor {
    /// The readings from the start of the recording until `duration_s`.
    #[must_use]
    pub fn record(random: &mut impl Rng, motion: &Motion, duration_s: f64) -> Self {
        let mut readings = Vec::new();
        while time_s(readings.len()) <= duration_s {
            let noise_mm = random.random_range(-NOISE_MM..=NOISE_MM).round();
            let no_target = random.random_bool(NO_TARGET_SHARE);
            for (offset_mm, lost) in [(noise_mm, false), (0.0, no_target), (-noise_mm, false)] {
                readings.push(match motion.pose_at(time_s(readings.len())) {
                    Some(pose) if !lost => to_count(pose, offset_mm),
                    _ => NO_TARGET,
                });
            }
        }
        Self { readings }
    }

    /// The reading that is held at a time in seconds since the start of the recording, in mm.
    #[must_use]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "an index; times before 0 give the first"
    )]
    pub fn reading_at(&self, time_s: f64) -> i16 {
        self.readings.get((time_s / READING_PERIOD_S) as usize).copied().unwrap_or(NO_TARGET)
    }
}

#[expect(clippy::cast_precision_loss, reason = "a recording has far fewer than 2^53 readings")]
fn time_s(reading: usize) -> f64 {
    reading as f64 * READING_PERIOD_S
}

#[expect(clippy::cast_possible_truncation, reason = "the float-to-integer cast saturates")]
fn to_count(pose: HeadPose, offset_mm: f64) -> i16 {
    (pose.range_mm.round() + offset_mm) as i16
}
