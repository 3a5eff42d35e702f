//! The Brown-Conrady model, which OpenCV and ROS call 'plumb bob'.

use nalgebra::{Matrix2, Point2, Vector2};

use super::{LensError, radius};
use crate::polynomial::{evaluate, first_root, solve_increasing};

/// The Brown-Conrady model with the five coefficients of OpenCV's `distCoeffs`: three radial, two tangential.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PlumbBob {
    /// Radial coefficient of r^2.
    pub k1: f64,
    /// Radial coefficient of r^4.
    pub k2: f64,
    /// Tangential coefficient, with 2 x y in x.
    pub p1: f64,
    /// Tangential coefficient, with 2 x y in y.
    pub p2: f64,
    /// Radial coefficient of r^6.
    pub k3: f64,
}

/// The monotone range is not followed beyond this ideal radius, in focal lengths: 89.4 degrees from the axis.
const WIDEST_IDEAL_RADIUS: f64 = 100.0;
/// Bound of the Newton steps. They converge quadratically from the radial solution, so this many are never needed.
const MAX_STEPS: usize = 50;
/// A Newton step that is still too long after this many halvings does not come nearer.
const MAX_HALVINGS: i32 = 30;

impl PlumbBob {
    /// The largest ideal radius, in focal lengths, within which the model is certain to be one-to-one.
    ///
    /// The Jacobian is symmetric. Its radial part has the eigenvalues a = 1 + 3 k1 r^2 + 5 k2 r^4 + 7 k3 r^6 (along the
    /// radius) and b = 1 + k1 r^2 + k2 r^4 + k3 r^6 (across); its tangential part has a norm of at most 6 |p| r. While a
    /// and b exceed that, the Jacobian is positive definite, so the model is the gradient of a convex function and takes
    /// no value twice. Without tangential terms the limit is where the model folds back; with them it lies a little before.
    #[must_use]
    pub fn ideal_limit(&self) -> f64 {
        let tangential = self.p1.hypot(self.p2);
        if tangential <= 0.0 {
            // Where a > 0 up to r, its mean over (0, r), which is b, is above 0 as well.
            let along_in_r2 = [1.0, 3.0 * self.k1, 5.0 * self.k2, 7.0 * self.k3];
            return first_root(&along_in_r2, WIDEST_IDEAL_RADIUS.powi(2)).map_or(WIDEST_IDEAL_RADIUS, f64::sqrt);
        }
        let along = [1.0, -6.0 * tangential, 3.0 * self.k1, 0.0, 5.0 * self.k2, 0.0, 7.0 * self.k3];
        let across = [1.0, -6.0 * tangential, self.k1, 0.0, self.k2, 0.0, self.k3];
        let first = |coefficients| first_root(coefficients, WIDEST_IDEAL_RADIUS).unwrap_or(WIDEST_IDEAL_RADIUS);
        first(&along).min(first(&across))
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
            let Some(nearer) = self.newton_step(ideal, distorted) else { break };
            ideal = nearer;
        }
        let solved = (self.apply(ideal) - distorted).norm() <= 1e-11 * (1.0 + target);
        if solved && radius(ideal) <= limit * (1.0 + 1e-9) {
            Ok(ideal)
        } else {
            Err(LensError::ImageBeyondRange { radius: target, limit: radial(limit) })
        }
    }

    /// The ideal point after one step of Newton's method, halved until it comes nearer; `None` when no step does.
    fn newton_step(&self, ideal: Point2<f64>, distorted: Point2<f64>) -> Option<Point2<f64>> {
        let residual = self.apply(ideal) - distorted;
        let step = self.jacobian(ideal).try_inverse()? * residual;
        (0..MAX_HALVINGS)
            .map(|halvings| ideal - step * 0.5_f64.powi(halvings))
            .find(|candidate| (self.apply(*candidate) - distorted).norm() < residual.norm())
    }

    /// The factor by which the radial terms stretch an ideal point of squared radius `r2`.
    fn radial_factor(&self, r2: f64) -> f64 {
        evaluate(&[1.0, self.k1, self.k2, self.k3], r2)
    }

    /// The distorted point of an ideal one, whether or not it lies in the monotone range.
    fn apply(&self, ideal: Point2<f64>) -> Point2<f64> {
        let (x, y) = (ideal.x, ideal.y);
        let r2 = x * x + y * y;
        let tangential = Vector2::new(
            2.0 * self.p1 * x * y + self.p2 * (r2 + 2.0 * x * x),
            self.p1 * (r2 + 2.0 * y * y) + 2.0 * self.p2 * x * y,
        );
        ideal * self.radial_factor(r2) + tangential
    }

    /// Derivative of the distorted point by the ideal one, which is symmetric.
    pub(super) fn jacobian(&self, ideal: Point2<f64>) -> Matrix2<f64> {
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
