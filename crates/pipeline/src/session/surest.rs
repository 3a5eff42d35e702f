//! The selected images of a session in the order of their uncertainty, whether they are marked or not.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use model::{Container, Feature, FrameReason, Kind, Mark, Method, ObjectMarks, Shape, View, estimate};
use nalgebra::{Point2, Point3};

use super::frames::{Frame, Session, inputs_of, penalty_of};
use crate::calibration::corrected_view;

/// The predicted uncertainty and the rank of each selected image, by its number in the session.
pub(super) struct Surest {
    by_number: BTreeMap<usize, (f64, u32)>,
}

/// The radius of the plate by which images are judged.
const PLATE_RADIUS_MM: f64 = 100.0;
/// The number of points along its rim.
const AROUND: u32 = 12;

impl Surest {
    pub(super) fn of_session(session: &Session<'_>) -> Self {
        let selected = session.frames.iter().enumerate().filter(|(_, f)| f.signals.reason == FrameReason::Selected);
        let mut sigmas: Vec<(usize, f64)> =
            selected.filter_map(|(number, frame)| Some((number, plate_sigma_mm(session, frame)?))).collect();
        sigmas.sort_by(|a, b| a.1.total_cmp(&b.1));
        let ranked = sigmas.into_iter().zip(1..).map(|((number, sigma_mm), rank)| (number, (sigma_mm, rank)));
        Self { by_number: ranked.collect() }
    }

    /// See [`model::FrameRow::plate_sigma_mm`].
    pub(super) fn sigma_mm(&self, number: usize) -> Option<f64> {
        self.by_number.get(&number).map(|(sigma_mm, _)| *sigma_mm)
    }

    /// See [`model::FrameRow::rank`].
    pub(super) fn rank(&self, number: usize) -> Option<u32> {
        self.by_number.get(&number).map(|(_, rank)| *rank)
    }
}

/// The standard uncertainty, in mm, that the diameter of a plate ahead would have in this image, with the image's doubts;
/// none where the picture could not show such a plate, not even beyond its borders.
fn plate_sigma_mm(session: &Session<'_>, frame: &Frame) -> Option<f64> {
    let view = View::new(session.marks_camera, frame.signals.pose_for(Method::Ray)?);
    let view = corrected_view(session.study.calibration.as_ref(), Method::Ray, view)?;
    let y_mm = view.pose().range_mm() * view.pose().pitch_rad().cos();
    let rim = |i: u32| -> Option<Point2<f64>> {
        let (sin, cos) = (TAU * f64::from(i) / f64::from(AROUND)).sin_cos();
        view.pixel_of(Point3::new(PLATE_RADIUS_MM * cos, y_mm + PLATE_RADIUS_MM * sin, 0.0)).ok()
    };
    let points_px = (0..AROUND).map(rim).collect::<Option<Vec<_>>>()?;
    let marks = ObjectMarks { object: String::new(), marks: vec![Mark::Outline { feature: Feature::Rim, points_px }] };
    let plate = Container { kind: Kind::Plate, shape: Shape::Circle, rim_height_mm: None, wall: None };
    let sizes = estimate(&view, Method::Ray, &plate, &marks, &inputs_of(session.study, frame));
    let (_, size) = sizes.into_iter().next()?;
    Some(size.ok()?.sigma.total_mm * penalty_of(session.study, frame).sqrt())
}
