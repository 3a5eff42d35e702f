//! Marks that slipped, outlines that are no circles, and honest marks that must not be taken for such.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use std::f64::consts::TAU;

use aim_batch_model::{
    CircleError, Container, Doubt, Estimate, Feature, InputSigma, Kind, LensModel, Mark, MeasureError, Method,
    ObjectMarks, Pose, Quantity, Shape, View, estimate, sights,
};
use common::aim2_camera;
use nalgebra::{Point2, Point3, Vector2};
use rand::SeedableRng as _;
use rand_distr::{Distribution as _, Normal};

const RADIUS_MM: f64 = 84.65;

fn view(pitch_deg: f64) -> View {
    let pose = Pose::new(pitch_deg.to_radians(), 3_f64.to_radians(), 580.0).unwrap();
    View::new(aim2_camera(LensModel::None), pose)
}

fn seen(x_mm: f64, y_mm: f64, z_mm: f64) -> Point2<f64> {
    view(55.0).pixel_of(Point3::new(x_mm, y_mm, z_mm)).unwrap()
}

/// `n` points of an ellipse on the table, with these half axes along X and Y.
fn ring(n: u32, [along_x_mm, along_y_mm]: [f64; 2]) -> Vec<Point2<f64>> {
    let point = |i: u32| {
        let (sin, cos) = (TAU * f64::from(i) / f64::from(n)).sin_cos();
        seen(20.0 + along_x_mm * cos, 330.0 + along_y_mm * sin, 0.0)
    };
    (0..n).map(point).collect()
}

fn circle(n: u32) -> Vec<Point2<f64>> {
    ring(n, [RADIUS_MM; 2])
}

fn rim(points_px: Vec<Point2<f64>>) -> Mark {
    Mark::Outline { feature: Feature::Rim, points_px }
}

fn line(quantity: Quantity, a: [f64; 3], b: [f64; 3]) -> Mark {
    Mark::Line { quantity, ends_px: [a, b].map(|[x, y, z]| seen(x, y, z)) }
}

fn sizes(shape: Shape, view: &View, marks: Vec<Mark>) -> Vec<(Quantity, Result<Estimate, MeasureError>)> {
    let container = Container { kind: Kind::Plate, shape, rim_height_mm: None, wall: None };
    let marks = ObjectMarks { object: "plate".to_owned(), marks };
    estimate(view, Method::Ray, &container, &marks, &InputSigma::default())
}

fn diameter(marks: Vec<Mark>) -> Result<Estimate, MeasureError> {
    sizes(Shape::Circle, &view(55.0), marks).into_iter().next().unwrap().1
}

fn across(length_mm: f64) -> Mark {
    line(Quantity::Diameter, [20.0 - 0.5 * length_mm, 330.0, 0.0], [20.0 + 0.5 * length_mm, 330.0, 0.0])
}

#[test]
fn two_lines_that_contradict_each_other_give_no_size() {
    let error = diameter(vec![across(170.0), across(0.5)]).unwrap_err();
    let MeasureError::MarksDisagree { marks: 2, smallest_mm, largest_mm, .. } = error else { panic!("{error:?}") };
    assert!((smallest_mm - 0.5).abs() < 1e-6 && (largest_mm - 170.0).abs() < 1e-6);
    assert_eq!(error.problem_code().code(), "marks_disagree");
    let middle = seen(20.0, 330.0, 0.0);
    let place = format!("170.0 mm (line about pixel ({:.0}, {:.0}))", middle.x, middle.y);
    assert!(error.to_string().contains(&place), "{error}");
}

#[test]
fn one_of_three_is_left_out_and_named() {
    let measured = diameter(vec![across(170.0), across(0.5), across(171.0)]).unwrap().measured;
    let left = measured.left_out.unwrap();
    assert!((measured.predicted_mm - 170.5).abs() < 1e-6 && measured.marks == 2, "{measured:?}");
    assert!(left.marks == 1 && (left.furthest_mm - 0.5).abs() < 1e-6);
    assert!(!left.furthest.is_outline && (left.furthest.middle_px - seen(20.0, 330.0, 0.0)).norm() < 0.1);
}

