//! First-order uncertainties, compared with the scatter of sizes when every input varies by Gaussian noise (Monte Carlo).

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use aim_batch_model::{
    Camera, Container, ErrorStats, Feature, InputSigma, Kind, LensModel, Mark, Method, ObjectMarks, Pose, Quantity,
    Shape, SizeSigma, View, estimate, lens::Radial, measure,
};
use nalgebra::{Point2, Point3, Rotation3, Vector2, Vector3};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// Draws per source; the SD of a sample SD is then 1.1 %.
const DRAWS: usize = 4000;
/// Four times that SD, and an allowance for the curvature that a first-order propagation leaves out.
const TOLERANCE: f64 = 0.06;

const NONE: InputSigma = InputSigma::NONE;

struct Scene {
    view: View,
    method: Method,
    container: Container,
    marks: ObjectMarks,
}

fn view(roll_deg: f64) -> View {
    let lens = LensModel::Radial(Radial { k1: -0.1 });
    let camera = Camera::new([2592, 1944], [1695.0, 1703.0], [1296.0, 972.0], 0.0, lens).unwrap();
    View::new(camera, Pose::new(52_f64.to_radians(), roll_deg.to_radians(), 560.0).unwrap())
}

fn pixel(view: &View, x_mm: f64, y_mm: f64, z_mm: f64) -> Point2<f64> {
    view.pixel_of(Point3::new(x_mm, y_mm, z_mm)).unwrap()
}

fn line(view: &View, quantity: Quantity, a: [f64; 3], b: [f64; 3]) -> Mark {
    Mark::Line { quantity, ends_px: [pixel(view, a[0], a[1], a[2]), pixel(view, b[0], b[1], b[2])] }
}

fn scene(method: Method, roll_deg: f64, kind: Kind, shape: Shape, marks: impl Fn(&View) -> Vec<Mark>) -> Scene {
    let view = view(roll_deg);
    let marks = ObjectMarks { object: "o".to_owned(), marks: marks(&view) };
    Scene { view, method, container: Container { kind, shape, rim_height_mm: None, wall: None }, marks }
}

fn bowl(view: &View) -> Vec<Mark> {
    let height = line(view, Quantity::Height, [0.0, 400.0, 0.0], [0.0, 400.0, 60.0]);
    let rim =
        (0..20).map(|i| (f64::from(i) * 0.3).sin_cos()).map(|(s, c)| pixel(view, 70.0 * c, 350.0 + 70.0 * s, 60.0));
    vec![height, Mark::Outline { feature: Feature::Rim, points_px: rim.collect() }]
}

fn square(view: &View) -> Vec<Mark> {
    let corners = [(-90.0, 260.0), (90.0, 280.0), (85.0, 440.0), (-95.0, 430.0)];
    let points_px = corners.map(|(x, y)| pixel(view, x, y, 0.0)).to_vec();
    vec![Mark::Outline { feature: Feature::Rim, points_px }]
}

fn lines_of_a_plate(view: &View) -> Vec<Mark> {
    vec![
        line(view, Quantity::Diameter, [-100.0, 350.0, 0.0], [100.0, 350.0, 0.0]),
        line(view, Quantity::Diameter, [20.0, 250.0, 0.0], [20.0, 450.0, 0.0]),
    ]
}

impl Scene {
    fn sigma(&self, quantity: Quantity, inputs: &InputSigma) -> SizeSigma {
        let estimates = estimate(&self.view, self.method, &self.container, &self.marks, inputs);
        estimates.into_iter().find(|(q, _)| *q == quantity).unwrap().1.unwrap().sigma
    }

