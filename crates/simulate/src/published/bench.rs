//! The nine bench sessions, each of one setup with one picture of every object.

use model::{Camera, Kind, Quantity, UtcNs, View, ViewError};
use nalgebra::{Point2, Point3};

use super::catalogue::{colour_of, container_of, span_of};
use super::placement::{axis_point_y_mm, height_line, span_line, standing_bowl};
use super::plan::{RaterMarks, SessionPlan, ShotPlan, check_marks, image_time_s, view_from};
use super::tables::{Published, SetupRow};
use crate::error::SimulateError;
use crate::scene::{Outline, Plate, Scene, Solid};
use crate::sensors::{HeadPose, Motion};
use crate::study::LabeledLine;

/// The rater of the bench pictures. The paper does not name one.
const RATER: &str = "bench";

/// Start of the first session, 2021-03-01 15:00:00 UTC. The paper gives no dates.
const FIRST_START: UtcNs = UtcNs(1_614_610_800_000_000_000);

/// Seconds from the start of one session to that of the next.
const SESSION_PERIOD_S: f64 = 600.0;

/// Distances of objects from the axis point and from each other, so that not every mark is symmetric about the axis.
const STEP_X_MM: f64 = 12.0;
const STEP_Y_MM: f64 = 7.0;

/// An object as it is drawn, with its marks and the sizes that they stand for.
struct Placed {
    solid: Solid,
    lines: Vec<LabeledLine>,
    sizes_mm: Vec<(Quantity, f64)>,
}

/// One session for each setup.
pub(super) fn sessions(published: &Published, camera: &Camera) -> Result<Vec<SessionPlan>, SimulateError> {
    published.setups().into_iter().zip(0_u32..).map(|(setup, index)| session(published, camera, setup, index)).collect()
}

fn session(published: &Published, camera: &Camera, setup: &SetupRow, index: u32) -> Result<SessionPlan, SimulateError> {
    let head = HeadPose { pitch_deg: setup.pitch_deg, roll_deg: 0.0, range_mm: setup.range_mm };
    let name = format!("bench-{}cm-{}deg", setup.height_cm, setup.pitch_deg);
    let view = view_from(camera, head, &name)?;
    let objects = published.plates.objects().into_iter().chain(published.bowl_heights.objects());
    let shots = objects
        .enumerate()
        .map(|(at, object)| shot(published, &view, setup, (at, object), &format!("{name}/{object}")))
        .collect::<Result<_, _>>()?;
    Ok(SessionPlan {
        name,
        toml: format!("setup_height_mm = {:.1}\nsetup_pitch_deg = {:.1}\n", setup.height_cm * 10.0, setup.pitch_deg),
        start: FIRST_START.plus_seconds(f64::from(index) * SESSION_PERIOD_S),
        motion: Motion::fixed(head),
        shots,
    })
}

/// The plan of the picture of the `at`-th object. `place` names it in errors.
fn shot(
    published: &Published,
    view: &View,
    setup: &SetupRow,
    (at, object): (usize, &str),
    place: &str,
) -> Result<ShotPlan, SimulateError> {
    let container = container_of(object);
    let placed = match container.kind {
        Kind::Plate => {
            let size_mm = published.plates.at_setup(object, setup)?.predicted_cm * 10.0;
            plate(view, object, at, size_mm)
        }
        Kind::Bowl | Kind::Box => {
            let height_mm = published.bowl_heights.at_setup(object, setup)?.predicted_cm * 10.0;
            let diameter_mm = published.bowl_diameters.at_setup(object, setup)?.predicted_cm * 10.0;
            bowl(view, object, at, height_mm, diameter_mm)
        }
    };
    let placed = placed.map_err(|source| SimulateError::View { place: place.to_owned(), source })?;
    check_marks(view, &container, &placed.lines, &placed.sizes_mm, place)?;
    Ok(ShotPlan {
        time_s: image_time_s(at),
        pose: *view.pose(),
        scene: Scene { solid: placed.solid, colour: colour_of(object) },
        marks: vec![RaterMarks { rater: RATER, lines: placed.lines }],
    })
}

fn plate(view: &View, object: &str, at: usize, size_mm: f64) -> Result<Placed, ViewError> {
    let center_mm = Point2::new(place_x_mm(at), axis_point_y_mm(view) + place_y_mm(at));
    let quantity = span_of(&container_of(object));
    let outline = if quantity == Quantity::Diameter { Outline::Circle } else { Outline::Square };
    let on_table_mm = Point3::new(center_mm.x, center_mm.y, 0.0);
    Ok(Placed {
        solid: Solid::Plate(Plate { center_mm, half_width_mm: 0.5 * size_mm, outline }),
        lines: vec![span_line(view, (object, quantity), on_table_mm, size_mm)?],
        sizes_mm: vec![(quantity, size_mm)],
    })
}

fn bowl(view: &View, object: &str, at: usize, height_mm: f64, diameter_mm: f64) -> Result<Placed, ViewError> {
    let (bowl, foot_y_mm) = standing_bowl(view, place_x_mm(at), height_mm, diameter_mm)?;
    let rim_center_mm = Point3::new(bowl.center_mm.x, bowl.center_mm.y, height_mm);
    let foot_mm = Point2::new(bowl.center_mm.x, foot_y_mm);
    Ok(Placed {
        solid: Solid::Bowl(bowl),
        lines: vec![
            height_line(view, object, foot_mm, height_mm)?,
            span_line(view, (object, Quantity::Diameter), rim_center_mm, diameter_mm)?,
        ],
        sizes_mm: vec![(Quantity::Height, height_mm), (Quantity::Diameter, diameter_mm)],
    })
}

/// X of the `at`-th object: left, middle, right, and again.
#[expect(clippy::cast_precision_loss, reason = "0, 1 or 2")]
fn place_x_mm(at: usize) -> f64 {
    ((at % 3) as f64 - 1.0) * STEP_X_MM
}

/// Y of the `at`-th object from the axis point: near, far, and again.
#[expect(clippy::cast_precision_loss, reason = "0 or 1")]
fn place_y_mm(at: usize) -> f64 {
    ((at % 2) as f64 - 0.5) * 2.0 * STEP_Y_MM
}
