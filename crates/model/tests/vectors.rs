//! The plane model, compared with points that another program computed (`vectors/plane.csv`): with pitches from 30 to 80
//! degrees, rolls, raw and corrected cameras, barrel lenses, and several planes.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use aim_batch_model::{Camera, CameraSpec, LensSpec, Pose, View};
use nalgebra::{Point2, Point3};
use serde::Deserialize;

const VECTORS: &str = include_str!("vectors/plane.csv");

#[derive(Deserialize)]
struct Vector {
    f_mm: f64,
    s_x_px_per_mm: f64,
    s_y_px_per_mm: f64,
    c_x_px: f64,
    c_y_px: f64,
    k_per_mm2: f64,
    pitch_deg: f64,
    roll_deg: f64,
    range_mm: f64,
    plane_z_mm: f64,
    world_x_mm: f64,
    world_y_mm: f64,
    pixel_x: f64,
    pixel_y: f64,
}

impl Vector {
    fn camera(&self) -> Camera {
        let spec = CameraSpec {
            schema_version: 1,
            name: "vector".to_owned(),
            width_px: 2592,
            height_px: 1944,
            focal_px: None,
            focal_mm: Some(self.f_mm),
            scale_px_per_mm: Some([self.s_x_px_per_mm, self.s_y_px_per_mm]),
            principal_px: [self.c_x_px, self.c_y_px],
            skew_px: None,
            lens: LensSpec::Radial { k_per_mm2: Some(self.k_per_mm2), k1: None },
        };
        spec.camera().unwrap()
    }

    fn view(&self) -> View {
        let pose = Pose::new(self.pitch_deg.to_radians(), self.roll_deg.to_radians(), self.range_mm).unwrap();
        View::new(self.camera(), pose)
    }
}

fn vectors() -> Vec<Vector> {
    let vectors: Vec<Vector> = csv::Reader::from_reader(VECTORS.as_bytes()).deserialize().map(Result::unwrap).collect();
    assert_eq!(vectors.len(), 60);
    vectors
}

#[test]
fn pixels_fall_on_the_reference_points() {
    for (line, v) in (2..).zip(vectors()) {
        let got = v.view().on_plane(Point2::new(v.pixel_x, v.pixel_y), v.plane_z_mm).unwrap();
        let error_mm = (got - Point2::new(v.world_x_mm, v.world_y_mm)).norm();
        assert!(error_mm < 1e-6, "line {line}: {error_mm:e} mm off");
    }
}

#[test]
fn reference_points_are_seen_in_the_reference_pixels() {
    for (line, v) in (2..).zip(vectors()) {
        let got = v.view().pixel_of(Point3::new(v.world_x_mm, v.world_y_mm, v.plane_z_mm)).unwrap();
        let error_px = (got - Point2::new(v.pixel_x, v.pixel_y)).norm();
        assert!(error_px < 1e-6, "line {line}: {error_px:e} px off");
    }
}
