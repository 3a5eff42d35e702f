//! The one-parameter division model.

use nalgebra::Point2;

use super::{LensError, radius};

/// Fitzgibbon's division model (CVPR 2001): ideal = distorted / (1 + lambda `r_d`^2), `r_d` the *distorted* radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Division {
    /// Coefficient for radii in focal lengths; negative for a barrel.
    pub lambda: f64,
}

impl Division {
    /// Largest distorted radius with an ideal point: the horizon of a barrel (lambda < 0), the fold of a pincushion.
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

    /// The branch through zero of lambda r r_d^2 - r_d + r = 0.
    pub(super) fn distort(&self, ideal: Point2<f64>) -> Result<Point2<f64>, LensError> {
        let r = radius(ideal);
        let discriminant = 1.0 - 4.0 * self.lambda * r * r;
        if discriminant < 0.0 {
            return Err(LensError::IdealBeyondRange { radius: r, limit: 0.5 * self.distorted_limit() });
        }
        Ok(ideal * (2.0 / (1.0 + discriminant.sqrt())))
    }
}
