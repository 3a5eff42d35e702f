//! Step *signals*: turns samples into the pose of the camera at each image (docs/signals.md).
//!
//! - Input: the stream of acceleration and range samples of a session, and the times of its images.
//! - Output: a [`Reading`] for each image, which knows no threshold; [`Reading::judge`] makes a pose and a choice of it, by
//!   the [`PoseSettings`].
//!
//! The samples of a session are streamed. Only those near images that are still open are kept.

mod calibration;
mod frame;
mod gravity;
pub mod lag;
mod range;
mod settings;
#[cfg(test)]
mod tests;
mod window;

use ingest::timeline::Timeline;
use ingest::{ReadError, Sample, SessionReader};
use model::{FrameFlag, FrameReason, Method, Pose, UtcNs};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use calibration::StillWindows;
pub use calibration::{AxisCalibration, CalibrationVerdict, GravityCalibration};
pub(crate) use frame::down_in_camera;
use gravity::Gravity;
pub(crate) use range::NO_TARGET_MM;
use range::Range;
pub use settings::{GravityCalibrate, PoseSettings, RangeCone, ReadingSettings};
use window::Windows;

/// The sensors' account of one image.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameSignals {
    /// The first reason that applies.
    pub reason: FrameReason,
    /// The length of gravity, in 1/1000 of standard gravity.
    pub gravity_mg: Option<f64>,
    /// The RMS of the acceleration around gravity.
    pub stillness_mg: Option<f64>,
    /// Pitch and roll of the camera.
    pub pitch_roll_rad: Option<(f64, f64)>,
    /// The median range.
    pub range_mm: Option<f64>,
    /// The robust SD of the range readings.
    pub range_spread_mm: Option<f64>,
    /// The number of valid range records in the window.
    pub range_samples: u32,
    /// The number of readings of the sensor behind them.
    pub range_distinct: u32,
    /// The pose with the range as it was read; present exactly when [`FrameReason::has_pose`].
    pub pose: Option<Pose>,
    /// The pose with the range corrected for the sensor's cone, where that was asked for and can be done.
    pub cone_pose: Option<Pose>,
    /// Flags: other facts worth knowing about it.
    pub flags: Vec<FrameFlag>,
}

impl FrameSignals {
    /// The pose that `method` works with. The paper's method takes the range as it was read.
    #[must_use]
    pub fn pose_for(&self, method: Method) -> Option<Pose> {
        if method == Method::Paper { self.pose } else { self.cone_pose.or(self.pose) }
    }
}

/// The sensors' readings around one image, before any threshold.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Reading {
    /// None when the image's time exists twice.
    #[serde(rename = "found")]
    sensed: Option<(Option<Gravity>, Range)>,
}

impl Reading {
    /// The pose of the image, and the reason that the ledger gives.
    #[must_use]
    pub fn judge(&self, settings: &PoseSettings) -> FrameSignals {
        frame::signals(self.sensed, settings)
    }
}

/// The sensors' readings at all images of a session.
#[derive(Debug, Clone, PartialEq)]
pub struct SessionReadings {
    /// The reading at each image, in their order.
    pub readings: Vec<Reading>,
    /// The gravity calibration of the accelerometer, unless it was switched off.
    pub calibration: Option<GravityCalibration>,
}

/// The readings around each of `image_times`, which must be in order.
///
/// Samples of one sensor must come in the order of time; how the sensors alternate does not matter. To apply a gravity
/// calibration the samples are streamed twice.
///
/// # Errors
/// [`ReadError`] when the session's samples cannot be read.
pub fn at_images(
    reader: &mut SessionReader,
    image_times: &[UtcNs],
    settings: &ReadingSettings,
) -> Result<SessionReadings, ReadError> {
    let timeline = reader.metadata().timeline.clone();
    evaluate(|each| reader.for_each_sample(each), &timeline, image_times, settings)
}

/// [`at_images`] over any stream. `stream` calls its argument with every sample, each time that it is called.
fn evaluate<E>(
    mut stream: impl FnMut(&mut dyn FnMut(Sample)) -> Result<(), E>,
    timeline: &Timeline,
    image_times: &[UtcNs],
    settings: &ReadingSettings,
) -> Result<SessionReadings, E> {
    let mut still = StillWindows::default();
    let applies = settings.gravity_calibration == GravityCalibrate::Apply;
    if applies {
        stream(&mut |sample| still.push_sample(&sample))?;
    }
    let applied = applies.then(|| still.calibration()).and_then(|calibration| calibration.accepted());
    let watches = settings.gravity_calibration == GravityCalibrate::Report;
    let half_gravity_s = gravity::half_window_s(settings.gravity_cutoff_hz);
    let half_range_s = 0.5 * settings.range_window_s;
    let gravity_at =
        |time, samples: &[(UtcNs, Vector3<f64>)]| gravity::gravity_at(time, samples, settings.gravity_cutoff_hz);
    let mut accelerations = Windows::new(image_times, half_gravity_s, gravity_at);
    let range_in = |_, samples: &[(UtcNs, f64)]| range::range_from(samples, settings);
    let mut ranges = Windows::new(image_times, half_range_s, range_in);
    stream(&mut |sample| {
        if watches {
            still.push_sample(&sample);
        }
        match sample {
            Sample::Acceleration { time, g } => {
                let force_g = Vector3::from(g);
                accelerations.push(time, applied.map_or(force_g, |calibration| calibration.apply(&force_g)));
            }
            Sample::Range { time, mm } => ranges.push(time, mm),
        }
    })?;
    let is_ambiguous = |time: &UtcNs| timeline.is_ambiguous(*time, half_gravity_s.max(half_range_s));
    let sensed = accelerations.finish().into_iter().zip(ranges.finish()).zip(image_times);
    let readings = sensed.map(|(sensed, time)| Reading { sensed: (!is_ambiguous(time)).then_some(sensed) }).collect();
    let calibration = (applies || watches).then(|| still.calibration());
    Ok(SessionReadings { readings, calibration })
}
