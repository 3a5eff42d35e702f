//! The worn sessions of Tables V and VI, each with one container, pictures at several pitches, and four raters.

use model::{Camera, Kind, Quantity, UtcNs, View, ViewError};
use nalgebra::{Point2, Point3, Vector2};

use super::catalogue::{colour_of, container_of};
use super::placement::{height_line, span_line};
use super::plan::{IMAGE_PERIOD_S, RaterMarks, SessionPlan, ShotPlan, check_marks, image_time_s, view_from};
use super::tables::{Published, RATERS, RaterRow};
use crate::error::SimulateError;
use crate::scene::{Bowl, Scene, Solid, Tub};
use crate::sensors::{HeadPose, Motion};
use crate::study::LabeledLine;

/// Start of the first session, 2021-03-02 18:00:00 UTC. The paper gives no dates.
const FIRST_START: UtcNs = UtcNs(1_614_708_000_000_000_000);

/// Seconds from the start of one session to that of the next.
const SESSION_PERIOD_S: f64 = 1200.0;

/// Pitch of each picture, for each session. The paper says 'without any restrictions on the position/tilt of the head' and
/// gives no readings. Two pictures of each session lie outside 55 +- 7.5 degrees.
const PITCHES_DEG: [[f64; 5]; 3] =
    [[40.0, 51.0, 55.0, 58.0, 69.0], [72.0, 59.0, 54.0, 52.0, 39.0], [43.0, 50.5, 53.0, 57.5, 66.0]];

/// Height of the camera above the table for each session, before the range is rounded to whole mm.
const CAMERA_HEIGHTS_MM: [f64; 3] = [430.0, 415.0, 445.0];

/// Middle of the target window of the study.
const TARGET_PITCH_DEG: f64 = 55.0;
/// Half of its width.
const PITCH_TOLERANCE_DEG: f64 = 7.5;

/// Factor of the sizes that the marks give on pictures outside the target window. A program that selects wrongly then gets
/// wrong tables.
pub(super) const OUTSIDE_WINDOW_FACTOR: f64 = 1.02;

/// Seconds between two pictures in which the head can turn. They are few, so that a slow low-pass does not see the turn at the
/// time of a picture.
const TURN_S: f64 = 1.6;

/// Distance between the raters' height lines.
const RATER_STEP_MM: f64 = 6.0;

/// Width of the box. The paper gives only its length and height.
const BOX_WIDTH_MM: f64 = 165.0;

/// Radius of the foot of a drawn bowl, as a share of that of its rim.
const FOOT_SHARE: f64 = 0.62;

/// One session for each container.
pub(super) fn sessions(published: &Published, camera: &Camera) -> Result<Vec<SessionPlan>, SimulateError> {
    let containers = published.container_sizes.rows.iter().zip(&published.container_heights.rows);
    let heads = PITCHES_DEG.iter().zip(CAMERA_HEIGHTS_MM);
    containers
        .zip(heads)
        .zip(0_u32..)
        .map(|(((size, height), (pitches_deg, camera_height_mm)), index)| {
            let heads: Vec<_> = pitches_deg
                .iter()
                .map(|&pitch_deg| {
                    let range_mm = (camera_height_mm / pitch_deg.to_radians().sin()).round();
                    HeadPose { pitch_deg, roll_deg: 0.0, range_mm }
                })
                .collect();
            session(camera, size, height, &heads, index)
        })
        .collect()
}

fn session(
    camera: &Camera,
    size: &RaterRow,
    height: &RaterRow,
    heads: &[HeadPose],
    index: u32,
) -> Result<SessionPlan, SimulateError> {
    let name = format!("worn-{}", size.object.replace(' ', "-"));
    let shots = heads
        .iter()
        .enumerate()
        .map(|(at, head)| shot(camera, size, height, *head, image_time_s(at), &name))
        .collect::<Result<_, _>>()?;
    let rests = heads.iter().enumerate().map(|(at, head)| (image_time_s(at), *head)).collect();
    Ok(SessionPlan {
        name,
        toml: "participant = \"W01\"\n".to_owned(),
        start: FIRST_START.plus_seconds(f64::from(index) * SESSION_PERIOD_S),
        motion: Motion { rests, half_rest_s: 0.5 * (IMAGE_PERIOD_S - TURN_S) },
        shots,
    })
}

