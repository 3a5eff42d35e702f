//! From samples to the pose of the camera at each image.
//!
//! The samples of a session are streamed once; only those near images that are still open are kept.

mod gravity;
mod range;
mod window;

use std::f64::consts::FRAC_PI_2;

use ingest::{ReadError, Sample, SessionReader};
use model::{FrameReason, Pose, UtcNs};
use nalgebra::{Rotation3, Vector3};

use crate::study::{SelectSpec, SignalsSpec};
use gravity::Gravity;
use range::Range;
use window::Windows;

/// What the sensors say about one image.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameSignals {
    /// The first reason that applies.
    pub reason: FrameReason,
    /// Length of gravity.
    pub gravity_mg: Option<f64>,
    /// RMS of the acceleration around gravity.
    pub stillness_mg: Option<f64>,
    /// Pitch and roll of the camera.
    pub pitch_roll_rad: Option<(f64, f64)>,
    /// Median range.
    pub range_mm: Option<f64>,
    /// Robust SD of the range samples.
    pub range_spread_mm: Option<f64>,
    /// Valid range samples in the window.
    pub range_samples: u32,
    /// Pose; present exactly when [`FrameReason::has_pose`].
    pub pose: Option<Pose>,
}

/// Settings of this stage.
#[derive(Debug, Clone)]
pub struct SignalSettings {
    /// From samples to numbers.
    pub signals: SignalsSpec,
    /// From numbers to a choice.
    pub select: SelectSpec,
    /// Camera pitch = sensor pitch + this.
    pub mount_pitch_rad: f64,
}

/// The signals at each of `image_times`, which must be in order.
///
/// # Errors
/// [`ReadError`] when the session's samples cannot be read.
pub fn at_images(
    reader: &mut SessionReader,
    image_times: &[UtcNs],
    settings: &SignalSettings,
) -> Result<Vec<FrameSignals>, ReadError> {
    let half_gravity_s = gravity::half_window_s(settings.signals.gravity_cutoff_hz);
    let half_range_s = 0.5 * settings.signals.range_window_s;
    let mut accelerations = Windows::new(image_times, half_gravity_s, |time, samples: &[(UtcNs, Vector3<f64>)]| {
        gravity::at(time, samples, settings.signals.gravity_cutoff_hz)
    });
    let mut ranges = Windows::new(image_times, half_range_s, |_, samples: &[(UtcNs, f64)]| {
        range::of(samples, settings.signals.range_min_mm, settings.signals.range_max_mm)
    });
    reader.for_each_sample(|sample| match sample {
        Sample::Acceleration { time, g } => accelerations.push(time, Vector3::from(g)),
        Sample::Range { time, mm } => ranges.push(time, mm),
    })?;
    let pairs = accelerations.finish().into_iter().zip(ranges.finish());
    Ok(pairs.map(|(gravity, range)| frame_signals(gravity, range, settings)).collect())
}

fn frame_signals(gravity: Option<Gravity>, range: Range, settings: &SignalSettings) -> FrameSignals {
    let pitch_roll_rad = gravity
        .and_then(|g| Pose::pitch_roll_of_down(&down_in_camera(&g.specific_force_g, settings.mount_pitch_rad)).ok());
    let pose = match (pitch_roll_rad, range.median_mm) {
        (Some((pitch, roll)), Some(range_mm)) => Pose::new(pitch, roll, range_mm).ok(),
        _ => None,
    };
    let mut signals = FrameSignals {
        reason: FrameReason::Selected,
        gravity_mg: gravity.map(|g| 1000.0 * g.specific_force_g.norm()),
        stillness_mg: gravity.map(|g| 1000.0 * g.motion_rms_g),
        pitch_roll_rad,
        range_mm: range.median_mm,
        range_spread_mm: range.spread_mm,
        range_samples: range.valid_samples,
        pose,
    };
    signals.reason = reason(&signals, settings);
    signals.pose = pose.filter(|_| signals.reason.has_pose());
    signals
}

/// The ledger's reason: the first that applies.
fn reason(signals: &FrameSignals, settings: &SignalSettings) -> FrameReason {
    let (Some(gravity_mg), Some(stillness_mg), Some((pitch_rad, _))) =
        (signals.gravity_mg, signals.stillness_mg, signals.pitch_roll_rad)
    else {
        return FrameReason::NoAcceleration;
    };
    if (gravity_mg - 1000.0).abs() > settings.signals.gravity_tolerance_mg {
        return FrameReason::BadGravity;
    }
    if signals.range_mm.is_none() {
        return FrameReason::NoRange;
    }
    if signals.pose.is_none() {
        return FrameReason::NotBelowHorizon;
    }
    if stillness_mg > settings.signals.stillness_max_mg {
        return FrameReason::Moving;
    }
    let off_target_deg = (pitch_rad.to_degrees() - settings.select.target_pitch_deg).abs();
    if off_target_deg > settings.select.pitch_tolerance_deg {
        return FrameReason::PitchOutsideTarget;
    }
    FrameReason::Selected
}

