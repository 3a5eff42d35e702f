//! The paper's lens model, with one radial coefficient.

use nalgebra::{Matrix2, Point2};

use super::{LensError, radius};

/// A radius at the very limit may exceed it by rounding. Up to this factor it counts as the limit.
const ROUNDING: f64 = 1.0 + 4.0 * f64::EPSILON;

/// The lens of Eq. (3): distorted = ideal (1 + k1 r^2), where r is the *ideal* radius.
///
/// The paper's `K_c` is per mm^2 on the sensor; in normalised coordinates k1 = `K_c` f^2. (Eq. (4) uses the same letter
/// for the skew of the pixel grid, which is another parameter.)
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Radial {
    /// The coefficient for radii in focal lengths.
    pub k1: f64,
}

impl Radial {
    /// The largest ideal radius of the monotone range, in focal lengths: beyond it the model folds back on itself. It is
    /// infinite for k1 >= 0.
    #[must_use]
    pub fn ideal_limit(&self) -> f64 {
        if self.k1 < 0.0 { (-3.0 * self.k1).sqrt().recip() } else { f64::INFINITY }
    }

    pub(super) fn distort(&self, ideal: Point2<f64>) -> Result<Point2<f64>, LensError> {
        let (r, limit) = (radius(ideal), self.ideal_limit());
        if r > limit * ROUNDING {
            return Err(LensError::IdealBeyondRange { radius: r, limit });
        }
        Ok(ideal * (1.0 + self.k1 * r * r)) // Eq. (3)
    }

    /// Derivative of Eq. (3): (1 + k1 r^2) I + 2 k1 p p^T.
    pub(super) fn distorted_by_ideal(&self, ideal: Point2<f64>) -> Matrix2<f64> {
        let r2 = ideal.coords.norm_squared();
        Matrix2::identity() * (1.0 + self.k1 * r2) + ideal.coords * ideal.coords.transpose() * (2.0 * self.k1)
    }

    pub(super) fn undistort(&self, distorted: Point2<f64>) -> Result<Point2<f64>, LensError> {
        let r = radius(distorted);
        if r <= 0.0 {
            return Ok(distorted);
        }
        Ok(distorted * (self.ideal_radius(r)? / r))
    }

    /// The ideal radius of a distorted one, by the exact inverse of Eq. (3): the root of k1 r^3 + r =
    /// `distorted_radius` on the branch through zero, by the trigonometric (k1 < 0) or hyperbolic (k1 > 0) solution of the
    /// depressed cubic.
    fn ideal_radius(&self, distorted_radius: f64) -> Result<f64, LensError> {
        let s = (3.0 * self.k1.abs()).sqrt();
        let argument = 1.5 * s * distorted_radius;
        if argument <= f64::MIN_POSITIVE {
            return Ok(distorted_radius);
        }
        if self.k1 > 0.0 {
            return Ok(2.0 / s * (argument.asinh() / 3.0).sinh());
        }
        if argument > ROUNDING {
            return Err(LensError::ImageBeyondRange { radius: distorted_radius, limit: 2.0 / (3.0 * s) });
        }
        Ok(2.0 / s * (argument.min(1.0).asin() / 3.0).sin())
    }
}
