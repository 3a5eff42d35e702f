#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
use super::*;

const RATE_HZ: f64 = 128.0;
const CUTOFF_HZ: f64 = 0.25;

fn samples(value: impl Fn(f64) -> Vector3<f64>) -> Vec<(UtcNs, Vector3<f64>)> {
    let reach = half_window_s(CUTOFF_HZ);
    let n = (2.0 * reach * RATE_HZ) as u32;
    (0..=n).map(|i| f64::from(i) / RATE_HZ - reach).map(|s| (UtcNs(0).plus_seconds(s), value(s))).collect()
}

/// The gravity that `samples` give when only those for which `keep` holds were recorded.
fn at_with(value: impl Fn(f64) -> Vector3<f64>, keep: impl Fn(f64) -> bool) -> Option<Gravity> {
    let kept: Vec<_> = samples(value).into_iter().filter(|(t, _)| keep(t.seconds_since(UtcNs(0)))).collect();
    gravity_at(UtcNs(0), &kept, CUTOFF_HZ)
}

fn turning(s: f64) -> Vector3<f64> {
    Vector3::new(0.3 + 0.1 * s, -1.0, 0.0)
}

#[test]
fn response_is_3_db_down_at_the_cutoff_and_gone_at_ten_times_it() {
    for (frequency_hz, expected) in [(CUTOFF_HZ, 0.707), (10.0 * CUTOFF_HZ, 0.0)] {
        let gravity =
            gravity_at(UtcNs(0), &samples(|s| Vector3::new((TAU * frequency_hz * s).cos(), 0.0, 0.0)), CUTOFF_HZ);
        let gain = gravity.unwrap().specific_force_g.x;
        // Huber's weights are not linear, and the kernel ends at 3 SD.
        assert!((gain - expected).abs() < 0.04, "{gain} at {frequency_hz} Hz");
    }
}

#[test]
fn a_steady_turn_has_no_phase() {
    let gravity = gravity_at(UtcNs(0), &samples(turning), CUTOFF_HZ).unwrap();
    assert!((gravity.specific_force_g.x - 0.3).abs() < 1e-9 && !gravity.one_sided);
}

#[test]
fn a_steady_turn_has_no_phase_at_the_edge_of_the_data_either_and_the_edge_is_told() {
    for keep in [(|s| s <= 0.0) as fn(f64) -> bool, |s| s >= 0.1, |s| s >= -0.2] {
        let gravity = at_with(turning, keep).unwrap();
        assert!((gravity.specific_force_g.x - 0.3).abs() < 1e-9, "{}", gravity.specific_force_g.x);
        assert!(gravity.one_sided);
    }
    // Half a second more, and the other side has its say.
    assert!(!at_with(turning, |s| s >= -0.5).unwrap().one_sided);
}

#[test]
fn what_lies_beyond_a_gap_is_left_out() {
    // The head was elsewhere before the gap.
    let jump = |s: f64| if s < -0.2 { Vector3::new(0.8, 0.0, 0.6) } else { Vector3::new(0.0, -1.0, 0.0) };
    let gravity = at_with(jump, |s| !(-0.6..-0.1).contains(&s)).unwrap();
    assert!((gravity.specific_force_g - Vector3::new(0.0, -1.0, 0.0)).norm() < 1e-9 && gravity.one_sided);
    // A hole between packets is none.
    let gravity = at_with(turning, |s| !(-0.12..-0.1).contains(&s)).unwrap();
    assert!((gravity.specific_force_g.x - 0.3).abs() < 1e-9 && !gravity.one_sided);
}

#[test]
fn an_image_in_a_gap_has_no_gravity() {
    assert!(at_with(turning, |s| s.abs() > 0.3).is_none());
    assert!(at_with(turning, |s| s > 0.3).is_none());
    assert!(at_with(turning, |s| s.abs() > 0.1).is_some());
}

#[test]
fn a_bump_shows_as_motion_and_hardly_moves_gravity() {
    let still = |s: f64| Vector3::new(0.004 * (TAU * 31.0 * s).sin(), -1.0, 0.003 * (TAU * 17.0 * s).cos());
    let bump = |s: f64| still(s) + if (0.3..0.4).contains(&s) { Vector3::new(1.5, 0.0, 0.0) } else { Vector3::zeros() };
    let (before, after) = (
        gravity_at(UtcNs(0), &samples(still), CUTOFF_HZ).unwrap(),
        gravity_at(UtcNs(0), &samples(bump), CUTOFF_HZ).unwrap(),
    );
    assert!(before.motion_rms_g < 0.006 && after.motion_rms_g > 0.2);
    assert!((after.specific_force_g - before.specific_force_g).norm() < 0.002);
}

#[test]
fn a_turn_is_motion() {
    let gravity = gravity_at(UtcNs(0), &samples(turning), CUTOFF_HZ).unwrap();
    assert!((gravity.motion_rms_g - 0.1 * kernel_sd_s(CUTOFF_HZ)).abs() < 0.002, "{}", gravity.motion_rms_g);
}

#[test]
fn too_few_samples_tell_nothing() {
    let all = samples(|_| Vector3::new(0.0, -1.0, 0.0));
    assert!(gravity_at(UtcNs(0), &all[..3], CUTOFF_HZ).is_none());
    assert!(gravity_at(UtcNs(0), &[], CUTOFF_HZ).is_none());
    assert!(at_with(turning, |s| s.abs() > 1.0).is_none());
    assert!(at_with(turning, |s| s.abs() < 0.2).is_none(), "many samples, but too short a time");
}

#[test]
fn identical_samples_give_themselves() {
    let gravity = gravity_at(UtcNs(0), &samples(|_| Vector3::new(0.1, -0.9, 0.2)), CUTOFF_HZ).unwrap();
    assert!((gravity.specific_force_g - Vector3::new(0.1, -0.9, 0.2)).norm() < 1e-12 && gravity.motion_rms_g < 1e-12);
}
