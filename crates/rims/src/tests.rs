//! Rendered scenes with known truth.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use ingest::Picture;
use model::lens::{Division, Fisheye};
use model::{Camera, Container, InputSigma, Kind, LensModel, Method, Pose, Quantity, Shape, View};
use nalgebra::{Point2, Point3};
use simulate::render::Renderer;
use simulate::scene::{Bowl, Outline, Plate, Scene, Solid};

use crate::{HeightSource, Rim, RimError, find_rims};

const INPUTS: InputSigma = InputSigma {
    pitch_rad: 0.01,
    tilt_rad: 0.01,
    range_relative: 0.02,
    mark_px: 1.0,
    focal_relative: 0.005,
    principal_px: 2.0,
    ..InputSigma::NONE
};

fn view(lens: LensModel, pitch_deg: f64) -> View {
    let camera = Camera::new([800, 600], [520.0, 520.0], [401.0, 296.0], 0.0, lens).unwrap();
    View::new(camera, Pose::new(pitch_deg.to_radians(), (-6_f64).to_radians(), 480.0).unwrap())
}

fn picture(view: &View, scene: &Scene) -> Picture {
    let rendered = Renderer::new(*view.camera()).render(scene, view.pose());
    Picture { width_px: rendered.width_px, height_px: rendered.height_px, rgb: rendered.rgb }
}

/// The point of the table in the middle of the picture, moved a little.
fn middle(view: &View) -> Point2<f64> {
    let [x, y] = view.camera().principal_px();
    view.on_plane(Point2::new(x + 30.0, y - 20.0), 0.0).unwrap()
}

fn plate(view: &View, diameter_mm: f64) -> Scene {
    let plate = Plate { center_mm: middle(view), half_width_mm: 0.5 * diameter_mm, outline: Outline::Circle };
    Scene { solid: Solid::Plate(plate), colour: [230.0, 228.0, 220.0] }
}

fn bowl(view: &View, rim_mm: f64, foot_mm: f64, height_mm: f64) -> Scene {
    let bowl = Bowl { center_mm: middle(view), foot_radius_mm: 0.5 * foot_mm, rim_radius_mm: 0.5 * rim_mm, height_mm };
    Scene { solid: Solid::Bowl(bowl), colour: [90.0, 170.0, 190.0] }
}

fn likely(view: &View, picture: &Picture) -> Vec<Rim> {
    find_rims(picture, view).unwrap().into_iter().filter(|rim| rim.confidence >= 0.5).collect()
}

fn size_mm(rim: &Rim, view: &View, kind: Kind, rim_height_mm: Option<f64>, wanted: Quantity) -> (f64, f64) {
    let container = Container { kind, shape: Shape::Circle, rim_height_mm, wall: None };
    let sizes = rim.sizes(view, Method::Ray, &container, &INPUTS);
    let (_, size) = sizes.into_iter().find(|(quantity, _)| *quantity == wanted).unwrap();
    let size = size.unwrap();
    (size.measured.predicted_mm, size.sigma.total_mm)
}

#[test]
fn plates_are_found_under_every_lens_and_pitch() {
    let fisheye = LensModel::Fisheye(Fisheye { k1: -0.02, k2: 0.004, k3: 0.0, k4: 0.0 });
    let division = LensModel::Division(Division { lambda: -0.15 });
    for lens in [LensModel::None, division, fisheye] {
        for pitch_deg in [35.0, 55.0, 75.0, 89.0] {
            let view = view(lens, pitch_deg);
            let rims = likely(&view, &picture(&view, &plate(&view, 230.0)));
            assert_eq!(rims.len(), 1, "{lens:?} at {pitch_deg} degrees: {rims:?}");
            let (diameter_mm, _) = size_mm(&rims[0], &view, Kind::Plate, Some(0.0), Quantity::Diameter);
            assert!((diameter_mm / 230.0 - 1.0).abs() < 0.006, "{lens:?} at {pitch_deg} degrees: {diameter_mm:.1} mm");
            assert_eq!(rims[0].kind, Kind::Plate, "{lens:?} at {pitch_deg} degrees");
        }
    }
}