/// Down in the camera frame, from the specific force at rest in the device frame (it points up), with the camera turned
/// down by the mount offset about the axis x that both share.
fn down_in_camera(specific_force_g: &Vector3<f64>, mount_pitch_rad: f64) -> Vector3<f64> {
    debug_assert!(mount_pitch_rad.abs() <= FRAC_PI_2);
    Rotation3::from_axis_angle(&Vector3::x_axis(), mount_pitch_rad) * -specific_force_g
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use super::*;

    /// What an accelerometer at rest reads, when its forward axis points `pitch` below the horizon.
    fn at_rest(sensor_pitch_deg: f64, roll_deg: f64) -> Vector3<f64> {
        let pose = Pose::new(sensor_pitch_deg.to_radians(), roll_deg.to_radians(), 500.0).unwrap();
        -pose.down_in_camera()
    }

    const NO_RANGE: Range = Range { median_mm: None, spread_mm: None, valid_samples: 0 };

    fn settings() -> SignalSettings {
        SignalSettings {
            signals: SignalsSpec::default(),
            select: SelectSpec::default(),
            mount_pitch_rad: 21_f64.to_radians(),
        }
    }

    fn signals(specific_force_g: Vector3<f64>, motion_rms_g: f64, range_mm: Option<f64>) -> FrameSignals {
        let range = Range { median_mm: range_mm, spread_mm: Some(1.0), valid_samples: 100 };
        frame_signals(Some(Gravity { specific_force_g, motion_rms_g }), range, &settings())
    }

    #[test]
    fn camera_pitch_is_sensor_pitch_plus_the_mount_offset() {
        let found = signals(at_rest(34.0, 0.0), 0.005, Some(580.0));
        let (pitch, roll) = found.pitch_roll_rad.unwrap();
        assert!((pitch.to_degrees() - 55.0).abs() < 1e-9 && roll.abs() < 1e-12);
        assert_eq!(found.reason, FrameReason::Selected);
        assert!((found.pose.unwrap().range_mm() - 580.0).abs() < 1e-12);
    }

    #[test]
    fn level_head_still_looks_down_by_the_mount_offset() {
        let upright = Vector3::new(0.0, -1.0, 0.0);
        let (pitch, _) = signals(upright, 0.0, Some(500.0)).pitch_roll_rad.unwrap();
        assert!((pitch.to_degrees() - 21.0).abs() < 1e-9);
    }

    #[test]
    fn head_tilted_to_the_right_is_a_positive_roll() {
        // Tilted clockwise as the wearer sees it, the device's x axis (right) points partly down.
        let tilted = Vector3::new(-(10_f64.to_radians().sin()), -(10_f64.to_radians().cos()), 0.0);
        let mut level_mount = settings();
        level_mount.mount_pitch_rad = 0.0;
        let gravity = Gravity { specific_force_g: tilted, motion_rms_g: 0.0 };
        let (_, roll) = frame_signals(Some(gravity), NO_RANGE, &level_mount).pitch_roll_rad.unwrap();
        assert!((roll.to_degrees() - 10.0).abs() < 1e-9);
    }

    #[test]
    fn the_first_reason_that_applies_is_given() {
        let good = at_rest(34.0, 0.0);
        assert_eq!(frame_signals(None, NO_RANGE, &settings()).reason, FrameReason::NoAcceleration);
        assert_eq!(signals(good * 1.2, 0.005, Some(580.0)).reason, FrameReason::BadGravity);
        assert_eq!(signals(good, 0.005, None).reason, FrameReason::NoRange);
        let looking_up = Rotation3::from_axis_angle(&Vector3::x_axis(), -1.2) * good;
        assert_eq!(signals(looking_up, 0.005, Some(580.0)).reason, FrameReason::NotBelowHorizon);
        assert_eq!(signals(good, 0.2, Some(580.0)).reason, FrameReason::Moving);
        assert_eq!(signals(at_rest(20.0, 0.0), 0.005, Some(580.0)).reason, FrameReason::PitchOutsideTarget);
    }

    #[test]
    fn a_pose_is_there_exactly_when_the_reason_says_so() {
        for (force, motion, range) in [
            (at_rest(34.0, 0.0), 0.005, Some(580.0)),
            (at_rest(34.0, 0.0) * 1.2, 0.005, Some(580.0)),
            (at_rest(34.0, 0.0), 0.2, Some(580.0)),
            (at_rest(34.0, 0.0), 0.005, None),
        ] {
            let found = signals(force, motion, range);
            assert_eq!(found.pose.is_some(), found.reason.has_pose(), "{:?}", found.reason);
        }
    }
}
