//! A camera at a pose, which maps pixels to points on level planes and back.

use nalgebra::{Point2, Point3, Vector3};

use crate::camera::Camera;
use crate::lens::LensError;
use crate::pose::Pose;

/// The geometry of one picture: the exact form of the paper's chain (9)-(13), with roll and with any lens.
///
/// In the paper's own frame the origin is where the perpendicular to the optical axis through the camera meets the table,
/// at h = range tan(pitch) (Eq. 10); here it is the point under the camera. Distances on the plane are the same.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    camera: Camera,
    pose: Pose,
}

/// The reason why a pixel has no point on a plane, or a point has no pixel.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ViewError {
    /// The lens model has no answer for the point.
    #[error(transparent)]
    Lens(#[from] LensError),
    /// The ray through the pixel runs level or upwards.
    #[error("the ray through pixel ({x:.1}, {y:.1}) points at or above the horizon and never meets the table")]
    AboveHorizon {
        /// Pixel column.
        x: f64,
        /// Pixel row.
        y: f64,
    },
    /// The plane lies at or above the camera.
    #[error(
        "the plane Z = {plane_z_mm:.1} mm is not below the camera, which is {camera_height_mm:.1} mm above the table"
    )]
    PlaneNotBelowCamera {
        /// Height of the plane above the table.
        plane_z_mm: f64,
        /// Height of the camera above the table.
        camera_height_mm: f64,
    },
}

impl View {
    /// The view of `camera` at `pose`.
    #[must_use]
    pub fn new(camera: Camera, pose: Pose) -> Self {
        Self { camera, pose }
    }

    /// The camera.
    #[must_use]
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// The pose.
    #[must_use]
    pub fn pose(&self) -> &Pose {
        &self.pose
    }

    /// World X and Y, in mm, of the point that `pixel` shows if it lies at the height `plane_z_mm` above the table.
    ///
    /// These are Eq. (11)-(13). The plane Z = H of Eq. (15) is the table as seen from a camera that stands lower by H.
    ///
    /// # Errors
    /// [`ViewError`] when the lens shows nothing there, the ray does not descend, or the plane is not below the camera.
    pub fn on_plane(&self, pixel: Point2<f64>, plane_z_mm: f64) -> Result<Point2<f64>, ViewError> {
        let camera_height_mm = self.pose.camera_height_mm();
        if !plane_z_mm.is_finite() || plane_z_mm >= camera_height_mm {
            return Err(ViewError::PlaneNotBelowCamera { plane_z_mm, camera_height_mm });
        }
        let ray_in_world = self.pose.world_from_camera() * self.camera.ray_through(pixel)?;
        let on_plane_mm = Point2::from(ray_in_world.xy() * ((camera_height_mm - plane_z_mm) / -ray_in_world.z));
        // The point overflows for a ray that is level within rounding.
        if ray_in_world.z >= 0.0 || !on_plane_mm.iter().all(|c| c.is_finite()) {
            return Err(ViewError::AboveHorizon { x: pixel.x, y: pixel.y });
        }
        Ok(on_plane_mm)
    }

    /// The pixel that shows a point of the world frame, given in mm. It may lie outside the picture.
    ///
    /// # Errors
    /// [`ViewError::Lens`] when the lens does not show that direction.
    pub fn pixel_of(&self, in_world_mm: Point3<f64>) -> Result<Point2<f64>, ViewError> {
        let from_camera = Vector3::new(in_world_mm.x, in_world_mm.y, in_world_mm.z - self.pose.camera_height_mm());
        Ok(self.camera.pixel_of(&self.pose.world_from_camera().tr_mul(&from_camera))?)
    }
}
