//! Brown-Conrady, the 'plumb bob' model of OpenCV and ROS.

use nalgebra::{Matrix2, Point2, Vector2};

use super::{LensError, radius};
use crate::polynomial::{evaluate, first_root, solve_increasing};

/// OpenCV's five coefficients (`calib3d`, 'distCoeffs'): three radial, two tangential.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PlumbBob {
    /// Radial, r^2.
    pub k1: f64,
    /// Radial, r^4.
    pub k2: f64,
    /// Tangential, with 2 x y in x.
    pub p1: f64,
    /// Tangential, with 2 x y in y.
    pub p2: f64,
    /// Radial, r^6.
    pub k3: f64,
}

/// Ideal radii beyond this (89.4 degrees from the axis) are not looked for.
const WIDEST_IDEAL_RADIUS: f64 = 100.0;
/// Newton steps; it converges quadratically from the radial solution, so this many are never needed.
const MAX_STEPS: usize = 50;

impl PlumbBob {
    /// Largest ideal radius of the monotone range of the radial part.
    #[must_use]
    pub fn ideal_limit(&self) -> f64 {
        let slope_in_r2 = [1.0, 3.0 * self.k1, 5.0 * self.k2, 7.0 * self.k3];
        first_root(&slope_in_r2, WIDEST_IDEAL_RADIUS.powi(2)).map_or(WIDEST_IDEAL_RADIUS, f64::sqrt)
    }

    pub(super) fn distort(&self, ideal: Point2<f64>) -> Result<Point2<f64>, LensError> {
        let (r, limit) = (radius(ideal), self.ideal_limit());
        if r > limit {
            return Err(LensError::IdealBeyondRange { radius: r, limit });
        }
        Ok(self.apply(ideal))
    }

    pub(super) fn undistort(&self, distorted: Point2<f64>) -> Result<Point2<f64>, LensError> {
        let limit = self.ideal_limit();
        let target = radius(distorted);
        let radial = |r: f64| r * self.radial_factor(r * r);
        let start = solve_increasing(radial, target.min(radial(limit)), 0.0, limit);
        let mut ideal = if target > 0.0 { distorted * (start / target) } else { distorted };
        for _ in 0..MAX_STEPS {
            let residual = self.apply(ideal) - distorted;
            let Some(step) = self.jacobian(ideal).try_inverse().map(|inverse| inverse * residual) else { break };
            ideal -= step;
            if !step.norm().is_finite() || step.norm() <= 1e-15 * (1.0 + radius(ideal)) {
                break;
            }
        }
        let solved = (self.apply(ideal) - distorted).norm() <= 1e-11 * (1.0 + target);
        if solved && radius(ideal) <= limit && self.jacobian(ideal).determinant() > 0.0 {
            Ok(ideal)
        } else {
            Err(LensError::ImageBeyondRange { radius: target, limit: radial(limit) })
        }
    }

    fn radial_factor(&self, r2: f64) -> f64 {
        evaluate(&[1.0, self.k1, self.k2, self.k3], r2)
    }

    fn apply(&self, ideal: Point2<f64>) -> Point2<f64> {
        let (x, y) = (ideal.x, ideal.y);
        let r2 = x * x + y * y;
        let tangential = Vector2::new(
            2.0 * self.p1 * x * y + self.p2 * (r2 + 2.0 * x * x),
            self.p1 * (r2 + 2.0 * y * y) + 2.0 * self.p2 * x * y,
        );
        ideal * self.radial_factor(r2) + tangential
    }

    fn jacobian(&self, ideal: Point2<f64>) -> Matrix2<f64> {
        let (x, y) = (ideal.x, ideal.y);
        let r2 = x * x + y * y;
        let factor = self.radial_factor(r2);
        let slope = 2.0 * evaluate(&[self.k1, 2.0 * self.k2, 3.0 * self.k3], r2); // d factor = slope (x dx + y dy)
        let mixed = slope * x * y + 2.0 * self.p1 * x + 2.0 * self.p2 * y;
        Matrix2::new(
            factor + slope * x * x + 2.0 * self.p1 * y + 6.0 * self.p2 * x,
            mixed,
            mixed,
            factor + slope * y * y + 6.0 * self.p1 * y + 2.0 * self.p2 * x,
        )
    }
}
