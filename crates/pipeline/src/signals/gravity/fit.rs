//! A weighted line in time through vectors.

use model::UtcNs;
use nalgebra::Vector3;

/// The line `at_zero + slope * seconds`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line {
    /// The value at the image's time.
    pub at_zero: Vector3<f64>,
    /// The change per second.
    slope: Vector3<f64>,
}

impl Line {
    /// The line by least squares with `weights`; `seconds` are the samples' times from the image's. None without two
    /// different times of some weight.
    pub(super) fn fit(seconds: &[f64], samples: &[(UtcNs, Vector3<f64>)], weights: &[f64]) -> Option<Self> {
        let (mut mass, mut moment, mut sum) = (0.0, 0.0, Vector3::zeros());
        for ((s, (_, a)), w) in seconds.iter().zip(samples).zip(weights) {
            mass += w;
            moment += w * s;
            sum += a * *w;
        }
        let (center_s, mean) = (moment / mass, sum / mass);
        let (mut spread, mut product) = (0.0, Vector3::zeros());
        for ((s, (_, a)), w) in seconds.iter().zip(samples).zip(weights) {
            spread += w * (s - center_s).powi(2);
            product += (a - mean) * (w * (s - center_s));
        }
        let slope = product / spread;
        let usable = mass > 0.0 && spread > 0.0 && slope.iter().all(|c| c.is_finite());
        usable.then(|| Self { at_zero: mean - slope * center_s, slope })
    }

    /// The value `seconds` after the image's time.
    pub(super) fn value_at(&self, seconds: f64) -> Vector3<f64> {
        self.at_zero + self.slope * seconds
    }
}