#[test]
fn an_outline_beside_the_true_one_is_not_averaged() {
    let slip = [[950.0, 990.0], [951.5, 990.2], [950.7, 991.4]].map(Point2::from).to_vec();
    let both = diameter(vec![rim(circle(24)), rim(slip)]);
    assert!(matches!(both, Err(MeasureError::MarksDisagree { .. })), "{both:?}");
    let inner = diameter(vec![rim(circle(40)), rim(ring(40, [0.6 * RADIUS_MM; 2]))]);
    assert!(matches!(inner, Err(MeasureError::MarksDisagree { .. })), "the parts of one annotation: {inner:?}");
}

#[test]
fn height_lines_are_judged_as_well() {
    let wall = |height_mm: f64| line(Quantity::Height, [0.0, 380.0, 0.0], [0.0, 380.0, height_mm]);
    let bowl = |marks: Vec<Mark>| ObjectMarks { object: "bowl".to_owned(), marks };
    let seen_by = |marks: Vec<Mark>| sights(&view(55.0), &bowl(marks), &InputSigma::default());
    assert!(matches!(seen_by(vec![wall(60.0), wall(0.5)]), Err(MeasureError::MarksDisagree { .. })));
    assert_eq!(seen_by(vec![wall(60.0), wall(0.5), wall(61.0)]).unwrap().len(), 2);
    let container = Container { kind: Kind::Bowl, shape: Shape::Circle, rim_height_mm: None, wall: None };
    let sizes = estimate(
        &view(55.0),
        Method::Ray,
        &container,
        &bowl(vec![wall(60.0), wall(0.5), wall(61.0)]),
        &InputSigma::default(),
    );
    assert!((sizes[0].1.as_ref().unwrap().measured.predicted_mm - 60.5).abs() < 1e-6, "{sizes:?}");
}

/// A wall that leans looks higher on one side than on the other, but has one height at one place.
#[test]
fn lines_on_one_side_of_a_wall_give_one_height() {
    let at = |x_mm: f64, y_mm: f64, height_mm: f64| line(Quantity::Height, [x_mm, y_mm, 0.0], [x_mm, y_mm, height_mm]);
    let container = Container { kind: Kind::Bowl, shape: Shape::Circle, rim_height_mm: None, wall: None };
    let height = |marks: Vec<Mark>| {
        let marks = ObjectMarks { object: "bowl".to_owned(), marks };
        estimate(&view(55.0), Method::Ray, &container, &marks, &InputSigma::default()).remove(0).1
    };
    let one_side = height(vec![at(0.0, 330.0, 60.0), at(6.0, 330.0, 35.0)]);
    assert!(matches!(one_side, Err(MeasureError::MarksDisagree { .. })), "{one_side:?}");
    let close = height(vec![at(0.0, 330.0, 60.0), at(6.0, 330.0, 57.0)]).unwrap();
    assert_eq!(close.measured.marks, 2);
    let opposite = height(vec![at(-50.0, 330.0, 60.0), at(50.0, 330.0, 35.0)]).unwrap();
    assert_eq!(opposite.measured.marks, 2, "which may be the two sides of a wall that leans");
}

#[test]
fn a_stray_vertex_is_left_out() {
    let mut points = circle(12);
    points[3] += Vector2::new(60.0, -80.0);
    let Estimate { measured, doubts, .. } = diameter(vec![rim(points)]).unwrap();
    assert!((measured.predicted_mm - 2.0 * RADIUS_MM).abs() < 1e-6, "169.3 mm: {measured:?}");
    assert_eq!((measured.stray_points, doubts), (1, Vec::new()));
}

#[test]
fn two_rings_in_one_outline_are_no_circle() {
    let points = [circle(40), ring(40, [0.6 * RADIUS_MM; 2])].concat();
    let error = diameter(vec![rim(points)]).unwrap_err();
    let MeasureError::Circle { source: CircleError::NotRound { points: 80, misfit_px, expected_px }, .. } = error
    else {
        panic!("{error:?}")
    };
    assert!(misfit_px > 20.0 && (1.5..4.0).contains(&expected_px), "{error}");
    assert_eq!(error.problem_code().code(), "outline_not_round");
}

