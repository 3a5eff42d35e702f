//! Wall heights, and `measure` on synthetic marks: which sizes are exact, which are biased and by how much, and which marks are
//! refused.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use aim_batch_model::{
    CircleError, Container, Feature, Kind, LensModel, Mark, MeasureError, Measured, Method, ObjectMarks, Pose,
    Quantity, Shape, View, ViewError, height_by_paper_mm, height_by_ray_mm, measure,
};
use common::aim2_camera;
use nalgebra::{Point2, Point3};
use proptest::prelude::*;
use rand::SeedableRng as _;
use rand_distr::{Distribution as _, Normal};

fn view(pitch_deg: f64, roll_deg: f64, range_mm: f64) -> View {
    let pose = Pose::new(pitch_deg.to_radians(), roll_deg.to_radians(), range_mm).unwrap();
    View::new(aim2_camera(LensModel::None), pose)
}

/// The pixel that shows a point of the world.
fn seen(view: &View, x_mm: f64, y_mm: f64, z_mm: f64) -> Point2<f64> {
    view.pixel_of(Point3::new(x_mm, y_mm, z_mm)).unwrap()
}

/// The pixels of `n` points around a circle with a diameter of 150 mm, at the height `z_mm`.
fn circle_px(view: &View, n: u32, z_mm: f64) -> Vec<Point2<f64>> {
    (0..n)
        .map(|i| {
            let (sin, cos) = (TAU * f64::from(i) / f64::from(n)).sin_cos();
            seen(view, 40.0 + 75.0 * cos, 330.0 + 75.0 * sin, z_mm)
        })
        .collect()
}

/// The pixels of the corners of a rectangle that is turned by 25 degrees, at the height `z_mm`.
fn corners_px(view: &View, width_mm: f64, length_mm: f64, z_mm: f64) -> Vec<Point2<f64>> {
    let (sin, cos) = 25_f64.to_radians().sin_cos();
    [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]
        .map(|(a, b)| (a * width_mm, b * length_mm))
        .map(|(a, b)| seen(view, -30.0 + cos * a - sin * b, 350.0 + sin * a + cos * b, z_mm))
        .to_vec()
}

fn line(quantity: Quantity, a: Point2<f64>, b: Point2<f64>) -> Mark {
    Mark::Line { quantity, ends_px: [a, b] }
}

fn rim(points_px: Vec<Point2<f64>>) -> Mark {
    Mark::Outline { feature: Feature::Rim, points_px }
}

fn sizes(
    view: &View,
    kind: Kind,
    shape: Shape,
    rim_height_mm: Option<f64>,
    marks: Vec<Mark>,
) -> Vec<(Quantity, Result<Measured, MeasureError>)> {
    let marks = ObjectMarks { object: "object".to_owned(), marks };
    measure(view, Method::Ray, &Container { kind, shape, rim_height_mm, wall: None }, &marks)
}

