//! A worn camera with errors of its own, and its readings.

use model::{Camera, InputSigma, LensModel, Pose, View, lens::Division};
use nalgebra::{Point2, Point3, Rotation3, Vector2, Vector3};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::scene::Seen;

/// A Gaussian number with mean 0 and the SD `sigma`.
pub(super) fn draw(random: &mut ChaCha8Rng, sigma: f64) -> f64 {
    sigma * Distribution::<f64>::sample(&StandardNormal, random)
}

/// Mount offset of AIM-2.
const MOUNT_RAD: f64 = 21.0 * std::f64::consts::PI / 180.0;

/// A camera with AIM-2's picture size and focal length and a lens of middling distortion. None where these do not make a camera,
/// which does not occur.
pub(super) fn nominal_camera() -> Option<Camera> {
    let lens = LensModel::Division(Division { lambda: -0.12 });
    Camera::new([2592, 1944], [1695.0, 1702.8], [1296.0, 972.0], 0.0, lens).ok()
}

/// A device with the errors that it has for a whole session.
pub(super) struct Device {
    nominal: Camera,
    actual: Camera,
    corner_px: f64,
    /// Zero-g offset, in g, in the device frame.
    offset_g: Vector3<f64>,
    mount_rad: f64,
    range_scale: f64,
    range_offset_mm: f64,
    noise: InputSigma,
}

impl Device {
    /// A device with errors that are drawn with the standard uncertainties `sigma`. Each axis of the accelerometer has an offset of
    /// its own, so pitch and tilt share one uncertainty.
    pub(super) fn draw(random: &mut ChaCha8Rng, sigma: &InputSigma) -> Option<Self> {
        let nominal = nominal_camera()?;
        let scale = 1.0 + draw(random, sigma.focal_relative);
        let focal_px = nominal.focal_px().map(|f| f * scale);
        let principal_px = nominal.principal_px().map(|c| c + draw(random, sigma.principal_px));
        Some(Self {
            nominal,
            actual: Camera::new(nominal.size_px(), focal_px, principal_px, 0.0, *nominal.lens()).ok()?,
            corner_px: draw(random, sigma.distortion_px),
            offset_g: Vector3::from_fn(|_, _| draw(random, sigma.pitch_rad)),
            mount_rad: MOUNT_RAD + draw(random, sigma.mount_rad),
            range_scale: 1.0 + draw(random, sigma.range_relative),
            range_offset_mm: draw(random, sigma.range_offset_mm),
            noise: *sigma,
        })
    }

    /// The pixel at which this device shows a point; none where the point is outside the picture.
    pub(super) fn pixel_of(&self, pose: Pose, in_world_mm: Point3<f64>) -> Option<Point2<f64>> {
        let pixel = View::new(self.actual, pose).pixel_of(in_world_mm).ok()?;
        let [width, height] = self.actual.size_px().map(f64::from);
        let from_axis = pixel.coords - Vector2::from(self.actual.principal_px());
        let corner = Vector2::new(0.5 * width, 0.5 * height).norm();
        let shown = pixel + from_axis * (self.corner_px * from_axis.norm_squared() / corner.powi(3));
        ((0.0..=width).contains(&shown.x) && (0.0..=height).contains(&shown.y)).then_some(shown)
    }

    /// The view that the readings of accelerometer and range sensor give; none where they give no pose.
    pub(super) fn read(&self, random: &mut ChaCha8Rng, pose: Pose) -> Option<View> {
        let about_x = |angle_rad: f64| Rotation3::from_axis_angle(&Vector3::x_axis(), angle_rad);
        let down_in_device = about_x(-self.mount_rad) * pose.down_in_camera();
        let sway = Vector3::from_fn(|_, _| draw(random, self.noise.turn_noise_rad));
        let read_in_camera = about_x(MOUNT_RAD) * (down_in_device + self.offset_g + sway);
        let (pitch_rad, roll_rad) = Pose::pitch_roll_of_down(&read_in_camera).ok()?;
        let noise_mm = self.range_offset_mm + draw(random, self.noise.range_noise_mm);
        let range_mm = (pose.range_mm() * self.range_scale + noise_mm).round();
        Some(View::new(self.nominal, Pose::new(pitch_rad, roll_rad, range_mm).ok()?))
    }

    /// The pixels that a rater marks, each off by the uncertainty of marks; none where the picture does not show all of the points.
    pub(super) fn marked(&self, random: &mut ChaCha8Rng, pose: Pose, seen: &Seen) -> Option<Vec<Point2<f64>>> {
        seen.points_mm
            .iter()
            .map(|point| {
                let off = Vector2::from_fn(|_, _| draw(random, self.noise.mark_px));
                Some(self.pixel_of(pose, *point)? + off)
            })
            .collect()
    }
}
