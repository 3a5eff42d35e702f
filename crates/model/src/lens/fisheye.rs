//! The Kannala-Brandt model, which is OpenCV's fisheye model.

use std::f64::consts::PI;

use nalgebra::{Matrix3x2, Point2, RowVector2, Vector2, Vector3};

use super::{LensError, radius};
use crate::polynomial::{evaluate, first_root, solve_increasing};

/// The Kannala-Brandt model with the four coefficients of OpenCV's `cv::fisheye`: distorted radius = t (1 + k1 t^2 + k2 t^4
/// + k3 t^6 + k4 t^8), where t is the angle of the ray from the optical axis in radians. Rays beyond 90 degrees are allowed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Fisheye {
    /// Coefficient of t^3.
    pub k1: f64,
    /// Coefficient of t^5.
    pub k2: f64,
    /// Coefficient of t^7.
    pub k3: f64,
    /// Coefficient of t^9.
    pub k4: f64,
}

impl Fisheye {
    /// The largest angle from the axis, in radians, up to which the distorted radius grows with the angle.
    #[must_use]
    pub fn angle_limit_rad(&self) -> f64 {
        let slope_in_t2 = [1.0, 3.0 * self.k1, 5.0 * self.k2, 7.0 * self.k3, 9.0 * self.k4];
        first_root(&slope_in_t2, PI * PI).map_or(PI, f64::sqrt)
    }

    pub(super) fn distorted_of_ray(&self, ray: &Vector3<f64>) -> Result<Point2<f64>, LensError> {
        let across = ray.x.hypot(ray.y);
        let (angle_rad, limit) = (across.atan2(ray.z), self.angle_limit_rad());
        if angle_rad > limit {
            return Err(LensError::IdealBeyondRange { radius: angle_rad, limit });
        }
        if across <= 0.0 {
            return Ok(Point2::origin());
        }
        Ok(Point2::new(ray.x, ray.y) * (self.distorted_radius(angle_rad) / across))
    }

    pub(super) fn ray_of_distorted(&self, distorted: Point2<f64>) -> Result<Vector3<f64>, LensError> {
        let (r, limit_rad) = (radius(distorted), self.angle_limit_rad());
        let limit = self.distorted_radius(limit_rad);
        if r > limit {
            return Err(LensError::ImageBeyondRange { radius: r, limit });
        }
        if r <= 0.0 {
            return Ok(Vector3::z());
        }
        let (sin, cos) = solve_increasing(|t| self.distorted_radius(t), r, 0.0, limit_rad).sin_cos();
        Ok(Vector3::new(distorted.x / r * sin, distorted.y / r * sin, cos))
    }

    /// Derivative of [`Self::ray_of_distorted`] by the distorted point. The rays have length 1: along the radius a ray turns
    /// by dt/dr, across it by sin(t) / r.
    pub(super) fn ray_by_distorted(
        &self,
        distorted: Point2<f64>,
        ray: &Vector3<f64>,
    ) -> Result<Matrix3x2<f64>, LensError> {
        let r = radius(distorted);
        if r <= f64::MIN_POSITIVE {
            return Ok(Matrix3x2::identity()); // t = r to first order
        }
        let (sin, cos) = (ray.x.hypot(ray.y), ray.z);
        let angle_rad = sin.atan2(cos);
        let slope = evaluate(&[1.0, 3.0 * self.k1, 5.0 * self.k2, 7.0 * self.k3, 9.0 * self.k4], angle_rad * angle_rad);
        if slope <= 0.0 {
            return Err(LensError::NotFinite);
        }
        let along = Vector2::new(distorted.x / r, distorted.y / r);
        let across = Vector2::new(-along.y, along.x);
        let by_radius = Vector3::new(along.x * cos, along.y * cos, -sin) / slope;
        let by_turn = Vector3::new(across.x, across.y, 0.0) * (sin / r);
        Ok(by_radius * RowVector2::new(along.x, along.y) + by_turn * RowVector2::new(across.x, across.y))
    }

    fn distorted_radius(&self, angle_rad: f64) -> f64 {
        angle_rad * evaluate(&[1.0, self.k1, self.k2, self.k3, self.k4], angle_rad * angle_rad)
    }
}
