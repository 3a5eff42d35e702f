#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
use model::{CameraSpec, LensSpec};

use super::pose::Looked;
use super::*;
use crate::study::SelectSpec;

/// 30 images of a wearer: pitches spread over 40 degrees around `pitch_deg`, at `range_mm`.
fn looked(pitch_deg: f64, roll_deg: f64, range_mm: f64, gravity_g: f64) -> Looked {
    let spread = |i: u32| f64::from(i) * 40.0 / 29.0 - 20.0;
    let pitch: Vec<f64> = (0..30).map(|i| pitch_deg + spread(i)).collect();
    let selected = pitch.iter().filter(|pitch| (*pitch - 55.0).abs() <= 7.5).count();
    Looked {
        gravity_g: vec![gravity_g; 30],
        still_pitch_deg: pitch.clone(),
        pitch_deg: pitch,
        roll_deg: vec![roll_deg; 30],
        range_mm: vec![range_mm; 30],
        selected,
    }
}

fn told(looked: &Looked, setup_pitch_deg: Option<f64>, mount_pitch_deg: f64) -> Vec<(ProblemCode, String)> {
    let doubts = pose::doubts(looked, &SelectSpec::default(), setup_pitch_deg, mount_pitch_deg);
    doubts.into_iter().map(|doubt| (doubt.code, doubt.cause)).collect()
}

#[track_caller]
fn assert_told(told: &[(ProblemCode, String)], code: ProblemCode, cause: &str) {
    let [(got, why)] = told else { panic!("expected {code}: {told:?}") };
    assert!(*got == code && why.contains(cause), "{got}: {why}");
}

#[test]
fn wearers_and_benches_are_plausible() {
    for pitch_deg in [40.0, 50.0, 55.0, 65.0] {
        assert_eq!(told(&looked(pitch_deg, 8.0, 450.0, 1.03), None, 21.0), []);
    }
    assert_eq!(told(&looked(38.0, 0.0, 250.0, 1.0), Some(38.0), 21.0), []);
    assert_eq!(told(&looked(72.0, 0.0, 250.0, 1.0), Some(70.0), 21.0), []);
}

#[test]
fn a_mount_of_the_wrong_sign_is_named() {
    // The camera looks 55 degrees down; -21 for +21 makes that 13.
    let mut looked = looked(13.0, 0.0, 450.0, 1.0);
    looked.pitch_deg.iter_mut().for_each(|pitch| *pitch = 13.0 + (*pitch - 13.0) / 5.0);
    looked.still_pitch_deg = looked.pitch_deg.clone();
    let cause = "with 21 instead of -21 degrees, 30 of 30 images would fit";
    assert_told(&told(&looked, None, -21.0), ProblemCode::NoImageSelected, cause);
    assert_told(&told(&looked, Some(55.0), -21.0), ProblemCode::ImplausiblePose, cause);
}

#[test]
fn swapped_axes_are_named() {
    // Sensor 29 degrees down, so 61 when down and forward are swapped; the camera looks 21 degrees further down.
    let mut down_forward = looked(82.0, 0.0, 450.0, 1.0);
    down_forward.pitch_deg = vec![82.0; 30];
    let swapped = "the axes down and forward are swapped";
    assert_told(&told(&down_forward, None, 21.0), ProblemCode::ImplausiblePose, swapped);
    assert_told(
        &told(&looked(50.0, 88.0, 450.0, 1.0), None, 21.0),
        ProblemCode::ImplausiblePose,
        "right and down are swapped",
    );
    assert_told(&told(&looked(50.0, -176.0, 450.0, 1.0), None, 21.0), ProblemCode::ImplausiblePose, "wrong sign");
    assert_told(
        &told(&looked(5.0, 0.0, 450.0, 1.0), None, 0.0),
        ProblemCode::ImplausiblePose,
        "check the mount offset",
    );
}

#[test]
fn units_are_named() {
    assert_told(
        &told(&looked(50.0, 0.0, 45.0, 1.0), None, 21.0),
        ProblemCode::ImplausibleRange,
        "the range sensor's unit is cm",
    );
    assert_told(&told(&looked(50.0, 0.0, 1900.0, 1.0), None, 21.0), ProblemCode::ImplausibleRange, "mm_per_count");
    for (gravity_g, cause) in
        [(9.81, "m/s^2"), (0.001, "1000 times too small"), (0.0, "zeros"), (0.5, "g_per_count"), (0.102, "10 times")]
    {
        assert_told(&told(&looked(50.0, 0.0, 450.0, gravity_g), None, 21.0), ProblemCode::ImplausibleGravity, cause);
    }
}

fn camera_told(focal_px: [f64; 2], principal_px: [f64; 2], lens: LensSpec) -> Vec<(ProblemCode, String)> {
    let spec = CameraSpec {
        schema_version: 1,
        name: "c".to_owned(),
        width_px: 2592,
        height_px: 1944,
        focal_px: Some(focal_px),
        focal_mm: None,
        scale_px_per_mm: None,
        principal_px,
        skew_px: None,
        lens,
    };
    camera::doubts(&spec.camera().unwrap()).into_iter().map(|doubt| (doubt.code, doubt.cause)).collect()
}

#[test]
fn cameras() {
    let (middle, none) = ([1296.0, 972.0], LensSpec::None {});
    assert_eq!(camera_told([1695.0, 1703.0], middle, none), []);
    assert_eq!(camera_told([1695.0, 1703.0], [1230.0, 1030.0], none), []);
    let fisheye = LensSpec::Fisheye { k1: 0.01, k2: 0.0, k3: 0.0, k4: 0.0 };
    assert_eq!(camera_told([900.0, 900.0], middle, fisheye), []);
    for name in ["aim2-raw", "aim2-corrected"] {
        let camera = ingest::camera::load(name, std::path::Path::new("none")).unwrap().camera().unwrap();
        assert_eq!(camera::doubts(&camera), [], "{name}");
    }
    let code = ProblemCode::ImplausibleCamera;
    assert_told(&camera_told([1695.0, 1703.0], [972.0, 1296.0], none), code, "x and y are swapped");
    assert_told(&camera_told([1695.0, 1703.0], [320.0, 240.0], none), code, "another picture size");
    assert_told(&camera_told([1.0, 1.0], middle, none), code, "focal length in pixels");
    assert_told(&camera_told([2.4, 2.4], middle, none), code, "focal length in pixels");
    assert_told(&camera_told([20_000.0, 20_000.0], middle, none), code, "focal length in pixels");
    assert_told(&camera_told([1695.0, 850.0], middle, none), code, "square");
    let other_unit = LensSpec::PlumbBob { k1: -5.0, k2: 0.0, p1: 0.0, p2: 0.0, k3: 0.0 };
    assert_told(&camera_told([1695.0, 1703.0], middle, other_unit), code, "the unit of its coefficients");
}
