//! Gravity at an image: a zero-phase, robust low-pass evaluated at one time.
//!
//! The paper says that a 0.1 Hz high-pass removed the DC part of the accelerometer signal before the pitch was taken. Gravity
//! *is* that DC part, so pitch comes from the low-passed signal here, and the high-passed remainder says how still the
//! head was.

mod fit;
#[cfg(test)]
mod tests;

use std::f64::consts::{LN_2, TAU};

use model::{UtcNs, median};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use fit::Line;

/// Gravity as the device feels it, and the motion around it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Gravity {
    /// The low-passed specific force in the device frame; at rest it points up with length 1.
    pub specific_force_g: Vector3<f64>,
    /// The RMS length of what the low-pass removed.
    pub motion_rms_g: f64,
    /// Whether nearly all of the kernel's mass lies on one side of the image's time.
    pub one_sided: bool,
}

/// With fewer samples than this within one kernel SD of the image, gravity is not known.
const MIN_CENTRAL_SAMPLES: usize = 5;
/// The kernel is cut off at this many of its SDs (weight 0.011).
const KERNEL_REACH_SD: f64 = 3.0;
/// Steps between samples, and between a sample and the image, that are longer than this many kernel SDs are not bridged:
/// what lies beyond says nothing about gravity here. (5 samples in two SDs leave steps of 0.5 SD at most, so that slow
/// sensors pass.)
const BRIDGE_SD: f64 = 0.5;
/// Samples that span less than this many kernel SDs cannot tell a turn from a bump.
const MIN_SPAN_SD: f64 = 1.0;
/// A side with less than this part of the kernel's mass is missing.
const MIN_SIDE: f64 = 0.25;
/// Residuals longer than this many SDs (of one axis) count less: Huber's weights (Huber 1981), with a knee that lets
/// three-dimensional Gaussian noise pass (longer than this: 6 in 1000).
const HUBER_SD: f64 = 3.5;
/// The median length of a three-dimensional Gaussian residual, in SDs of one axis.
const MEDIAN_LENGTH_SD: f64 = 1.538;
/// The number of rounds of reweighting. The weights settle to well under the sensor's 1 mg in three.
const ROUNDS: usize = 4;

/// The SD of the Gaussian kernel whose frequency response exp(-(tau f)^2 sd^2 / 2) is -3 dB at `cutoff_hz`.
fn kernel_sd_s(cutoff_hz: f64) -> f64 {
    LN_2.sqrt() / (TAU * cutoff_hz)
}

/// The longest time between an image and a sample that counts for it.
pub(super) fn half_window_s(cutoff_hz: f64) -> f64 {
    KERNEL_REACH_SD * kernel_sd_s(cutoff_hz)
}

/// Gravity at `time` from the samples within [`half_window_s`] of it, in the order of time.
///
/// A line in time is fitted with the kernel's weights, and its value at the image's time is taken (local linear regression,
/// Fan & Gijbels 1996). Where samples lie on both sides alike, that value is the kernel's mean. Where one side is missing, a
/// mean would be the gravity of another moment, but the line is not: a steady turn keeps zero phase up to the edge. The fit
/// works on true sample times, so holes and uneven steps need no resampling; samples beyond a gap are left out
/// ([`BRIDGE_SD`]). Samples far from the line (a bump) count less, by Huber's weights on the length of the residual.
pub(super) fn gravity_at(time: UtcNs, samples: &[(UtcNs, Vector3<f64>)], cutoff_hz: f64) -> Option<Gravity> {
    let sd_s = kernel_sd_s(cutoff_hz);
    let samples = without_gaps(time, samples, BRIDGE_SD * sd_s);
    let (first, last) = (samples.first()?.0, samples.last()?.0);
    let central = samples.iter().filter(|(t, _)| t.seconds_since(time).abs() <= sd_s).count();
    if central < MIN_CENTRAL_SAMPLES || last.seconds_since(first) < MIN_SPAN_SD * sd_s {
        return None;
    }
    let kernel: Vec<f64> = samples.iter().map(|(t, _)| (-0.5 * (t.seconds_since(time) / sd_s).powi(2)).exp()).collect();
    let mass: f64 = kernel.iter().sum();
    let line = robust_line(time, samples, &kernel)?;
    let specific_force_g = line.at_zero;
    let squares: f64 = samples.iter().zip(&kernel).map(|((_, a), w)| w * (a - specific_force_g).norm_squared()).sum();
    let before: f64 = samples.iter().zip(&kernel).filter(|((t, _), _)| *t <= time).map(|(_, w)| w / mass).sum();
    let one_sided = !(MIN_SIDE..=1.0 - MIN_SIDE).contains(&before);
    let motion_rms_g = (squares / mass).sqrt();
    specific_force_g.iter().all(|c| c.is_finite()).then_some(Gravity { specific_force_g, motion_rms_g, one_sided })
}

/// The samples that are connected with `time` by steps of at most `bridge_s`.
fn without_gaps<T>(time: UtcNs, samples: &[(UtcNs, T)], bridge_s: f64) -> &[(UtcNs, T)] {
    let image_at = samples.partition_point(|(t, _)| *t <= time);
    let (before, after) = samples.split_at(image_at);
    let connected = |near: &mut UtcNs, t: UtcNs| {
        let step_s = t.seconds_since(*near).abs();
        *near = t;
        step_s <= bridge_s
    };
    let mut near = time;
    let taken_before = before.iter().rev().take_while(|(t, _)| connected(&mut near, *t)).count();
    near = time;
    let taken_after = after.iter().take_while(|(t, _)| connected(&mut near, *t)).count();
    &samples[image_at - taken_before..image_at + taken_after]
}

fn robust_line(time: UtcNs, samples: &[(UtcNs, Vector3<f64>)], kernel: &[f64]) -> Option<Line> {
    let seconds: Vec<f64> = samples.iter().map(|(t, _)| t.seconds_since(time)).collect();
    let mut weights = kernel.to_vec();
    let mut line = Line::fit(&seconds, samples, &weights)?;
    for _ in 0..ROUNDS {
        let residuals = samples.iter().zip(&seconds).map(|((_, a), s)| (a - line.value_at(*s)).norm());
        let lengths: Vec<f64> = residuals.collect();
        let limit = HUBER_SD * median(lengths.clone()) / MEDIAN_LENGTH_SD;
        for ((weight, kernel), length) in weights.iter_mut().zip(kernel).zip(&lengths) {
            *weight = if *length > limit { kernel * limit / length } else { *kernel };
        }
        // Where more than half of the samples lie on the line exactly, the limit is 0, and so all weights may be: the line
        // then stands.
        let Some(next) = Line::fit(&seconds, samples, &weights) else { break };
        line = next;
    }
    Some(line)
}
