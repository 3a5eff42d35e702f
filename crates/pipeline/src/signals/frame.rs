//! The pose of one image from gravity and range, and the reason that the ledger gives: step *select* of a session, for one
//! image.

use model::{FrameFlag, FrameReason, Pose};
use nalgebra::{Rotation3, Vector3};

use super::FrameSignals;
use super::gravity::Gravity;
use super::range::{Range, cone};
use super::settings::{PoseSettings, RangeCone};

/// The signals of one image; `sensed` is none when its time exists twice.
pub(super) fn signals(sensed: Option<(Option<Gravity>, Range)>, settings: &PoseSettings) -> FrameSignals {
    match sensed {
        Some((gravity, range)) => of_readings(gravity, range, settings),
        None => FrameSignals {
            reason: FrameReason::AmbiguousTime,
            gravity_mg: None,
            stillness_mg: None,
            pitch_roll_rad: None,
            range_mm: None,
            range_spread_mm: None,
            range_samples: 0,
            range_distinct: 0,
            pose: None,
            cone_pose: None,
            flags: Vec::new(),
        },
    }
}

fn of_readings(gravity: Option<Gravity>, range: Range, settings: &PoseSettings) -> FrameSignals {
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
        range_distinct: range.distinct,
        pose,
        cone_pose: None,
        flags: Vec::new(),
    };
    signals.reason = reason(&signals, settings);
    signals.pose = pose.filter(|_| signals.reason.has_pose());
    let wants_cone = settings.range_cone == RangeCone::TiltedPlane;
    signals.cone_pose = signals.pose.filter(|_| wants_cone).and_then(without_cone);
    let skipped = wants_cone && signals.pose.is_some() && signals.cone_pose.is_none();
    let flags = [
        (FrameFlag::GravityEdge, gravity.is_some_and(|gravity| gravity.one_sided)),
        (FrameFlag::RangeHeld, range.held),
        (FrameFlag::RangeStep, range.step),
        (FrameFlag::RangeConeSkipped, skipped),
    ];
    signals.flags = flags.into_iter().filter(|(_, raised)| *raised).map(|(flag, _)| flag).collect();
    signals
}

/// The pose with the distance along the axis for which the range sensor's cone on a tilted table gives this reading.
fn without_cone(pose: Pose) -> Option<Pose> {
    let axis_range_mm = pose.range_mm() / cone::reading_over_axis(pose.pitch_rad())?;
    Pose::new(pose.pitch_rad(), pose.roll_rad(), axis_range_mm).ok()
}

/// The ledger's reason: the first that applies.
fn reason(signals: &FrameSignals, settings: &PoseSettings) -> FrameReason {
    let (Some(gravity_mg), Some(stillness_mg), Some((pitch_rad, _))) =
        (signals.gravity_mg, signals.stillness_mg, signals.pitch_roll_rad)
    else {
        return FrameReason::NoAcceleration;
    };
    if (gravity_mg - 1000.0).abs() > settings.gravity_tolerance_mg {
        return FrameReason::BadGravity;
    }
    if signals.range_mm.is_none() {
        return FrameReason::NoRange;
    }
    if signals.pose.is_none() {
        return FrameReason::NotBelowHorizon;
    }
    if stillness_mg > settings.stillness_max_mg {
        return FrameReason::Moving;
    }
    let off_target_deg = (pitch_rad.to_degrees() - settings.target_pitch_deg).abs();
    if off_target_deg > settings.pitch_tolerance_deg {
        return FrameReason::PitchOutsideTarget;
    }
    FrameReason::Selected
}