#[test]
fn a_bowl_whose_foot_is_seen_gives_its_height() {
    for (pitch_deg, rim_mm, foot_mm, height_mm) in [(30.0, 150.0, 90.0, 60.0), (40.0, 120.0, 100.0, 80.0)] {
        let view = view(LensModel::None, pitch_deg);
        let rims = likely(&view, &picture(&view, &bowl(&view, rim_mm, foot_mm, height_mm)));
        assert_eq!(rims.len(), 1, "{rims:?}");
        let rim = &rims[0];
        assert_eq!(rim.height.source, HeightSource::Foot);
        assert!((rim.height.mm / height_mm - 1.0).abs() < 0.15, "{:?} of {height_mm}", rim.height);
        let (known, sigma_known) = size_mm(rim, &view, Kind::Bowl, Some(height_mm), Quantity::Diameter);
        assert!((known / rim_mm - 1.0).abs() < 0.01, "{known:.1} of {rim_mm} mm");
        let (found, sigma_found) = size_mm(rim, &view, Kind::Bowl, None, Quantity::Diameter);
        assert!((found / rim_mm - 1.0).abs() < 0.05, "{found:.1} of {rim_mm} mm");
        assert!(sigma_found > sigma_known, "the height's uncertainty reaches the diameter");
        let (height, _) = size_mm(rim, &view, Kind::Bowl, None, Quantity::Height);
        assert!((height - rim.height.mm).abs() < 1e-9);
    }
}

/// Seen from straight above, the foot is hidden, and the floor hardly moves with the height: the uncertainty says so.
#[test]
fn a_hidden_foot_leaves_the_height_uncertain() {
    let view = view(LensModel::None, 88.0);
    let rims = likely(&view, &picture(&view, &bowl(&view, 150.0, 80.0, 60.0)));
    assert_eq!(rims.len(), 1, "{rims:?}");
    let height = rims[0].height;
    assert_ne!(height.source, HeightSource::Foot);
    assert!(height.sigma_mm > 0.15 * height.mm && (height.mm - 60.0).abs() < 2.0 * height.sigma_mm, "{height:?}");
}

/// A hand over part of the rim: a flat, straight band from the centre's right to beyond the rim, seen from above.
fn cover(picture: &mut Picture, view: &View, center: Point2<f64>) {
    let width = picture.width_px as usize;
    for (at, pixel) in picture.rgb.chunks_exact_mut(3).enumerate() {
        let place = view.on_plane(Point2::new((at % width) as f64, (at / width) as f64), 0.0);
        let Ok(place) = place else { continue };
        let away = place - center;
        if away.x > 35.0 && (-70.0..90.0).contains(&(away.y - 0.3 * away.x)) {
            pixel.copy_from_slice(&[205, 150, 120]);
        }
    }
}

#[test]
fn a_rim_that_is_partly_covered_or_cut_is_found() {
    let view = view(LensModel::None, 55.0);
    let mut covered = picture(&view, &plate(&view, 230.0));
    cover(&mut covered, &view, middle(&view));
    let rims = likely(&view, &covered);
    assert_eq!(rims.len(), 1, "{rims:?}");
    let (diameter_mm, _) = size_mm(&rims[0], &view, Kind::Plate, Some(0.0), Quantity::Diameter);
    assert!((diameter_mm / 230.0 - 1.0).abs() < 0.01, "{diameter_mm:.1} mm");

    // A quarter of the plate's width lies beyond the right border.
    let corner = view.on_plane(Point2::new(720.0, 300.0), 0.0).unwrap();
    let plate = Plate { center_mm: corner, half_width_mm: 115.0, outline: Outline::Circle };
    let cut = Scene { solid: Solid::Plate(plate), colour: [230.0, 228.0, 220.0] };
    let rims = likely(&view, &picture(&view, &cut));
    assert_eq!(rims.len(), 1, "{rims:?}");
    let (diameter_mm, _) = size_mm(&rims[0], &view, Kind::Plate, Some(0.0), Quantity::Diameter);
    assert!((diameter_mm / 230.0 - 1.0).abs() < 0.015, "{diameter_mm:.1} mm");
}

#[test]
fn a_table_without_containers_has_no_rims() {
    for pitch_deg in [30.0, 55.0, 85.0] {
        let view = view(LensModel::None, pitch_deg);
        // A plate so small that it is none, and far behind everything.
        let far = Plate { center_mm: Point2::new(0.0, 1e5), half_width_mm: 1.0, outline: Outline::Circle };
        let scene = Scene { solid: Solid::Plate(far), colour: [0.0; 3] };
        assert_eq!(likely(&view, &picture(&view, &scene)), Vec::new(), "{pitch_deg} degrees");
    }
}