fn assert_sizes(got: &[(Quantity, Result<Measured, MeasureError>)], expected_mm: &[(Quantity, f64)]) {
    assert_eq!(got.len(), expected_mm.len(), "{got:?}");
    for ((quantity, result), (expected_quantity, expected_mm)) in got.iter().zip(expected_mm) {
        assert_eq!(quantity, expected_quantity);
        let measured = result.unwrap();
        assert_eq!(measured.quantity, *expected_quantity);
        assert!((measured.predicted_mm - expected_mm).abs() < 1e-6, "{measured:?}, expected {expected_mm}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    /// The wall may stand anywhere in front of the camera, at any pitch and roll.
    #[test]
    fn the_ray_height_of_a_vertical_wall_is_exact(
        pitch_rad in 0.1..FRAC_PI_2,
        roll_rad in -PI..PI,
        range_mm in 200.0..1500.0,
        sideways in -0.5..0.5,
        forward in 0.2..3.0,
        share in 0.01..0.9,
    ) {
        let pose = Pose::new(pitch_rad, roll_rad, range_mm).unwrap();
        let view = View::new(aim2_camera(LensModel::None), pose);
        let c_mm = pose.camera_height_mm();
        let height_mm = share * c_mm;
        let (x_mm, y_mm) = (sideways * c_mm, forward * c_mm);
        let foot_px = view.pixel_of(Point3::new(x_mm, y_mm, 0.0));
        let rim_px = view.pixel_of(Point3::new(x_mm, y_mm, height_mm));
        prop_assume!(foot_px.is_ok() && rim_px.is_ok()); // a steep camera does not see far behind its upper edge
        let got_mm = height_by_ray_mm(&view, foot_px.unwrap(), rim_px.unwrap()).unwrap();
        prop_assert!((got_mm - height_mm).abs() < 1e-8 * c_mm, "{got_mm} mm, true {height_mm} mm");
    }

    /// Eq. (14) takes the depression of the axis for that of the ray to the rim, so it is wrong by the ratio of the two
    /// tangents.
    #[test]
    fn the_paper_height_is_off_by_the_ratio_of_tangents(
        pitch_deg in 20.0..80.0,
        range_mm in 200.0..1500.0,
        depression_deg in 20.0..80.0,
        share in 0.01..0.9,
    ) {
        let view = view(pitch_deg, 0.0, range_mm);
        let c_mm = view.pose().camera_height_mm();
        let height_mm = share * c_mm;
        // The wall stands where its rim is seen at that depression.
        let y_mm = (c_mm - height_mm) / f64::to_radians(depression_deg).tan();
        let (foot_px, rim_px) = (seen(&view, 0.0, y_mm, 0.0), seen(&view, 0.0, y_mm, height_mm));
        let ratio = f64::to_radians(pitch_deg).tan() / f64::to_radians(depression_deg).tan();
        let got = height_by_paper_mm(&view, foot_px, rim_px);
        if ratio * height_mm >= c_mm {
            let refused = matches!(got, Err(MeasureError::RimAboveCamera { .. }));
            prop_assert!(refused, "{got:?}: the equation gives a wall above the camera");
            return Ok(());
        }
        let got_mm = got.unwrap();
        prop_assert!((got_mm - ratio * height_mm).abs() < 1e-8 * c_mm, "{got_mm} mm, true {height_mm} mm");
    }
}

#[test]
fn the_paper_height_is_exact_on_the_axis_and_only_there() {
    let view = view(50.0, 0.0, 600.0);
    let height_mm = 60.0;
    let y_on_axis_mm = (view.pose().camera_height_mm() - height_mm) / 50_f64.to_radians().tan();
    let paper =
        |y_mm: f64| height_by_paper_mm(&view, seen(&view, 0.0, y_mm, 0.0), seen(&view, 0.0, y_mm, height_mm)).unwrap();
    assert!((paper(y_on_axis_mm) - height_mm).abs() < 1e-9);
    assert!(paper(y_on_axis_mm + 50.0) > height_mm + 3.0);
    assert!(paper(y_on_axis_mm - 50.0) < height_mm - 3.0);
}

#[test]
fn plates_are_measured_on_the_table() {
    let view = view(55.0, 4.0, 580.0);
    let marks = vec![
        line(Quantity::Diameter, seen(&view, -35.0, 330.0, 0.0), seen(&view, 115.0, 330.0, 0.0)),
        line(Quantity::Diameter, seen(&view, 40.0, 254.0, 0.0), seen(&view, 40.0, 406.0, 0.0)),
    ];
    let got = sizes(&view, Kind::Plate, Shape::Circle, None, marks);
    assert_sizes(&got, &[(Quantity::Diameter, 151.0)]); // the mean of 150 and 152
    assert_eq!(got[0].1.unwrap().marks, 2);
}

#[test]
fn bowls_are_measured_on_the_plane_of_their_rim() {
    let view = view(55.0, -7.0, 580.0);
    let height = line(Quantity::Height, seen(&view, 10.0, 400.0, 0.0), seen(&view, 10.0, 400.0, 62.0));
    let mouth = line(Quantity::Diameter, seen(&view, -60.0, 340.0, 62.0), seen(&view, 80.0, 340.0, 62.0));
    let got = sizes(&view, Kind::Bowl, Shape::Circle, None, vec![mouth.clone(), height.clone()]);
    assert_sizes(&got, &[(Quantity::Height, 62.0), (Quantity::Diameter, 140.0)]);
    assert!((got[1].1.unwrap().plane_z_mm - 62.0).abs() < 1e-9);
    // A known rim height decides the plane; the marked one is still measured.
    let got = sizes(&view, Kind::Bowl, Shape::Circle, Some(0.0), vec![mouth, height]);
    let c_mm = view.pose().camera_height_mm();
    assert_sizes(&got, &[(Quantity::Height, 62.0), (Quantity::Diameter, 140.0 * c_mm / (c_mm - 62.0))]);
}

#[test]
fn corners_give_the_sides_of_boxes_and_square_plates() {
    let view = view(60.0, 9.0, 640.0);
    let got = sizes(&view, Kind::Plate, Shape::Square, None, vec![rim(corners_px(&view, 180.0, 180.0, 0.0))]);
    assert_sizes(&got, &[(Quantity::Width, 180.0)]);
    for (a_mm, b_mm) in [(120.0, 200.0), (200.0, 120.0)] {
        let outline = rim(corners_px(&view, a_mm, b_mm, 45.0));
        let got = sizes(&view, Kind::Box, Shape::Rectangle, Some(45.0), vec![outline]);
        assert_sizes(&got, &[(Quantity::Width, 120.0), (Quantity::Length, 200.0)]);
    }
}

#[test]
fn the_paper_method_takes_the_roll_as_zero() {
    let rolled = view(55.0, 10.0, 580.0);
    let ends_px = [seen(&rolled, -75.0, 330.0, 0.0), seen(&rolled, 75.0, 330.0, 0.0)];
    let marks =
        ObjectMarks { object: "plate".to_owned(), marks: vec![Mark::Line { quantity: Quantity::Diameter, ends_px }] };
    let plate = Container { kind: Kind::Plate, shape: Shape::Circle, rim_height_mm: None, wall: None };
    let predicted_mm = |method| measure(&rolled, method, &plate, &marks)[0].1.unwrap().predicted_mm;
    assert!((predicted_mm(Method::Ray) - 150.0).abs() < 1e-6);
    let straight = view(55.0, 0.0, 580.0);
    let [a, b] = ends_px.map(|p| straight.on_plane(p, 0.0).unwrap());
    assert!((predicted_mm(Method::Paper) - (a - b).norm()).abs() < 1e-9);
    assert!((predicted_mm(Method::Paper) - 150.0).abs() > 0.5, "10 degrees of roll show");
}

#[test]
fn a_circle_without_noise_is_exact() {
    for (pitch_deg, z_mm) in [(40.0, 0.0), (55.0, 35.0), (72.0, 60.0)] {
        let view = view(pitch_deg, 5.0, 600.0);
        for n in [3, 8, 40] {
            let kind = if z_mm > 0.0 { Kind::Bowl } else { Kind::Plate };
            let got = sizes(&view, kind, Shape::Circle, Some(z_mm), vec![rim(circle_px(&view, n, z_mm))]);
            assert_sizes(&got, &[(Quantity::Diameter, 150.0)]);
        }
    }
}

/// The marks have errors of 2 px (1 SD, in both coordinates). At 0.4 mm per pixel, 24 marks give the diameter with an SD of
/// about 2 * 2 px * 0.4 mm/px / sqrt(24) = 0.33 mm.
#[test]
fn noisy_marks_give_the_diameter_without_bias() {
    let view = view(55.0, 5.0, 600.0);
    let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(2);
    let noise_px = Normal::new(0.0, 2.0).unwrap();
    let errors_mm: Vec<f64> = (0..200)
        .map(|_| {
            let points_px = circle_px(&view, 24, 0.0)
                .into_iter()
                .map(|p| Point2::new(p.x + noise_px.sample(&mut rng), p.y + noise_px.sample(&mut rng)))
                .collect();
            let got = sizes(&view, Kind::Plate, Shape::Circle, None, vec![rim(points_px)]);
            got[0].1.unwrap().predicted_mm - 150.0
        })
        .collect();
    let stats = aim_batch_model::ErrorStats::from_errors(&errors_mm).unwrap();
    assert!(stats.mean.abs() < 0.08, "bias {} mm", stats.mean); // 3 standard errors of the mean of 200
    assert!((0.25..0.45).contains(&stats.population_sd), "scatter {} mm", stats.population_sd);
    assert!(stats.worst.abs() < 1.5, "worst {} mm", stats.worst);
}

#[test]
fn what_cannot_be_measured_says_why() {
    let view = view(55.0, 0.0, 580.0);
    let refused = |kind, shape, marks| {
        let got = sizes(&view, kind, shape, None, marks);
        assert_eq!(got.len(), 1, "{got:?}");
        got[0].1.unwrap_err()
    };
    let mouth = line(Quantity::Diameter, seen(&view, -60.0, 340.0, 62.0), seen(&view, 80.0, 340.0, 62.0));
    assert_eq!(refused(Kind::Bowl, Shape::Circle, vec![mouth]), MeasureError::NoHeight);
    let upside_down = line(Quantity::Height, seen(&view, 0.0, 340.0, 60.0), seen(&view, 0.0, 340.0, 0.0));
    assert_eq!(refused(Kind::Bowl, Shape::Circle, vec![upside_down]), MeasureError::RimBelowFoot);
    let plate = |marks| refused(Kind::Plate, Shape::Circle, marks);
    let in_a_row = (0..9).map(|i| seen(&view, f64::from(i) * 10.0, 330.0, 0.0)).collect();
    let circle_error = |source| MeasureError::Circle { feature: Feature::Rim, source };
    assert_eq!(plate(vec![rim(in_a_row)]), circle_error(CircleError::Degenerate));
    assert_eq!(plate(vec![rim(vec![Point2::new(1300.0, 900.0); 9])]), circle_error(CircleError::Degenerate));
    assert_eq!(plate(vec![rim(circle_px(&view, 2, 0.0))]), circle_error(CircleError::TooFewPoints(2)));
    assert_eq!(
        refused(Kind::Plate, Shape::Square, vec![rim(circle_px(&view, 5, 0.0))]),
        MeasureError::NotFourCorners { shape: Shape::Square, points: 5 }
    );
    // A square of 100 mm whose corners are marked in the order of a bow tie.
    let bow_tie =
        [[0.0, 300.0], [100.0, 400.0], [100.0, 300.0], [0.0, 400.0]].map(|[x, y]| seen(&view, x, y, 0.0)).to_vec();
    assert_eq!(
        refused(Kind::Plate, Shape::Square, vec![rim(bow_tie)]),
        MeasureError::CornersNotInOrder { shape: Shape::Square }
    );
    let in_the_sky = line(Quantity::Diameter, Point2::new(1200.0, -4000.0), Point2::new(1300.0, 900.0));
    assert!(matches!(plate(vec![in_the_sky]), MeasureError::View(ViewError::AboveHorizon { .. })));
}

/// A quantity that cannot be measured does not spoil the others.
#[test]
fn a_height_survives_a_mouth_that_cannot_be_measured() {
    let view = view(55.0, 0.0, 580.0);
    let height = line(Quantity::Height, seen(&view, 10.0, 400.0, 0.0), seen(&view, 10.0, 400.0, 62.0));
    let got = sizes(&view, Kind::Bowl, Shape::Circle, None, vec![height, rim(circle_px(&view, 2, 62.0))]);
    assert_eq!(got.len(), 2);
    assert!((got[0].1.unwrap().predicted_mm - 62.0).abs() < 1e-9);
    assert!(matches!(got[1].1, Err(MeasureError::Circle { .. })));
}
