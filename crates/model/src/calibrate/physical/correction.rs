//! Corrections of the readings of a device.

use nalgebra::{Rotation3, Vector3};

use crate::camera::Camera;
use crate::pose::Pose;
use crate::view::View;

/// Corrections of readings. All zero is no correction.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Correction {
    /// Angle that is added to that of the camera on the device. It includes the error of the accelerometer's pitch: a bench
    /// cannot tell the two apart, and no size depends on which of them it is.
    pub mount_rad: f64,
    /// Scale of the range: true range = reading (1 + `range_scale`) + `range_offset_mm`.
    pub range_scale: f64,
    /// Offset of the range, in the same equation.
    pub range_offset_mm: f64,
    /// Scale of the focal length: true focal length = the camera's (1 + `focal_share`).
    pub focal_share: f64,
}

impl Correction {
    /// The view after the correction; `None` where no such pose or camera exists.
    #[must_use]
    pub fn apply(&self, view: &View) -> Option<View> {
        let (pose, camera) = (view.pose(), view.camera());
        let turn = Rotation3::from_axis_angle(&Vector3::x_axis(), self.mount_rad);
        let (pitch_rad, roll_rad) = Pose::pitch_roll_of_down(&(turn * pose.down_in_camera())).ok()?;
        let range_mm = pose.range_mm() * (1.0 + self.range_scale) + self.range_offset_mm;
        let focal_px = camera.focal_px().map(|f| f * (1.0 + self.focal_share));
        let camera =
            Camera::new(camera.size_px(), focal_px, camera.principal_px(), camera.skew_px(), *camera.lens()).ok()?;
        Some(View::new(camera, Pose::new(pitch_rad, roll_rad, range_mm).ok()?))
    }

    /// The correction with these values, in the order of [`Self::values`].
    pub(super) fn from_values(values: &[f64; 4]) -> Self {
        let [mount_rad, range_scale, range_offset_mm, focal_share] = *values;
        Self { mount_rad, range_scale, range_offset_mm, focal_share }
    }

    /// The four values, in the order of [`LEARNED`](crate::LEARNED).
    #[must_use]
    pub fn values(&self) -> [f64; 4] {
        [self.mount_rad, self.range_scale, self.range_offset_mm, self.focal_share]
    }
}
