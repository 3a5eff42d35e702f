//! The plan of a session, before anything is written.

use model::{Camera, Container, Mark, Method, ObjectMarks, Pose, Quantity, UtcNs, View, measure};

use crate::error::SimulateError;
use crate::scene::Scene;
use crate::sensors::{HeadPose, Motion};
use crate::study::LabeledLine;

/// The plan of a session, which is one card.
#[derive(Debug, Clone)]
pub(super) struct SessionPlan {
    pub name: String,
    /// Content of session.toml.
    pub toml: String,
    /// Time at which the records of the sensors begin.
    pub start: UtcNs,
    pub motion: Motion,
    pub shots: Vec<ShotPlan>,
}

/// A picture to be taken, and the marks of people on it.
#[derive(Debug, Clone)]
pub(super) struct ShotPlan {
    /// Time since the start of the session.
    pub time_s: f64,
    pub pose: Pose,
    pub scene: Scene,
    pub marks: Vec<RaterMarks>,
}

/// The marks of one rater on a picture.
#[derive(Debug, Clone)]
pub(super) struct RaterMarks {
    pub rater: &'static str,
    pub lines: Vec<LabeledLine>,
}

/// Seconds from the start of a session to its first picture, which leave the filters room on both sides. They are not a multiple
/// of a sample's period.
const FIRST_IMAGE_S: f64 = 10.25;

/// Seconds between pictures.
pub(super) const IMAGE_PERIOD_S: f64 = 10.0;

/// The time of the `index`-th picture in seconds since the start of the session.
#[expect(clippy::cast_precision_loss, reason = "a handful of pictures")]
pub(super) fn image_time_s(index: usize) -> f64 {
    FIRST_IMAGE_S + index as f64 * IMAGE_PERIOD_S
}

impl SessionPlan {
    /// Seconds for which the sensors record.
    pub(super) fn duration_s(&self) -> f64 {
        image_time_s(self.shots.len())
    }
}

/// The view of `camera` at the pose of a head. `place` names it in errors.
pub(super) fn view_from(camera: &Camera, head: HeadPose, place: &str) -> Result<View, SimulateError> {
    let pose = Pose::new(head.pitch_deg.to_radians(), head.roll_deg.to_radians(), head.range_mm)
        .map_err(|source| SimulateError::Pose { place: place.to_owned(), source })?;
    Ok(View::new(*camera, pose))
}

/// Largest difference between a measured size and the one that its marks were made for.
const BACK_SOLVED_WITHIN_MM: f64 = 1e-6;

/// Checks that `lines`, all of which belong to one object, lie in the picture, and that the method `paper` measures `sizes_mm`
/// from them.
pub(super) fn check_marks(
    view: &View,
    container: &Container,
    lines: &[LabeledLine],
    sizes_mm: &[(Quantity, f64)],
    place: &str,
) -> Result<(), SimulateError> {
    let [width, height] = view.camera().size_px().map(f64::from);
    if let Some(end) = lines
        .iter()
        .flat_map(|line| line.ends_px)
        .find(|end| !(0.0..width).contains(&end.x) || !(0.0..height).contains(&end.y))
    {
        return Err(SimulateError::OutsidePicture { place: place.to_owned(), x: end.x, y: end.y });
    }
    let marks = lines.iter().map(|line| Mark::Line { quantity: line.quantity, ends_px: line.ends_px }).collect();
    let measured = measure(view, Method::Paper, container, &ObjectMarks { object: String::new(), marks });
    for &(quantity, expected_mm) in sizes_mm {
        let got_mm = match measured.iter().find(|(found, _)| *found == quantity) {
            Some((_, Ok(measured))) => measured.predicted_mm,
            Some((_, Err(source))) => return Err(SimulateError::Measure { place: place.to_owned(), source: *source }),
            None => f64::NAN,
        };
        let within = (got_mm - expected_mm).abs() <= BACK_SOLVED_WITHIN_MM;
        if !within {
            return Err(SimulateError::NotBackSolved { place: format!("{place}/{quantity}"), expected_mm, got_mm });
        }
    }
    Ok(())
}
