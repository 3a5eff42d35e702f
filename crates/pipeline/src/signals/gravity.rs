//! Gravity at an image: a zero-phase, robust low-pass evaluated at one time.
//!
//! The paper says that a 0.1 Hz high-pass removed the DC part of the accelerometer signal before the pitch was taken. Gravity
//! *is* that DC part, so pitch comes from the low-passed signal here, and the high-passed remainder says how still the
//! head was.

use std::f64::consts::{LN_2, TAU};

use model::{UtcNs, median};
use nalgebra::Vector3;

/// Gravity as the device feels it, and the motion around it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Gravity {
    /// Low-passed specific force, device frame; at rest it points up with length 1.
    pub specific_force_g: Vector3<f64>,
    /// RMS length of what the low-pass removed.
    pub motion_rms_g: f64,
}

/// Fewer samples than this within one kernel SD of the image do not tell gravity.
const MIN_CENTRAL_SAMPLES: usize = 5;
/// The kernel is cut off at this many of its SDs (weight 0.011).
const KERNEL_REACH_SD: f64 = 3.0;
/// Residuals longer than this many SDs (of one axis) count less: Huber's weights (Huber 1981), with a knee that lets
/// three-dimensional Gaussian noise pass (longer than this: 6 in 1000).
const HUBER_SD: f64 = 3.5;
/// Median length of a three-dimensional Gaussian residual, in SDs of one axis.
const MEDIAN_LENGTH_SD: f64 = 1.538;
/// Rounds of reweighting; the weights settle to well under the sensor's 1 mg in three.
const ROUNDS: usize = 4;

/// SD of the Gaussian kernel whose frequency response exp(-(tau f)^2 sd^2 / 2) is -3 dB at `cutoff_hz`.
fn kernel_sd_s(cutoff_hz: f64) -> f64 {
    LN_2.sqrt() / (TAU * cutoff_hz)
}

/// How far from an image its samples may lie.
pub(super) fn half_window_s(cutoff_hz: f64) -> f64 {
    KERNEL_REACH_SD * kernel_sd_s(cutoff_hz)
}

/// Gravity at `time` from the samples within [`half_window_s`] of it. The kernel is symmetric about the image's time (no
/// phase) and works on true sample times, so holes and uneven steps need no resampling. Samples far from the others (a
/// bump) count less, by Huber's weights on the length of the residual.
pub(super) fn at(time: UtcNs, samples: &[(UtcNs, Vector3<f64>)], cutoff_hz: f64) -> Option<Gravity> {
    let sd_s = kernel_sd_s(cutoff_hz);
    let central = samples.iter().filter(|(t, _)| t.seconds_since(time).abs() <= sd_s).count();
    if central < MIN_CENTRAL_SAMPLES {
        return None;
    }
    let kernel: Vec<f64> = samples.iter().map(|(t, _)| (-0.5 * (t.seconds_since(time) / sd_s).powi(2)).exp()).collect();
    let mut weights = kernel.clone();
    let mut mean = weighted_mean(samples, &weights);
    for _ in 0..ROUNDS {
        let lengths: Vec<f64> = samples.iter().map(|(_, a)| (a - mean).norm()).collect();
        let limit = HUBER_SD * median(lengths.clone()) / MEDIAN_LENGTH_SD;
        for ((weight, kernel), length) in weights.iter_mut().zip(&kernel).zip(&lengths) {
            *weight = if *length > limit { kernel * limit / length } else { *kernel };
        }
        mean = weighted_mean(samples, &weights);
    }
    let squares: f64 = samples.iter().zip(&kernel).map(|((_, a), w)| w * (a - mean).norm_squared()).sum();
    let motion_rms_g = (squares / kernel.iter().sum::<f64>()).sqrt();
    mean.iter().all(|c| c.is_finite()).then_some(Gravity { specific_force_g: mean, motion_rms_g })
}

fn weighted_mean(samples: &[(UtcNs, Vector3<f64>)], weights: &[f64]) -> Vector3<f64> {
    let sum: Vector3<f64> = samples.iter().zip(weights).map(|((_, a), w)| a * *w).sum();
    sum / weights.iter().sum::<f64>()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use super::*;

    const RATE_HZ: f64 = 128.0;
    const CUTOFF_HZ: f64 = 0.25;

    fn samples(value: impl Fn(f64) -> Vector3<f64>) -> Vec<(UtcNs, Vector3<f64>)> {
        let reach = half_window_s(CUTOFF_HZ);
        let n = (2.0 * reach * RATE_HZ) as u32;
        (0..=n).map(|i| f64::from(i) / RATE_HZ - reach).map(|s| (UtcNs(0).plus_seconds(s), value(s))).collect()
    }

    #[test]
    fn response_is_3_db_down_at_the_cutoff_and_gone_at_ten_times_it() {
        for (frequency_hz, expected) in [(CUTOFF_HZ, 0.707), (10.0 * CUTOFF_HZ, 0.0)] {
            let found = at(UtcNs(0), &samples(|s| Vector3::new((TAU * frequency_hz * s).cos(), 0.0, 0.0)), CUTOFF_HZ);
            let gain = found.unwrap().specific_force_g.x;
            // Huber's weights are not linear, and the kernel ends at 3 SD.
            assert!((gain - expected).abs() < 0.04, "{gain} at {frequency_hz} Hz");
        }
    }

    #[test]
    fn a_steady_turn_has_no_phase() {
        let found = at(UtcNs(0), &samples(|s| Vector3::new(0.3 + 0.1 * s, -1.0, 0.0)), CUTOFF_HZ).unwrap();
        assert!((found.specific_force_g.x - 0.3).abs() < 1e-3);
    }

    #[test]
    fn a_bump_shows_as_motion_and_hardly_moves_gravity() {
        let still = |s: f64| Vector3::new(0.004 * (TAU * 31.0 * s).sin(), -1.0, 0.003 * (TAU * 17.0 * s).cos());
        let bump =
            |s: f64| still(s) + if (0.3..0.4).contains(&s) { Vector3::new(1.5, 0.0, 0.0) } else { Vector3::zeros() };
        let (before, after) =
            (at(UtcNs(0), &samples(still), CUTOFF_HZ).unwrap(), at(UtcNs(0), &samples(bump), CUTOFF_HZ).unwrap());
        assert!(before.motion_rms_g < 0.006 && after.motion_rms_g > 0.2);
        assert!((after.specific_force_g - before.specific_force_g).norm() < 0.002);
    }

    #[test]
    fn too_few_samples_tell_nothing() {
        let all = samples(|_| Vector3::new(0.0, -1.0, 0.0));
        assert!(at(UtcNs(0), &all[..3], CUTOFF_HZ).is_none());
        assert!(at(UtcNs(0), &[], CUTOFF_HZ).is_none());
        let only_far_away: Vec<_> =
            all.iter().filter(|(t, _)| t.seconds_since(UtcNs(0)).abs() > 1.0).copied().collect();
        assert!(at(UtcNs(0), &only_far_away, CUTOFF_HZ).is_none());
    }

    #[test]
    fn identical_samples_give_themselves() {
        let found = at(UtcNs(0), &samples(|_| Vector3::new(0.1, -0.9, 0.2)), CUTOFF_HZ).unwrap();
        assert!((found.specific_force_g - Vector3::new(0.1, -0.9, 0.2)).norm() < 1e-12 && found.motion_rms_g < 1e-12);
    }
}
