//! Lens models: between the direction of a ray and the normalised image point where a real lens shows it.
//!
//! Normalised coordinates are image coordinates divided by the focal length: a distortion-free lens shows the ray
//! (x, y, 1) at (x, y). 'Ideal' (u) is what such a lens would show, 'distorted' (d) what the real one shows.

mod division;
mod fisheye;
mod plumb_bob;
mod radial;

pub use division::Division;
pub use fisheye::Fisheye;
pub use plumb_bob::PlumbBob;
pub use radial::Radial;

use nalgebra::{Matrix2, Matrix3x2, Point2, Vector3};

/// How a lens bends rays. All coefficients are for normalised coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LensModel {
    /// No distortion.
    None,
    /// One radial parameter, the paper's Eq. (3).
    Radial(Radial),
    /// One-parameter division model: fits wide lenses far better than [`Self::Radial`].
    Division(Division),
    /// Brown-Conrady with five coefficients, as in OpenCV and ROS.
    PlumbBob(PlumbBob),
    /// Kannala-Brandt with four coefficients, as in OpenCV's fisheye module.
    Fisheye(Fisheye),
}

/// Why a lens has no answer for a point.
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
        /// Radius asked for, in focal lengths (for a fisheye the angle from the axis, in radians).
        radius: f64,
        /// Largest radius with an answer.
        limit: f64,
    },
    /// The image point lies outside everything that the model can show.
    #[error(
        "no such point: image radius {radius:.4} is beyond what the lens model can show (limit {limit:.4}, in focal lengths)"
    )]
    ImageBeyondRange {
        /// Radius asked for, in focal lengths.
        radius: f64,
        /// Largest radius with an answer.
        limit: f64,
    },
    /// The coordinates are not finite numbers.
    #[error("the coordinates are not finite numbers")]
    NotFinite,
}

impl LensModel {
    /// Where the lens shows a ray. `ray`: a direction in the camera frame, of any length.
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
        finite(match self {
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
        let ideal = finite(match self {
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
    /// [`LensError`] when no ray is shown there, or the model folds there.
    pub fn ray_and_derivative(&self, distorted: Point2<f64>) -> Result<(Vector3<f64>, Matrix3x2<f64>), LensError> {
        let ray = self.ray_of_distorted(distorted)?;
        let ideal = Point2::new(ray.x, ray.y);
        let by_image = match self {
            Self::None => Matrix2::identity(),
            Self::Radial(lens) => inverse(&lens.distorted_by_ideal(ideal))?,
            Self::Division(lens) => lens.ideal_by_distorted(distorted),
            Self::PlumbBob(lens) => inverse(&lens.jacobian(ideal))?,
            Self::Fisheye(lens) => return Ok((ray, lens.ray_by_distorted(distorted, &ray)?)),
        };
        let mut derivative = Matrix3x2::zeros();
        derivative.fixed_view_mut::<2, 2>(0, 0).copy_from(&by_image);
        Ok((ray, derivative))
    }
}

/// Where a lens folds its Jacobian has no inverse.
fn inverse(forward: &Matrix2<f64>) -> Result<Matrix2<f64>, LensError> {
    forward.try_inverse().filter(|m| m.iter().all(|c| c.is_finite())).ok_or(LensError::NotFinite)
}

/// Refuses what overflowed: a ray all but sideways, or a coefficient beyond all sense.
fn finite(point: Point2<f64>) -> Result<Point2<f64>, LensError> {
    if point.iter().all(|c| c.is_finite()) { Ok(point) } else { Err(LensError::NotFinite) }
}

fn radius(point: Point2<f64>) -> f64 {
    point.x.hypot(point.y)
}
