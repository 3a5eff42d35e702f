//! The lag of the images' clock against the sensors', from motion that both saw.
//!
//! Between two pictures the head turns, and the picture changes. The rotation of gravity between the same two moments agrees
//! with that change if the moments really are the same. The lag is where the two agree best.

mod picture;
mod rank;
mod search;
#[cfg(test)]
mod tests;

use ingest::{ReadError, Sample, SessionReader};
use model::UtcNs;
use nalgebra::Vector3;

pub use picture::change;
pub use search::{LagEstimate, LagVerdict, PairMotion, estimate};

use super::window::Windows;

/// Lags are looked for from minus this to plus this.
const REACH_S: f64 = 10.0;
/// The step of the grid of lags.
const STEP_S: f64 = 0.1;
/// The number of points of the grid.
pub(crate) const LAGS: usize = 201;
/// Gravity at a moment is the mean over this many seconds on both sides of it.
const SMOOTH_S: f64 = 0.25;
/// With fewer samples the direction is not known.
const MIN_SAMPLES: usize = 5;

/// The lag of point `i` of the grid.
#[expect(clippy::cast_precision_loss, reason = "an index of the grid")]
pub(crate) fn lag_s(i: usize) -> f64 {
    i as f64 * STEP_S - REACH_S
}

/// The direction of gravity at an image's time plus each lag of the grid, where it is known.
pub(crate) type Directions = Vec<Option<Vector3<f64>>>;

/// The directions of gravity around each of `image_times`, which must be in order. One pass over the samples; memory grows
/// with the number of images given (5 kB each).
///
/// # Errors
/// [`ReadError`] when the session's samples cannot be read.
pub(crate) fn directions(reader: &mut SessionReader, image_times: &[UtcNs]) -> Result<Vec<Directions>, ReadError> {
    let mut windows = Windows::new(image_times, REACH_S + SMOOTH_S, around);
    reader.for_each_sample(|sample| {
        if let Sample::Acceleration { time, g } = sample {
            windows.push(time, Vector3::from(g));
        }
    })?;
    Ok(windows.finish())
}

fn around(time: UtcNs, samples: &[(UtcNs, Vector3<f64>)]) -> Directions {
    let (mut first, mut end) = (0, 0);
    let mut sum = Vector3::zeros();
    (0..LAGS)
        .map(|i| {
            let center = time.plus_seconds(lag_s(i));
            while end < samples.len() && samples[end].0.seconds_since(center) <= SMOOTH_S {
                sum += samples[end].1;
                end += 1;
            }
            while first < end && center.seconds_since(samples[first].0) > SMOOTH_S {
                sum -= samples[first].1;
                first += 1;
            }
            (end - first >= MIN_SAMPLES).then(|| sum.try_normalize(0.1)).flatten()
        })
        .collect()
}
