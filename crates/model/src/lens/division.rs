//! The division model with one coefficient.

use nalgebra::{Matrix2, Point2};

use super::{LensError, radius};

/// Fitzgibbon's division model (CVPR 2001): ideal = distorted / (1 + lambda `r_d`^2), where `r_d` is the *distorted* radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Division {
    /// The coefficient for radii in focal lengths; negative for a barrel distortion.
    pub lambda: f64,
}

impl Division {
    /// The largest distorted radius with an ideal point, in focal lengths: the horizon of a barrel distortion (lambda < 0),
    /// the fold of a pincushion distortion.
    #[must_use]
    pub fn distorted_limit(&self) -> f64 {
        self.lambda.abs().sqrt().recip()
    }

    pub(super) fn undistort(&self, distorted: Point2<f64>) -> Result<Point2<f64>, LensError> {
        let (r, limit) = (radius(distorted), self.distorted_limit());
        if r >= limit {
            return Err(LensError::ImageBeyondRange { radius: r, limit });
        }
        Ok(distorted / (1.0 + self.lambda * r * r))
    }

    /// Derivative of [`Self::undistort`]: I / s - 2 lambda p p^T / s^2 with s = 1 + lambda r^2.
    pub(super) fn ideal_by_distorted(&self, distorted: Point2<f64>) -> Matrix2<f64> {
        let s = 1.0 + self.lambda * distorted.coords.norm_squared();
        let outer = distorted.coords * distorted.coords.transpose();
        Matrix2::identity() / s - outer * (2.0 * self.lambda / (s * s))
    }

    /// The distorted point of an ideal one: the solution of lambda r r_d^2 - r_d + r = 0 on the branch through zero.
    pub(super) fn distort(&self, ideal: Point2<f64>) -> Result<Point2<f64>, LensError> {
        let r = radius(ideal);
        let discriminant = 1.0 - 4.0 * self.lambda * r * r;
        if discriminant < 0.0 {
            return Err(LensError::IdealBeyondRange { radius: r, limit: 0.5 * self.distorted_limit() });
        }
        Ok(ideal * (2.0 / (1.0 + discriminant.sqrt())))
    }
}