    /// SD of the size over draws of all inputs. The paper's method takes the roll as zero, so its roll cannot be drawn.
    fn monte_carlo_mm(&self, quantity: Quantity, inputs: &InputSigma) -> f64 {
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let sizes: Vec<f64> = (0..DRAWS)
            .map(|_| {
                let mut draw = |sigma: f64| sigma * Distribution::<f64>::sample(&StandardNormal, &mut random);
                let pose = self.view.pose();
                let (pitch, roll) = (
                    pose.pitch_rad() + draw(inputs.pitch_rad) + draw(inputs.turn_noise_rad),
                    pose.roll_rad() + draw(inputs.tilt_rad.hypot(inputs.turn_noise_rad) / pose.pitch_rad().cos()),
                );
                let turn = Rotation3::from_axis_angle(&Vector3::x_axis(), draw(inputs.mount_rad));
                let down = turn * Pose::new(pitch, roll, 1.0).unwrap().down_in_camera();
                let (pitch, roll) = Pose::pitch_roll_of_down(&down).unwrap();
                let noise_mm = draw(inputs.range_offset_mm) + draw(inputs.range_noise_mm);
                let pose = Pose::new(pitch, roll, pose.range_mm() * (1.0 + draw(inputs.range_relative)) + noise_mm);
                let camera = self.view.camera();
                let scale = 1.0 + draw(inputs.focal_relative);
                let principal_px = camera.principal_px().map(|c| c + draw(inputs.principal_px));
                let focal_px = camera.focal_px().map(|f| f * scale);
                let camera = Camera::new(camera.size_px(), focal_px, principal_px, 0.0, *camera.lens()).unwrap();
                let mut marks = self.marks.clone();
                let bend_px = draw(inputs.distortion_px);
                for mark in &mut marks.marks {
                    let points: &mut [Point2<f64>] = match mark {
                        Mark::Line { ends_px, .. } => ends_px,
                        Mark::Outline { points_px, .. } => points_px,
                    };
                    for point in points.iter_mut() {
                        *point -= bent(point, &camera) * bend_px;
                    }
                    for coordinate in points.iter_mut().flat_map(|p| p.coords.iter_mut()) {
                        *coordinate += draw(inputs.mark_px);
                    }
                }
                let sizes = measure(&View::new(camera, pose.unwrap()), self.method, &self.container, &marks);
                sizes.into_iter().find(|(q, _)| *q == quantity).unwrap().1.unwrap().predicted_mm
            })
            .collect();
        ErrorStats::from_errors(&sizes).unwrap().sample_sd.unwrap()
    }

    #[track_caller]
    fn check(&self, quantity: Quantity, inputs: InputSigma, part: impl Fn(&SizeSigma) -> f64) {
        let (predicted, drawn) = (part(&self.sigma(quantity, &inputs)), self.monte_carlo_mm(quantity, &inputs));
        assert!(
            predicted > 0.0 && (predicted / drawn - 1.0).abs() < TOLERANCE,
            "{quantity}: {predicted} against {drawn} mm"
        );
    }
}

/// How far a lens shows a point too far out, per px by which it shows the corners too far out.
fn bent(point: &Point2<f64>, camera: &Camera) -> Vector2<f64> {
    let [cx, cy] = camera.principal_px();
    let out = Vector2::new(point.x - cx, point.y - cy);
    out * (out.norm_squared() / 1620.0_f64.powi(3)) // half the diagonal
}

fn check_all(scene: &Scene, quantity: Quantity) {
    scene.check(quantity, InputSigma { pitch_rad: 0.004, ..NONE }, |s| s.pitch_mm);
    scene.check(quantity, InputSigma { range_relative: 0.01, ..NONE }, |s| s.range_mm);
    scene.check(quantity, InputSigma { mark_px: 1.0, ..NONE }, |s| s.marks_mm);
    scene.check(quantity, InputSigma { focal_relative: 0.005, principal_px: 3.0, ..NONE }, |s| s.camera_mm);
    scene.check(quantity, InputSigma { mount_rad: 0.004, ..NONE }, |s| s.mount_mm);
    scene.check(quantity, InputSigma { range_offset_mm: 5.0, range_noise_mm: 5.0, ..NONE }, |s| s.range_mm);
    scene.check(quantity, InputSigma { distortion_px: 3.0, ..NONE }, |s| s.camera_mm);
    let rolls = scene.method != Method::Paper;
    let all = InputSigma {
        pitch_rad: 0.004,
        tilt_rad: if rolls { 0.004 } else { 0.0 },
        mount_rad: 0.004,
        range_offset_mm: 3.0,
        distortion_px: 3.0,
        turn_noise_rad: if rolls { 0.003 } else { 0.0 },
        range_noise_mm: 2.0,
        range_relative: 0.01,
        mark_px: 1.0,
        focal_relative: 0.005,
        principal_px: 3.0,
        ..NONE
    };
    scene.check(quantity, all, |s| s.total_mm);
}