#[test]
fn pictures_without_edges_and_odd_sizes_are_no_trouble() {
    for [width, height] in [[1, 1], [7, 500], [64, 3], [200, 200]] {
        let camera = Camera::new([width, height], [100.0, 100.0], [0.0, 0.0], 0.0, LensModel::None).unwrap();
        let view = View::new(camera, Pose::new(0.8, 0.0, 500.0).unwrap());
        let grey = Picture { width_px: width, height_px: height, rgb: vec![90; (3 * width * height) as usize] };
        assert_eq!(find_rims(&grey, &view), Ok(Vec::new()));
        let speckled = Picture { rgb: (0..3 * width * height).map(|i| (i * 7919 % 251) as u8).collect(), ..grey };
        assert!(find_rims(&speckled, &view).is_ok());
        let short = Picture { rgb: Vec::new(), ..speckled.clone() };
        assert!(matches!(find_rims(&short, &view), Err(RimError::Bytes { .. })));
        let other = Picture { width_px: width + 1, ..speckled };
        assert!(matches!(find_rims(&other, &view), Err(RimError::Size { .. })));
    }
}

#[test]
fn points_lie_on_the_rim_and_the_centre_in_its_middle() {
    let view = view(LensModel::None, 50.0);
    let rims = likely(&view, &picture(&view, &plate(&view, 200.0)));
    let center = middle(&view);
    for point in &rims[0].points_px {
        let away = (view.on_plane(*point, 0.0).unwrap() - center).norm();
        assert!((away - 100.0).abs() < 1.5, "{away:.2} mm from the centre");
    }
    let expected = view.pixel_of(Point3::new(center.x, center.y, 0.0)).unwrap();
    assert!((rims[0].center_px - expected).norm() < 1.0);
}

/// A plate's rim lies some way above the table, which is not seen of a plate without a well: the size carries that.
#[test]
fn a_plate_is_measured_above_the_table_and_the_doubt_is_told() {
    let view = view(LensModel::None, 55.0);
    let rims = likely(&view, &picture(&view, &plate(&view, 230.0)));
    let height = rims[0].plate_height;
    assert!((8.0..35.0).contains(&height.mm) && height.sigma_mm > 4.0, "{height:?}");
    let (on_table, sigma_given) = size_mm(&rims[0], &view, Kind::Plate, Some(0.0), Quantity::Diameter);
    let (above, sigma) = size_mm(&rims[0], &view, Kind::Plate, None, Quantity::Diameter);
    let lower = 1.0 - height.mm / view.pose().camera_height_mm();
    assert!((above / on_table - lower).abs() < 0.002, "{above:.1} of {on_table:.1} mm");
    assert!(sigma > sigma_given && sigma > 0.5 * 230.0 * height.sigma_mm / view.pose().camera_height_mm());
    let sizes = rims[0].sizes(
        &view,
        Method::Ray,
        &Container { kind: Kind::Plate, shape: Shape::Circle, rim_height_mm: None, wall: None },
        &INPUTS,
    );
    assert!(sizes.iter().all(|(quantity, _)| *quantity == Quantity::Diameter), "a plate has no height to tell");
}

/// Tables of `simulate bench` at 440 mm and 55 degrees: what is found, how wide, and how high within what is said.
#[test]
fn laid_tables_are_measured() {
    let camera = simulate::laid::camera([560, 420]).unwrap();
    let plan = simulate::laid::bench(77, 560).swap_remove(4);
    let (mut round, mut errors, mut surprises) = (0, Vec::new(), 0);
    for frame in &plan.frames {
        let view = frame.view(&camera).unwrap();
        let truth = frame.truths(&view).remove(0);
        let Some(true_mm) = truth.true_diameter_mm else { continue };
        round += 1;
        let taken = frame.photograph(&view);
        let picture = Picture { width_px: taken.width_px, height_px: taken.height_px, rgb: taken.rgb };
        let lower = 1.0 - truth.rim_level_mm / view.pose().camera_height_mm();
        let center = Point2::new(truth.center_x_mm, truth.center_y_mm);
        let is_near = |rim: &Rim| (Point2::from(rim.on_table_mm.0) * lower - center).norm() < 0.1 * true_mm;
        let Some(rim) = likely(&view, &picture).into_iter().find(is_near) else { continue };
        let (mm, _) = size_mm(&rim, &view, truth.kind, Some(truth.rim_level_mm), Quantity::Diameter);
        errors.push((mm / true_mm - 1.0).abs());
        let height = if truth.kind == Kind::Plate { rim.plate_height } else { rim.height };
        surprises += usize::from((height.mm - truth.rim_level_mm).abs() > 3.0 * height.sigma_mm);
    }
    errors.sort_by(f64::total_cmp);
    assert!(errors.len() + 1 >= round, "{} of {round} found", errors.len());
    assert!(errors[errors.len() / 2] < 0.012, "{errors:?}");
    assert!(surprises <= 1, "{surprises} heights are further off than three standard uncertainties");
}