fn shot(
    camera: &Camera,
    size: &RaterRow,
    height: &RaterRow,
    head: HeadPose,
    time_s: f64,
    session: &str,
) -> Result<ShotPlan, SimulateError> {
    let view = view_from(camera, head, session)?;
    let standing = Standing::on_axis(&view, size, height);
    let in_window = (head.pitch_deg - TARGET_PITCH_DEG).abs() <= PITCH_TOLERANCE_DEG;
    let factor = if in_window { 1.0 } else { OUTSIDE_WINDOW_FACTOR };
    let mut marks = Vec::new();
    for (at, rater) in RATERS.into_iter().enumerate() {
        let size_mm = size.predicted_cm()[at] * 10.0 * factor;
        let height_mm = height.predicted_cm()[at] * 10.0 * factor;
        let place = format!("{session}/{}/{rater} at {} degrees", size.object, head.pitch_deg);
        let lines = standing
            .marks(&view, (&size.object, size.quantity), at, size_mm, height_mm)
            .map_err(|source| SimulateError::View { place: place.clone(), source })?;
        let sizes_mm = [(Quantity::Height, height_mm), (size.quantity, size_mm)];
        check_marks(&view, &container_of(&size.object), &lines, &sizes_mm, &place)?;
        marks.push(RaterMarks { rater, lines });
    }
    let scene = Scene { solid: standing.solid(), colour: colour_of(&size.object) };
    Ok(ShotPlan { time_s, pose: *view.pose(), scene, marks })
}

/// A container of its true size that stands with its middle on the optical axis.
struct Standing {
    kind: Kind,
    center_mm: Point2<f64>,
    true_size_mm: f64,
    true_height_mm: f64,
}

impl Standing {
    fn on_axis(view: &View, size: &RaterRow, height: &RaterRow) -> Self {
        let true_height_mm = height.implied_truth_cm * 10.0;
        let below_camera_mm = view.pose().camera_height_mm() - 0.5 * true_height_mm;
        Self {
            kind: container_of(&size.object).kind,
            center_mm: Point2::new(0.0, below_camera_mm / view.pose().pitch_rad().tan()),
            true_size_mm: size.implied_truth_cm * 10.0,
            true_height_mm,
        }
    }

    fn solid(&self) -> Solid {
        let (center_mm, height_mm) = (self.center_mm, self.true_height_mm);
        let half_mm = 0.5 * self.true_size_mm;
        match self.kind {
            Kind::Box => {
                Solid::Tub(Tub { center_mm, half_size_mm: Vector2::new(half_mm, 0.5 * BOX_WIDTH_MM), height_mm })
            }
            Kind::Plate | Kind::Bowl => {
                Solid::Bowl(Bowl { center_mm, foot_radius_mm: FOOT_SHARE * half_mm, rim_radius_mm: half_mm, height_mm })
            }
        }
    }

    /// The marks of a rater. The raters differ from each other and from the truth, so only the foot and the middle of the rim are
    /// where they are drawn. The other ends are where the published sizes of this rater put them.
    fn marks(
        &self,
        view: &View,
        (object, quantity): (&str, Quantity),
        rater: usize,
        size_mm: f64,
        height_mm: f64,
    ) -> Result<Vec<LabeledLine>, ViewError> {
        #[expect(clippy::cast_precision_loss, reason = "one of four raters")]
        let foot_x_mm = (rater as f64 - 1.5) * RATER_STEP_MM;
        let foot_mm = Point2::new(self.center_mm.x + foot_x_mm, self.center_mm.y + self.far_foot_mm(foot_x_mm));
        // This is the middle of the drawn rim, carried along its ray to the plane that this rater takes for the rim's.
        let camera_height_mm = view.pose().camera_height_mm();
        let carried = (camera_height_mm - height_mm) / (camera_height_mm - self.true_height_mm);
        let middle_mm = Point3::new(self.center_mm.x * carried, self.center_mm.y * carried, height_mm);
        Ok(vec![
            height_line(view, object, foot_mm, height_mm)?,
            span_line(view, (object, quantity), middle_mm, size_mm)?,
        ])
    }

    /// The distance in mm of the far wall's foot behind the centre.
    fn far_foot_mm(&self, x_mm: f64) -> f64 {
        match self.kind {
            Kind::Box => 0.5 * BOX_WIDTH_MM,
            Kind::Plate | Kind::Bowl => {
                let foot_radius_mm = 0.5 * FOOT_SHARE * self.true_size_mm;
                (foot_radius_mm * foot_radius_mm - x_mm * x_mm).max(0.0).sqrt()
            }
        }
    }
}
