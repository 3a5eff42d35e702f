//! The paper's equations (8)-(15), written out as printed, with which the exact form in `View` is compared.
//!
//! The chain is consistent only when it is read as follows: theta = 90 degrees - pitch, in Eq. (8) as well (for no other angle
//! does the axis point lie at the depth of the range); v points up; the '+' of Eq. (9) is a product. The paper's origin then
//! lies where the perpendicular to the optical axis through the camera meets the table, h sin(pitch) nearer to the wearer than
//! the point under the camera.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use std::f64::consts::FRAC_PI_2;

use aim_batch_model::{LensModel, Pose, View};
use common::aim2_camera;
use nalgebra::{Matrix3, Point2, Vector3};
use proptest::prelude::*;

/// The camera of the paper's Table I.
const FOCAL_MM: f64 = 2.4;
const SCALE_PX_PER_MM: [f64; 2] = [2592.0 / 3.67, 1944.0 / 2.74];
const CENTER_PX: [f64; 2] = [1296.0, 972.0];

/// The paper's chain from a pixel to a point on the plane of the table or of a rim.
struct PaperChain {
    pitch_rad: f64,
    /// h of Eq. (10) for the table, or h' of Eq. (15) for a rim.
    h_mm: f64,
}

impl PaperChain {
    fn on_table(pitch_rad: f64, range_mm: f64) -> Self {
        Self { pitch_rad, h_mm: range_mm * pitch_rad.tan() } // Eq. (10)
    }

    fn on_rim(&self, height_mm: f64) -> Self {
        Self { pitch_rad: self.pitch_rad, h_mm: self.h_mm - height_mm / self.pitch_rad.cos() } // Eq. (15)
    }

    /// X, Y and Z in the paper's world. Z must be zero but for rounding.
    fn world_mm(&self, pixel: Point2<f64>) -> Vector3<f64> {
        let u = (pixel.x - CENTER_PX[0]) / SCALE_PX_PER_MM[0]; // Eq. (9)
        let v = -(pixel.y - CENTER_PX[1]) / SCALE_PX_PER_MM[1]; // Eq. (9), v up
        let (sin_theta, cos_theta) = (FRAC_PI_2 - self.pitch_rad).sin_cos();
        let depth_mm = self.h_mm * sin_theta / (cos_theta - v * sin_theta / FOCAL_MM); // Eq. (11)
        let in_camera = Vector3::new(depth_mm / FOCAL_MM * u, depth_mm / FOCAL_MM * v, depth_mm); // Eq. (12)
        let rotation = Matrix3::new(1.0, 0.0, 0.0, 0.0, cos_theta, -sin_theta, 0.0, sin_theta, cos_theta); // Eq. (8)
        let translation = Vector3::new(0.0, -self.h_mm, 0.0);
        rotation.transpose() * (in_camera - translation) // Eq. (13)
    }
}

fn pixel() -> impl Strategy<Value = Point2<f64>> {
    (0.0..2592.0, 0.0..1944.0).prop_map(|(x, y)| Point2::new(x, y))
}

fn agree(chain: &PaperChain, view: &View, plane_z_mm: f64, pixels: [Point2<f64>; 2]) -> Result<(), TestCaseError> {
    let [a, b] = pixels.map(|p| chain.world_mm(p));
    prop_assert!(a.z.abs() < 1e-6 && b.z.abs() < 1e-6, "Z = {}, {}", a.z, b.z);
    let [ours_a, ours_b] = pixels.map(|p| view.on_plane(p, plane_z_mm).unwrap());
    let difference_mm = (a - b).norm() - (ours_a - ours_b).norm();
    prop_assert!(difference_mm.abs() < 1e-6, "distances differ by {difference_mm:e} mm");
    // The points are the same as well, and not only their distances, once the origin is moved.
    let origin = Vector3::new(0.0, chain.h_mm * view.pose().pitch_rad().sin(), 0.0);
    prop_assert!((a - origin - ours_a.coords.push(0.0)).norm() < 1e-6);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    /// The picture's upper edge looks 29.8 degrees above the axis, so from 32 degrees on every pixel meets the table.
    #[test]
    fn chain_and_view_measure_the_same(
        pitch_deg in 32.0..85.0,
        range_mm in 150.0..1200.0,
        share in 0.0..0.9,
        pixels in [pixel(), pixel()],
    ) {
        let pose = Pose::new(f64::to_radians(pitch_deg), 0.0, range_mm).unwrap();
        let view = View::new(aim2_camera(LensModel::None), pose);
        let table = PaperChain::on_table(pose.pitch_rad(), range_mm);
        agree(&table, &view, 0.0, pixels)?;
        let rim_mm = share * pose.camera_height_mm();
        agree(&table.on_rim(rim_mm), &view, rim_mm, pixels)?;
    }
}

#[test]
fn the_axis_point_lies_at_the_range() {
    let (pitch_rad, range_mm) = (55_f64.to_radians(), 580.0);
    let chain = PaperChain::on_table(pitch_rad, range_mm);
    let axis_point = chain.world_mm(Point2::new(CENTER_PX[0], CENTER_PX[1]));
    // From the paper's origin the axis point is the hypotenuse of a right triangle with sides h and d.
    assert!((axis_point.y - chain.h_mm.hypot(range_mm)).abs() < 1e-9, "{axis_point}");
}
