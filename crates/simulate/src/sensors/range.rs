//! A model of the VL53L0X as AIM-2 logs it.

use rand::Rng;

use super::motion::{HeadPose, Motion};

/// Seconds between new readings: the sensor's own period, of which the log at 128 Hz holds four or five copies.
const READING_PERIOD_S: f64 = 0.033;

/// The code that the sensor gives when nothing answers.
const NO_TARGET: i16 = 8190;

/// Share of triples of readings with a [`NO_TARGET`] code among them.
const NO_TARGET_SHARE: f64 = 0.04;

/// Largest noise of a reading, in mm.
const NOISE_MM: f64 = 4.0;

/// Readings of a whole recording, each held until the next one.
///
/// The noise comes in triples (+n, 0, -n), so that in any window with a few readings the median is exactly the distance:
/// here the noise must not hide an error of arithmetic.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RangeSensor {
    readings: Vec<i16>,
}

impl RangeSensor {
    /// Readings from the recording's start until `duration_s`.
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

    /// The reading held at a time.
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
