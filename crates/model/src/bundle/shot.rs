//! A camera at a place and heading above the table.

use nalgebra::{Matrix3, Point2, Rotation2, Vector3};

use super::{BundleShot, SolvedShot};
use crate::pose::{Pose, PoseError};

/// The number of parameters of a shot.
pub(super) const SHOT: usize = 6;

/// Pitch, roll, turn (radians), x, y of the point under the camera, and the camera's height (mm).
pub(super) type ShotParameters = [f64; SHOT];

/// A camera of which everything is worked out that projections need.
pub(super) struct Stand {
    /// From the common frame to the camera's: the rows of its transpose are the common axes in the camera frame.
    common_from_camera: Matrix3<f64>,
    foot_mm: Point2<f64>,
    height_mm: f64,
}

pub(super) fn parameters(shot: &BundleShot) -> ShotParameters {
    let BundleShot { sensed, turn_rad, foot_mm } = shot;
    [sensed.pitch_rad(), sensed.roll_rad(), *turn_rad, foot_mm.x, foot_mm.y, sensed.camera_height_mm()]
}

pub(super) fn solved(
    [pitch_rad, roll_rad, turn_rad, x, y, height_mm]: ShotParameters,
) -> Result<SolvedShot, PoseError> {
    let pose = Pose::new(pitch_rad, roll_rad, height_mm / pitch_rad.sin())?;
    Ok(SolvedShot { pose, turn_rad, foot_mm: Point2::new(x, y) })
}

impl SolvedShot {
    /// The point of the common frame at the height `z_mm` that an ideal ray of the picture meets; none where it does not descend to it.
    #[must_use]
    pub fn on_level(&self, ray: &Vector3<f64>, z_mm: f64) -> Option<Point2<f64>> {
        let Self { pose, turn_rad, foot_mm } = self;
        let height_mm = pose.camera_height_mm();
        let stand = Stand::new(&[pose.pitch_rad(), pose.roll_rad(), *turn_rad, foot_mm.x, foot_mm.y, height_mm]);
        Some(stand.on_level(ray, z_mm)?.0)
    }
}

impl Stand {
    pub fn new([pitch_rad, roll_rad, turn_rad, x, y, height_mm]: &ShotParameters) -> Self {
        let (sin_pitch, cos_pitch) = pitch_rad.sin_cos();
        let (sin_roll, cos_roll) = roll_rad.sin_cos();
        // The rows are right, forward and up, as in Pose::world_from_camera.
        let own_from_camera = Matrix3::new(
            cos_roll,
            -sin_roll,
            0.0,
            -sin_roll * sin_pitch,
            -cos_roll * sin_pitch,
            cos_pitch,
            -sin_roll * cos_pitch,
            -cos_roll * cos_pitch,
            -sin_pitch,
        );
        let common_from_own = Rotation2::new(*turn_rad).into_inner().to_homogeneous();
        Self {
            common_from_camera: common_from_own * own_from_camera,
            foot_mm: Point2::new(*x, *y),
            height_mm: *height_mm,
        }
    }

    /// The ideal image point (x, y) of a point of the table; none behind the camera.
    pub fn image_of(&self, on_table_mm: Point2<f64>) -> Option<[f64; 2]> {
        let from_camera = on_table_mm - self.foot_mm;
        let ray = self.common_from_camera.tr_mul(&Vector3::new(from_camera.x, from_camera.y, -self.height_mm));
        (ray.z > 0.0).then(|| [ray.x / ray.z, ray.y / ray.z])
    }

    /// The point at the height `z_mm` that a ray meets, and the length of the ray to it, in mm; none where it does not descend to it.
    pub fn on_level(&self, ray: &Vector3<f64>, z_mm: f64) -> Option<(Point2<f64>, f64)> {
        let ray = self.common_from_camera * ray;
        let stretch = (z_mm - self.height_mm) / ray.z;
        (stretch > 0.0 && stretch.is_finite()).then(|| (self.foot_mm + ray.xy() * stretch, stretch * ray.norm()))
    }
}
