//! Rectangles drawn into pictures, found again.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use ingest::Picture;
use model::lens::Division;
use model::{Camera, Container, InputSigma, Kind, LensModel, Method, Pose, Quantity, Shape, View};
use nalgebra::{Point2, Rotation2, Vector2};
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::TestRunner;

use crate::{Rim, RimShape, find_rims_of};

const SIZE_PX: [u32; 2] = [960, 720];
const PLATES: usize = 24;

fn view(pitch_deg: f64, roll_deg: f64, height_mm: f64) -> View {
    let lens = LensModel::Division(Division { lambda: -0.1 });
    let camera = Camera::new(SIZE_PX, [640.0, 640.0], [480.0, 360.0], 0.0, lens).unwrap();
    let pitch = pitch_deg.to_radians();
    View::new(camera, Pose::new(pitch, roll_deg.to_radians(), height_mm / pitch.sin()).unwrap())
}

/// A level rectangle.
#[derive(Debug, Clone, Copy)]
struct Level {
    half_mm: Vector2<f64>,
    z_mm: f64,
}

/// A plate of two level rectangles, rim and well, on a table, turned; edges are a pixel soft.
struct Plate {
    at_mm: Point2<f64>,
    turn_rad: f64,
    rim: Level,
    well: Option<Level>,
}

impl Plate {
    /// How far a pixel's ray meets a level within the rectangle's border there, in mm.
    fn within(&self, view: &View, pixel: Point2<f64>, level: &Level) -> f64 {
        let Ok(place) = view.on_plane(pixel, level.z_mm) else { return f64::NEG_INFINITY };
        let own = Rotation2::new(-self.turn_rad) * (place - self.at_mm);
        (level.half_mm.x - own.x.abs()).min(level.half_mm.y - own.y.abs())
    }

    fn picture(&self, view: &View) -> Picture {
        let share = |within_mm: f64| (0.5 + within_mm / 1.2).clamp(0.0, 1.0);
        let mix = |a: f64, b: f64, share: f64| a + (b - a) * share;
        let mut rgb = Vec::new();
        for y in 0..SIZE_PX[1] {
            for x in 0..SIZE_PX[0] {
                let pixel = Point2::new(f64::from(x), f64::from(y));
                let plate = mix(95.0, 190.0, share(self.within(view, pixel, &self.rim)));
                let well = self.well.map_or(0.0, |well| share(self.within(view, pixel, &well)));
                let level = mix(plate, 225.0, well) + f64::from((x * 7 + y * 13) % 5);
                rgb.extend([level, level, 0.9 * level].map(|c| c as u8));
            }
        }
        Picture { width_px: SIZE_PX[0], height_px: SIZE_PX[1], rgb }
    }

    fn found(&self, view: &View) -> Vec<Rim> {
        let rims = find_rims_of(&self.picture(view), view, &[RimShape::Rectangle]).unwrap();
        rims.into_iter().filter(|rim| rim.confidence >= 0.5).collect()
    }
}

fn plate(sides_mm: [f64; 2], turn_deg: f64, rim_mm: f64, flange_mm: f64) -> Plate {
    let half_mm = Vector2::new(0.5 * sides_mm[0], 0.5 * sides_mm[1]);
    let well = Level { half_mm: half_mm.add_scalar(-flange_mm), z_mm: 6.0 };
    let rim = Level { half_mm, z_mm: rim_mm };
    Plate { at_mm: Point2::new(0.0, 0.0), turn_rad: turn_deg.to_radians(), rim, well: Some(well) }
}

/// The plate where the camera looks.
fn in_view(plate: Plate, view: &View) -> Plate {
    Plate { at_mm: view.on_plane(Point2::new(470.0, 370.0), 0.0).unwrap(), ..plate }
}

fn sizes_mm(rim: &Rim, view: &View, rim_height_mm: f64) -> [f64; 2] {
    let rim_height_mm = Some(rim_height_mm);
    let container = Container { kind: Kind::Plate, shape: Shape::Rectangle, rim_height_mm, wall: None };
    let sizes = rim.sizes(view, Method::Ray, &container, &InputSigma::NONE);
    [Quantity::Width, Quantity::Length].map(|wanted| {
        let (_, size) = sizes.iter().find(|(quantity, _)| *quantity == wanted).unwrap();
        size.as_ref().unwrap().measured.predicted_mm
    })
}