#[test]
fn plates_marked_by_lines() {
    let plate = scene(Method::Ray, 6.0, Kind::Plate, Shape::Circle, lines_of_a_plate);
    check_all(&plate, Quantity::Diameter);
}

#[test]
fn bowls_whose_rim_plane_is_uncertain_too() {
    for (method, roll_deg) in [(Method::Ray, 6.0), (Method::Paper, 0.0)] {
        let bowl = scene(method, roll_deg, Kind::Bowl, Shape::Circle, bowl);
        check_all(&bowl, Quantity::Height);
        check_all(&bowl, Quantity::Diameter);
    }
}

#[test]
fn bowls_with_sloped_walls_by_their_circles() {
    let sloped = |view: &View| {
        let circle = |feature, radius_mm: f64, z_mm: f64| {
            let points = (0..20)
                .map(|i| (f64::from(i) * 0.3).sin_cos())
                .map(|(s, c)| pixel(view, radius_mm * c, 350.0 + radius_mm * s, z_mm));
            Mark::Outline { feature, points_px: points.collect() }
        };
        vec![circle(Feature::Rim, 80.0, 60.0), circle(Feature::Base, 45.0, 0.0)]
    };
    let bowl = scene(Method::Coaxial, 7.0, Kind::Bowl, Shape::Circle, sloped);
    check_all(&bowl, Quantity::Height);
    check_all(&bowl, Quantity::Diameter);
}

#[test]
fn squares_marked_by_their_corners() {
    let square = scene(Method::Ray, -8.0, Kind::Plate, Shape::Square, square);
    check_all(&square, Quantity::Width);
    let rectangle = Scene { container: Container { shape: Shape::Rectangle, ..square.container }, ..square };
    check_all(&rectangle, Quantity::Length);
}

#[test]
fn roll_counts_for_a_slanted_view() {
    let plate = scene(Method::Ray, 15.0, Kind::Plate, Shape::Circle, |view| {
        vec![line(view, Quantity::Diameter, [60.0, 250.0, 0.0], [200.0, 400.0, 0.0])]
    });
    plate.check(Quantity::Diameter, InputSigma { tilt_rad: 0.01, ..NONE }, |s| s.roll_mm);
}

/// More marks of one size shrink the part from the marks, and no other part.
#[test]
fn only_the_marks_part_shrinks_with_the_number_of_marks() {
    let one = scene(Method::Ray, 0.0, Kind::Plate, Shape::Circle, |view| lines_of_a_plate(view)[..1].to_vec());
    let four = scene(Method::Ray, 0.0, Kind::Plate, Shape::Circle, |view| vec![lines_of_a_plate(view)[0].clone(); 4]);
    let inputs = InputSigma { pitch_rad: 0.01, range_relative: 0.03, mark_px: 2.0, ..NONE };
    let (one, four) = (one.sigma(Quantity::Diameter, &inputs), four.sigma(Quantity::Diameter, &inputs));
    assert!((one.marks_mm / four.marks_mm - 2.0).abs() < 1e-9);
    assert!((one.range_mm - four.range_mm).abs() < 1e-9 && (one.pitch_mm - four.pitch_mm).abs() < 1e-9);
}