/// The direction down in the camera frame. The specific force at rest, in the device frame, points up; the camera is turned
/// down by the mount offset about the axis x that both frames share.
pub(crate) fn down_in_camera(specific_force_g: &Vector3<f64>, mount_pitch_rad: f64) -> Vector3<f64> {
    Rotation3::from_axis_angle(&Vector3::x_axis(), mount_pitch_rad) * -specific_force_g
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use model::Method;

    use super::*;

    /// The specific force that an accelerometer at rest reads when its forward axis points `pitch` below the horizon.
    fn at_rest(sensor_pitch_deg: f64, roll_deg: f64) -> Vector3<f64> {
        let pose = Pose::new(sensor_pitch_deg.to_radians(), roll_deg.to_radians(), 500.0).unwrap();
        -pose.down_in_camera()
    }

    const NO_RANGE: Range =
        Range { median_mm: None, spread_mm: None, valid_samples: 0, distinct: 0, held: false, step: false };

    fn range(median_mm: Option<f64>) -> Range {
        Range { median_mm, spread_mm: Some(1.0), valid_samples: 100, distinct: 40, ..NO_RANGE }
    }

    fn gravity(specific_force_g: Vector3<f64>, motion_rms_g: f64) -> Option<Gravity> {
        Some(Gravity { specific_force_g, motion_rms_g, one_sided: false })
    }

    fn settings() -> PoseSettings {
        PoseSettings::with_mount(21_f64.to_radians())
    }

    fn signals_at(specific_force_g: Vector3<f64>, motion_rms_g: f64, range_mm: Option<f64>) -> FrameSignals {
        of_readings(gravity(specific_force_g, motion_rms_g), range(range_mm), &settings())
    }

    #[test]
    fn camera_pitch_is_sensor_pitch_plus_the_mount_offset() {
        let judged = signals_at(at_rest(34.0, 0.0), 0.005, Some(580.0));
        let (pitch, roll) = judged.pitch_roll_rad.unwrap();
        assert!((pitch.to_degrees() - 55.0).abs() < 1e-9 && roll.abs() < 1e-12);
        assert_eq!(judged.reason, FrameReason::Selected);
        assert!((judged.pose.unwrap().range_mm() - 580.0).abs() < 1e-12);
    }

    #[test]
    fn level_head_still_looks_down_by_the_mount_offset() {
        let upright = Vector3::new(0.0, -1.0, 0.0);
        let (pitch, _) = signals_at(upright, 0.0, Some(500.0)).pitch_roll_rad.unwrap();
        assert!((pitch.to_degrees() - 21.0).abs() < 1e-9);
    }

    #[test]
    fn head_tilted_to_the_right_is_a_positive_roll() {
        // Tilted clockwise as the wearer sees it, the device's x axis (right) points partly down.
        let tilted = Vector3::new(-(10_f64.to_radians().sin()), -(10_f64.to_radians().cos()), 0.0);
        let mut level_mount = settings();
        level_mount.mount_pitch_rad = 0.0;
        let (_, roll) = of_readings(gravity(tilted, 0.0), NO_RANGE, &level_mount).pitch_roll_rad.unwrap();
        assert!((roll.to_degrees() - 10.0).abs() < 1e-9);
    }

    #[test]
    fn the_first_reason_that_applies_is_given() {
        let good = at_rest(34.0, 0.0);
        assert_eq!(of_readings(None, NO_RANGE, &settings()).reason, FrameReason::NoAcceleration);
        assert_eq!(signals_at(good * 1.2, 0.005, Some(580.0)).reason, FrameReason::BadGravity);
        assert_eq!(signals_at(good, 0.005, None).reason, FrameReason::NoRange);
        let looking_up = Rotation3::from_axis_angle(&Vector3::x_axis(), -1.2) * good;
        assert_eq!(signals_at(looking_up, 0.005, Some(580.0)).reason, FrameReason::NotBelowHorizon);
        assert_eq!(signals_at(good, 0.2, Some(580.0)).reason, FrameReason::Moving);
        assert_eq!(signals_at(at_rest(20.0, 0.0), 0.005, Some(580.0)).reason, FrameReason::PitchOutsideTarget);
    }

    #[test]
    fn a_pose_is_there_exactly_when_the_reason_says_so() {
        for (force, motion, range) in [
            (at_rest(34.0, 0.0), 0.005, Some(580.0)),
            (at_rest(34.0, 0.0) * 1.2, 0.005, Some(580.0)),
            (at_rest(34.0, 0.0), 0.2, Some(580.0)),
            (at_rest(34.0, 0.0), 0.005, None),
        ] {
            let judged = signals_at(force, motion, range);
            assert_eq!(judged.pose.is_some(), judged.reason.has_pose(), "{:?}", judged.reason);
        }
    }

    #[test]
    fn a_time_that_exists_twice_says_nothing() {
        let judged = signals(None, &settings());
        assert_eq!((judged.reason, judged.pose, judged.gravity_mg), (FrameReason::AmbiguousTime, None, None));
    }

    #[test]
    fn flags_tell_and_drop_nothing() {
        let edge = gravity(at_rest(34.0, 0.0), 0.005).map(|g| Gravity { one_sided: true, ..g });
        let step = Range { step: true, held: true, ..range(Some(580.0)) };
        let judged = of_readings(edge, step, &settings());
        assert_eq!(judged.flags, [FrameFlag::GravityEdge, FrameFlag::RangeHeld, FrameFlag::RangeStep]);
        assert_eq!((judged.reason, judged.range_distinct), (FrameReason::Selected, 40));
        assert!(signals_at(at_rest(34.0, 0.0), 0.005, Some(580.0)).flags.is_empty());
    }

    #[test]
    fn the_cone_is_corrected_when_declared_and_never_for_the_paper() {
        let plain = signals_at(at_rest(34.0, 0.0), 0.005, Some(580.0));
        assert_eq!((plain.cone_pose, plain.pose_for(Method::Ray)), (None, plain.pose));
        let mut declared = settings();
        declared.range_cone = RangeCone::TiltedPlane;
        let judged = of_readings(gravity(at_rest(34.0, 0.0), 0.005), range(Some(580.0)), &declared);
        assert_eq!((judged.pose, judged.range_mm), (plain.pose, plain.range_mm), "the reading stays as it was");
        assert_eq!(judged.pose_for(Method::Paper), plain.pose);
        let ratio = 580.0 / judged.pose_for(Method::Ray).unwrap().range_mm();
        assert!((ratio - cone::reading_over_axis(55_f64.to_radians()).unwrap()).abs() < 1e-12);
        // 11 degrees below the horizon: part of the cone looks over the table.
        let up = Rotation3::from_axis_angle(&Vector3::x_axis(), -10_f64.to_radians()) * Vector3::new(0.0, -1.0, 0.0);
        let shallow = of_readings(gravity(up, 0.005), range(Some(580.0)), &declared);
        assert!((shallow.pitch_roll_rad.unwrap().0.to_degrees() - 11.0).abs() < 1e-9);
        assert_eq!(shallow.flags, [FrameFlag::RangeConeSkipped]);
        assert_eq!(shallow.pose_for(Method::Ray), shallow.pose);
    }
}