/// Always the same plates, drawn by lot.
#[test]
fn most_plates_are_found_and_what_is_found_is_measured_right() {
    let mut runner = TestRunner::deterministic();
    let poses = (42.0..75.0_f64, -8.0..8.0_f64, 380.0..500.0_f64);
    let plates = (150.0..240.0_f64, 1.0..1.6_f64, -45.0..45.0_f64, 22.0..32.0_f64);
    let mut count = 0;
    for _ in 0..PLATES {
        let (pitch_deg, roll_deg, height_mm) = poses.new_tree(&mut runner).unwrap().current();
        let (long_mm, aspect, turn_deg, rim_mm) = plates.new_tree(&mut runner).unwrap().current();
        let (view, wide_mm) = (view(pitch_deg, roll_deg, height_mm), long_mm / aspect);
        let plate = in_view(plate([long_mm, wide_mm], turn_deg, rim_mm, 0.16 * wide_mm), &view);
        for rim in plate.found(&view) {
            let [width, length] = sizes_mm(&rim, &view, rim_mm);
            // Below 48 degrees the near side's rim lies over its well.
            let most = if pitch_deg < 48.0 { 0.02 } else { 0.005 };
            assert!((width / wide_mm - 1.0).abs() < most, "{width} for {wide_mm}, pitch {pitch_deg}");
            assert!((length / long_mm - 1.0).abs() < most, "{length} for {long_mm}, pitch {pitch_deg}");
            count += 1;
        }
    }
    assert!((PLATES - 2..=PLATES).contains(&count), "{count} of {PLATES}");
}

#[test]
fn sizes_say_how_far_the_height_of_the_rim_may_be_off() {
    let view = view(58.0, 2.0, 440.0);
    let plate = in_view(plate([200.0, 150.0], 15.0, 22.0, 25.0), &view);
    let found = plate.found(&view);
    let container = Container { kind: Kind::Plate, shape: Shape::Rectangle, rim_height_mm: None, wall: None };
    for (quantity, size) in found[0].sizes(&view, Method::Ray, &container, &InputSigma::NONE) {
        let size = size.unwrap();
        let truth_mm = if quantity == Quantity::Width { 150.0 } else { 200.0 };
        let off = (size.measured.predicted_mm - truth_mm).abs() / size.sigma.total_mm;
        assert!(off < 2.0, "{quantity}: {} +- {}", size.measured.predicted_mm, size.sigma.total_mm);
        assert!(size.sigma.total_mm > 0.01 * truth_mm, "the height is only common");
    }
    assert_eq!((found[0].shape(), found[0].points_px.len()), (Shape::Rectangle, 4));
}

#[test]
fn flat_rectangles_are_no_plates() {
    let view = view(55.0, 0.0, 440.0);
    let raised = in_view(plate([200.0, 150.0], 20.0, 24.0, 24.0), &view);
    assert_eq!(raised.found(&view).len(), 1);
    let sheet = Plate { well: None, rim: Level { z_mm: 2.0, ..raised.rim }, ..raised };
    assert_eq!(sheet.found(&view), [], "a napkin, a book");
    let half_mm = sheet.rim.half_mm.add_scalar(-24.0);
    let printed = Plate { well: Some(Level { half_mm, z_mm: 2.0 }), ..sheet };
    assert_eq!(printed.found(&view), [], "a mat with a border");
    let stands = Plate { well: Some(Level { half_mm, z_mm: 24.0 }), ..printed };
    assert!(stands.found(&view).iter().all(|rim| rim.perimeter_px < 700.0), "a mat with something that stands on it");
}

#[test]
fn nothing_is_found_where_nothing_is_or_where_it_is_not_asked_for() {
    let view = view(55.0, 0.0, 440.0);
    let grey = Picture { width_px: SIZE_PX[0], height_px: SIZE_PX[1], rgb: vec![128; 3 * 960 * 720] };
    assert_eq!(find_rims_of(&grey, &view, &[RimShape::Rectangle]), Ok(Vec::new()));
    let plate = in_view(plate([200.0, 150.0], 20.0, 24.0, 24.0), &view);
    let round = find_rims_of(&plate.picture(&view), &view, &[RimShape::Circle]).unwrap();
    assert!(round.iter().all(|rim| rim.shape() == Shape::Circle));
    assert_eq!(find_rims_of(&plate.picture(&view), &view, &[]), Ok(Vec::new()));
}
