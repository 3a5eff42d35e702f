#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
use ingest::Thumbnail;

use super::*;

/// Pitch of a head that looks somewhere else every few seconds, and turns there within about a second.
struct Head {
    /// When it starts to turn, and where to.
    turns: Vec<(f64, f64)>,
    /// How long a turn takes.
    turn_s: f64,
}

impl Head {
    fn new(duration_s: f64, every_s: f64) -> Self {
        let (mut turns, mut time_s, mut state) = (vec![(0.0, 0.5)], 0.0, 11_u64);
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            f64::from((state >> 33) as u32) / f64::from(1_u32 << 31)
        };
        while time_s < duration_s {
            time_s += every_s * (0.3 + 1.4 * random());
            turns.push((time_s, 0.2 + 0.9 * random()));
        }
        Self { turns, turn_s: 0.8 }
    }

    fn pitch_rad(&self, time_s: f64) -> f64 {
        let next = self.turns.partition_point(|(start, _)| *start <= time_s).max(1);
        let (start, to) = self.turns[next - 1];
        let from = if next >= 2 { self.turns[next - 2].1 } else { to };
        from + (to - from) * ((time_s - start) / self.turn_s).clamp(0.0, 1.0)
    }
}

/// The estimate for images every 10 s whose clock is `lag_s` behind the sensors': an image stamped t was taken at t + lag.
fn estimated(head: &Head, images: u32, lag_s: f64, seen: impl Fn(f64, f64) -> f64) -> LagEstimate {
    let stamps: Vec<f64> = (0..images).map(|i| 15.0 + 10.0 * f64::from(i)).collect();
    let end_s = stamps.last().unwrap() + 20.0;
    let force = |s: f64| Vector3::new(0.0, -head.pitch_rad(s).cos(), -head.pitch_rad(s).sin());
    let times: Vec<UtcNs> = stamps.iter().map(|s| UtcNs(0).plus_seconds(*s)).collect();
    let mut windows = Windows::new(&times, REACH_S + SMOOTH_S, around);
    for i in 0..(end_s * 32.0) as u32 {
        let s = f64::from(i) / 32.0;
        windows.push(UtcNs(0).plus_seconds(s), force(s));
    }
    let directions = windows.finish();
    let change = |i: usize| seen(head.pitch_rad(stamps[i] + lag_s), head.pitch_rad(stamps[i + 1] + lag_s));
    let pair = |i: usize| PairMotion { change: change(i), from: &directions[i], to: &directions[i + 1] };
    estimate(&(0..stamps.len() - 1).map(pair).collect::<Vec<_>>())
}

/// A picture changes with the turn, up to where nothing is left of it, and a little by itself.
fn saturating(a: f64, b: f64) -> f64 {
    let flicker = 0.02 * (1000.0 * (a + 3.0 * b)).sin();
    ((a - b).abs() / 0.25).tanh() + flicker
}

#[test]
fn a_known_lag_is_found_within_0_3_s() {
    let head = Head::new(2000.0, 3.0);
    for lag_s in [-4.2, 0.0, 1.7, 7.35] {
        let estimate = estimated(&head, 150, lag_s, saturating);
        assert_eq!(estimate.verdict, LagVerdict::Known, "{estimate:?}");
        assert!((estimate.lag_s.unwrap() - lag_s).abs() < 0.3, "{lag_s}: {estimate:?}");
    }
}

#[test]
fn without_motion_it_cannot_be_told() {
    let still = Head { turns: vec![(0.0, 0.9)], turn_s: 0.8 };
    let estimate = estimated(&still, 150, 1.0, |a, b| 0.3 + (a * 1e3).sin() + b);
    assert_eq!(estimate.verdict, LagVerdict::NoAgreement, "{estimate:?}");
}

#[test]
fn pictures_that_change_by_themselves_tell_nothing() {
    let mut state = 5_u64;
    let unrelated = std::cell::RefCell::new(move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from((state >> 33) as u32)
    });
    let estimate = estimated(&Head::new(2000.0, 3.0), 150, 1.0, |_, _| unrelated.borrow_mut()());
    assert_eq!(estimate.verdict, LagVerdict::NoAgreement, "{estimate:?}");
}

#[test]
fn a_head_that_turns_slowly_gives_no_sharp_lag() {
    let head = Head { turn_s: 40.0, ..Head::new(4000.0, 60.0) };
    let estimate = estimated(&head, 300, 1.0, |a, b| (a - b).abs());
    assert!(estimate.half_width_s.unwrap() > 1.0 && estimate.verdict == LagVerdict::NotSharp, "{estimate:?}");
}

#[test]
fn a_lag_beyond_the_search_is_not_told() {
    let estimate = estimated(&Head::new(2000.0, 3.0), 150, 14.0, saturating);
    assert_ne!(estimate.verdict, LagVerdict::Known, "{estimate:?}");
}

#[test]
fn few_pairs_tell_nothing() {
    assert_eq!(estimated(&Head::new(300.0, 3.0), 20, 0.0, saturating).verdict, LagVerdict::TooFewPairs);
    assert_eq!(estimate(&[]).verdict, LagVerdict::TooFewPairs);
}

#[test]
fn pairs_without_acceleration_at_some_lag_are_left_out() {
    let (known, unknown) = (vec![Some(Vector3::x()); LAGS], vec![None; LAGS]);
    let pairs = [(&known, &known), (&known, &unknown)].map(|(a, b)| PairMotion { change: 1.0, from: a, to: b });
    assert_eq!(estimate(&pairs).pairs, 1);
}

#[test]
fn equal_values_share_their_rank() {
    assert_eq!(rank::ranks(&[3.0, 1.0, 3.0, 2.0]), [2.5, 0.0, 2.5, 1.0]);
    assert_eq!(rank::correlation(&[0.0, 1.0, 2.0], &[0.0, 1.0, 2.0]), Some(1.0));
    assert_eq!(rank::correlation(&[0.0, 1.0, 2.0], &[1.0, 1.0, 1.0]), None);
}

#[test]
fn exposure_is_no_change_and_a_shift_is() {
    let stripes = |phase: usize, gain: usize| Thumbnail {
        width_px: 8,
        height_px: 8,
        grey: (0..64).map(|i| (gain * ((i / 8 + phase) % 4)) as u8).collect(),
    };
    assert!(change(&stripes(0, 20), &stripes(0, 60)).unwrap() < 1e-9);
    assert!(change(&stripes(0, 20), &stripes(1, 20)).unwrap() > 0.5);
    assert_eq!(change(&stripes(0, 0), &stripes(1, 20)), None, "one grey");
}
