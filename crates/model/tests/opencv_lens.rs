//! The lens models `plumb_bob` and `fisheye`, compared with OpenCV (`vectors/opencv_lens.csv`, made by the script beside
//! it), and `division`, compared with numbers that were computed by hand.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use aim_batch_model::LensModel;
use aim_batch_model::lens::{Division, Fisheye, PlumbBob};
use nalgebra::{Point2, Vector3};
use serde::Deserialize;

const VECTORS: &str = include_str!("vectors/opencv_lens.csv");

#[derive(Deserialize)]
struct Vector {
    model: String,
    k1: f64,
    k2: f64,
    p1: f64,
    p2: f64,
    k3: f64,
    k4: f64,
    ray_x: f64,
    ray_y: f64,
    distorted_x: f64,
    distorted_y: f64,
}

impl Vector {
    fn lens(&self) -> LensModel {
        let &Self { k1, k2, p1, p2, k3, k4, .. } = self;
        match self.model.as_str() {
            "plumb_bob" => LensModel::PlumbBob(PlumbBob { k1, k2, p1, p2, k3 }),
            "fisheye" => LensModel::Fisheye(Fisheye { k1, k2, k3, k4 }),
            other => panic!("lens model '{other}' in the vectors"),
        }
    }
}

fn vectors() -> Vec<Vector> {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(VECTORS.as_bytes());
    let vectors: Vec<Vector> = reader.deserialize().map(Result::unwrap).collect();
    assert_eq!(vectors.len(), 440);
    vectors
}

/// The distance of two points, as a share of the second one's distance from the origin where that is above 1.
fn relative_error(got: Point2<f64>, expected: Point2<f64>) -> f64 {
    (got - expected).norm() / expected.coords.norm().max(1.0)
}

#[test]
fn rays_are_shown_where_opencv_shows_them() {
    for (line, v) in (3..).zip(vectors()) {
        let got = v.lens().distorted_of_ray(&Vector3::new(v.ray_x, v.ray_y, 1.0)).unwrap();
        let error = relative_error(got, Point2::new(v.distorted_x, v.distorted_y));
        assert!(error < 1e-9, "line {line}, {}: {error:e}", v.model);
    }
}

#[test]
fn image_points_of_opencv_give_the_rays_back() {
    for (line, v) in (3..).zip(vectors()) {
        let ray = v.lens().ray_of_distorted(Point2::new(v.distorted_x, v.distorted_y)).unwrap();
        let error = relative_error(Point2::new(ray.x / ray.z, ray.y / ray.z), Point2::new(v.ray_x, v.ray_y));
        assert!(error < 1e-9, "line {line}, {}: {error:e}", v.model);
    }
}

/// Each row holds lambda, the distorted radius `r_d` and the ideal radius `r_d` / (1 + lambda `r_d`^2).
const DIVISION_BY_HAND: [(f64, f64, f64); 5] = [
    (-0.25, 1.0, 4.0 / 3.0),   // 1 / 0.75
    (-0.16, 2.0, 50.0 / 9.0),  // 2 / 0.36: a ray 79.8 degrees from the axis
    (0.25, 1.0, 0.8),          // 1 / 1.25
    (0.36, 0.5, 50.0 / 109.0), // 0.5 / 1.09
    (0.0, 0.7, 0.7),
];

#[test]
fn division_agrees_with_hand_values() {
    for (lambda, distorted, ideal) in DIVISION_BY_HAND {
        let lens = LensModel::Division(Division { lambda });
        let (cos, sin) = (0.6, 0.8);
        let ray = lens.ray_of_distorted(Point2::new(cos * distorted, sin * distorted)).unwrap();
        let expected_ray = Vector3::new(cos * ideal, sin * ideal, 1.0);
        assert!((ray - expected_ray).norm() < 1e-14, "lambda {lambda}: {ray}");
        let back = lens.distorted_of_ray(&expected_ray).unwrap();
        assert!((back - Point2::new(cos * distorted, sin * distorted)).norm() < 1e-14, "lambda {lambda}: {back}");
    }
}