/// An oval of 200 x 150 mm has no diameter, while one that is 4 % longer than wide is within what a wrong pitch makes of a circle.
#[test]
fn an_oval_is_no_circle() {
    let oval = diameter(vec![rim(ring(24, [100.0, 75.0]))]);
    assert!(matches!(oval, Err(MeasureError::Circle { source: CircleError::NotRound { .. }, .. })), "{oval:?}");
    assert_eq!(diameter(vec![rim(ring(24, [86.0, 83.0]))]).unwrap().doubts, []);
}

/// The corners of a square lie on a circle, so the fit alone cannot see that they are no rim.
#[test]
fn four_points_are_doubtful() {
    for n in [3, 4, 5] {
        assert_eq!(diameter(vec![rim(circle(n))]).unwrap().doubts, [Doubt::FewOutlinePoints], "{n}");
    }
    let closed = [circle(4), circle(4)[..1].to_vec()].concat();
    assert_eq!(diameter(vec![rim(closed)]).unwrap().doubts, [Doubt::FewOutlinePoints]);
    assert_eq!(diameter(vec![rim(circle(8))]).unwrap().doubts, []);
}

/// A box around a round rim, as tools draw it, has its corners on a circle of its own: 238 for 169.3 mm.
#[test]
fn an_upright_box_is_no_outline_of_a_circle() {
    let points = circle(64);
    let bound = |axis: usize, pick: fn(f64, f64) -> f64| points.iter().map(|point| point[axis]).reduce(pick).unwrap();
    let [left, right] = [bound(0, f64::min), bound(0, f64::max)];
    let [top, bottom] = [bound(1, f64::min), bound(1, f64::max)];
    let corners = [[left, top], [right, top], [right, bottom], [left, bottom]].map(Point2::from).to_vec();
    for corners in [corners.clone(), [&corners[2..], &corners[..2], &corners[2..3]].concat()] {
        let error = diameter(vec![rim(corners)]).unwrap_err();
        assert!(matches!(error, MeasureError::Circle { source: CircleError::UprightBox, .. }), "{error}");
        assert_eq!(error.problem_code().code(), "no_circle");
    }
    let leaning = [[left, top], [right, top + 5.0], [right, bottom], [left, bottom - 5.0]].map(Point2::from).to_vec();
    assert!(diameter(vec![rim(leaning)]).is_ok_and(|size| size.doubts == [Doubt::FewOutlinePoints]));
}

#[test]
fn crooked_corners_are_doubtful() {
    let corners = |d_mm: f64| {
        [[-60.0, 270.0], [60.0, 270.0], [60.0 + d_mm, 390.0], [-60.0, 390.0]].map(|[x, y]| seen(x, y, 0.0)).to_vec()
    };
    let doubts =
        |shape, d_mm| sizes(shape, &view(55.0), vec![rim(corners(d_mm))])[0].1.as_ref().unwrap().doubts.clone();
    for shape in [Shape::Square, Shape::Rectangle] {
        assert_eq!(doubts(shape, 0.5), []);
        assert_eq!(doubts(shape, 30.0), [Doubt::OutlineNotRight]);
    }
}

/// Clicks with the stated scatter, and a pitch that is wrong by twice its stated uncertainty: nothing is refused, nothing is left out, and
/// doubts are rare.
#[test]
fn honest_outlines_are_not_refused() {
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(11);
    let click = Normal::new(0.0, InputSigma::default().mark_px).unwrap();
    let mut doubted = 0;
    for run in 0..300 {
        let turned = view(55.0 + [-2.0, 0.0, 2.0][run % 3]);
        let points = circle([8, 12, 24][run / 100]);
        let clicked =
            points.into_iter().map(|p| p + Vector2::new(click.sample(&mut random), click.sample(&mut random)));
        let size = sizes(Shape::Circle, &turned, vec![rim(clicked.collect())]).remove(0).1.unwrap();
        assert_eq!(size.measured.stray_points, 0, "run {run}");
        doubted += usize::from(!size.doubts.is_empty());
    }
    assert!(doubted <= 3, "{doubted} of 300");
}
