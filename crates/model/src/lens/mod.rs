//! Lens models, which map the direction of a ray to the normalised image point where a real lens shows it, and back.
//!
//! Normalised coordinates are image coordinates divided by the focal length: a lens without distortion shows the ray
//! (x, y, 1) at (x, y). The 'ideal' point is where such a lens would show a ray, the 'distorted' point where the real lens
//! shows it.

mod division;
mod fisheye;
mod plumb_bob;
mod radial;

pub use division::Division;
pub use fisheye::Fisheye;
pub use plumb_bob::PlumbBob;
pub use radial::Radial;

use nalgebra::{Matrix2, Matrix3x2, Point2, Vector3};

/// A lens model with its coefficients, all of them for normalised coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LensModel {
    /// No distortion.
    None,
    /// One radial coefficient: the paper's Eq. (3).
    Radial(Radial),
    /// The division model with one coefficient, which fits wide lenses far better than [`Self::Radial`] does.
    Division(Division),
    /// Brown-Conrady with five coefficients, as in OpenCV and ROS.
    PlumbBob(PlumbBob),
    /// Kannala-Brandt with four coefficients, as in OpenCV's fisheye module.
    Fisheye(Fisheye),
}

/// The reason why a lens model has no answer for a point.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum LensError {
    /// The ray points sideways or backwards, where this model shows nothing.
    #[error("the point is not in front of the camera")]
    NotInFront,
    /// The ideal point lies where the model has folded back on itself.
    #[error(
        "no such point: ideal radius {radius:.4} is beyond the lens model's monotone range (limit {limit:.4}, in focal lengths)"
    )]
    IdealBeyondRange {
        /// The radius that was asked for, in focal lengths (for a fisheye the angle from the axis, in radians).
        radius: f64,
        /// The largest radius with an answer, in the same unit.
        limit: f64,
    },
    /// The image point lies outside everything that the model can show.
    #[error(
        "no such point: image radius {radius:.4} is beyond what the lens model can show (limit {limit:.4}, in focal lengths)"
    )]
    ImageBeyondRange {
        /// The radius that was asked for, in focal lengths.
        radius: f64,
        /// The largest radius with an answer, in focal lengths.
        limit: f64,
    },
    /// The coordinates are not finite numbers.
    #[error("the coordinates are not finite numbers")]
    NotFinite,
}

impl LensModel {
    /// The normalised image point where the lens shows a ray. `ray`: a direction in the camera frame, of any length.
    ///
    /// # Errors
    /// [`LensError`] when the lens does not show that direction.
    pub fn distorted_of_ray(&self, ray: &Vector3<f64>) -> Result<Point2<f64>, LensError> {
        if !ray.iter().all(|c| c.is_finite()) {
            return Err(LensError::NotFinite);
        }
        if let Self::Fisheye(lens) = self {
            return lens.distorted_of_ray(ray);
        }
        if ray.z <= 0.0 {
            return Err(LensError::NotInFront);
        }
        let ideal = Point2::new(ray.x / ray.z, ray.y / ray.z);
        require_finite(match self {
            Self::None | Self::Fisheye(_) => ideal,
            Self::Radial(lens) => lens.distort(ideal)?,
            Self::Division(lens) => lens.distort(ideal)?,
            Self::PlumbBob(lens) => lens.distort(ideal)?,
        })
    }

    /// The ray that the lens shows at a normalised image point: a direction in the camera frame, of any length.
    ///
    /// # Errors
    /// [`LensError`] when no ray is shown there.
    pub fn ray_of_distorted(&self, distorted: Point2<f64>) -> Result<Vector3<f64>, LensError> {
        if !distorted.iter().all(|c| c.is_finite()) {
            return Err(LensError::NotFinite);
        }
        let ideal = require_finite(match self {
            Self::None => distorted,
            Self::Radial(lens) => lens.undistort(distorted)?,
            Self::Division(lens) => lens.undistort(distorted)?,
            Self::PlumbBob(lens) => lens.undistort(distorted)?,
            Self::Fisheye(lens) => return lens.ray_of_distorted(distorted),
        })?;
        Ok(Vector3::new(ideal.x, ideal.y, 1.0))
    }

    /// [`Self::ray_of_distorted`] with its derivative by the image point, in closed form: the ray has exactly the length
    /// that the derivative belongs to.
    ///
    /// # Errors
    /// [`LensError`] when no ray is shown there, or when the model folds there.
    pub fn ray_and_derivative(&self, distorted: Point2<f64>) -> Result<(Vector3<f64>, Matrix3x2<f64>), LensError> {
        let ray = self.ray_of_distorted(distorted)?;
        let ideal = Point2::new(ray.x, ray.y);
        let by_image = match self {
            Self::None => Matrix2::identity(),
            Self::Radial(lens) => finite_inverse(&lens.distorted_by_ideal(ideal))?,
            Self::Division(lens) => lens.ideal_by_distorted(distorted),
            Self::PlumbBob(lens) => finite_inverse(&lens.jacobian(ideal))?,
            Self::Fisheye(lens) => return Ok((ray, lens.ray_by_distorted(distorted, &ray)?)),
        };
        let mut derivative = Matrix3x2::zeros();
        derivative.fixed_view_mut::<2, 2>(0, 0).copy_from(&by_image);
        Ok((ray, derivative))
    }
}

/// The inverse of a lens's Jacobian; [`LensError::NotFinite`] where the model folds and there is none.
fn finite_inverse(forward: &Matrix2<f64>) -> Result<Matrix2<f64>, LensError> {
    forward.try_inverse().filter(|m| m.iter().all(|c| c.is_finite())).ok_or(LensError::NotFinite)
}

/// `point` unless it overflowed, as it does for a ray that is nearly sideways or for a coefficient far too large.
fn require_finite(point: Point2<f64>) -> Result<Point2<f64>, LensError> {
    if point.iter().all(|c| c.is_finite()) { Ok(point) } else { Err(LensError::NotFinite) }
}

fn radius(point: Point2<f64>) -> f64 {
    point.x.hypot(point.y)
}
