//! Rows of results.parquet of level frame.

use model::results::RESULTS_SCHEMA_VERSION;
use model::{Doubt, Estimate, FrameReason, Level, MeasureError, Method, Pose, Quantity, ResultRow, SizeSigma};

use super::found::height_source;
use super::marked::Marked;
use crate::labelme::MarksAuthor;
use rims::HeightSource;

/// The row of one size on one image.
pub(super) fn frame_row(
    marked: &Marked<'_>,
    pose: Pose,
    method: Method,
    quantity: Quantity,
    size: &Result<Estimate, MeasureError>,
) -> ResultRow {
    let Marked { session, frame, rater, object, marks, .. } = marked;
    let estimate = size.as_ref().ok();
    let measured = estimate.map(|e| e.measured);
    let truth_mm = object.truth_mm.get(&quantity).copied();
    let predicted_mm = measured.map(|m| m.predicted_mm);
    let row = ResultRow {
        schema_version: RESULTS_SCHEMA_VERSION,
        study: session.study.spec.name.clone(),
        session: session.dir.name.clone(),
        participant: session.spec.participant.clone(),
        object: marks.object.clone(),
        kind: object.container.kind,
        shape: object.container.shape,
        setup_height_mm: session.spec.setup_height_mm,
        setup_pitch_deg: session.spec.setup_pitch_deg,
        rater: (*rater).to_owned(),
        image: Some(frame.image.file.clone()),
        time_utc: Some(frame.image.time),
        pitch_deg: Some(pose.pitch_rad().to_degrees()),
        roll_deg: Some(pose.roll_rad().to_degrees()),
        range_mm: Some(pose.range_mm()),
        quantity,
        method,
        level: Level::Frame,
        predicted_mm,
        sigma_mm: None,
        sigma_pitch_mm: None,
        sigma_roll_mm: None,
        sigma_range_mm: None,
        sigma_marks_mm: None,
        sigma_camera_mm: None,
        plane_z_mm: measured.map(|m| m.plane_z_mm),
        truth_mm,
        error_pct: error_pct(predicted_mm, truth_mm),
        selected: frame.signals.reason == FrameReason::Selected,
        frames: 1,
        spread_mm: None,
        flags: flags(marked, size.as_ref().err()),
        method_used: estimate.map(|e| e.method),
        doubts: estimate.map(|e| doubt_codes(&e.doubts)).unwrap_or_default(),
        sigma_mount_mm: None,
        sigma_common_mm: None,
        wall_slope: estimate.and_then(|e| e.wall_slope),
        rank: None,
        weight: None,
        chi_squared: None,
        chi_squared_degrees: None,
        consistency: None,
        // What the program was sure of was its own rim.
        confidence: marked.found.filter(|_| marked.author == MarksAuthor::Program).map(|found| found.confidence),
        sigma_disagreement_mm: None,
    };
    match estimate {
        Some(estimate) => with_sigma(row, &estimate.sigma),
        None => row,
    }
}

fn flags(marked: &Marked<'_>, error: Option<&MeasureError>) -> String {
    let signals = &marked.frame.signals;
    let picture_px = marked.session.marks_camera.size_px();
    let mut flags: Vec<&str> = Vec::new();
    flags.extend((signals.reason != FrameReason::Selected).then(|| signals.reason.code()));
    flags.extend(signals.flags.iter().map(|flag| flag.code()));
    flags.extend((!marked.marks.inside_picture(picture_px)).then_some("mark_outside_picture"));
    flags.extend(marked.is_corrected().then_some("corrected"));
    let is_common = height_source(marked) == Some(HeightSource::Common);
    flags.extend(is_common.then_some("rim_height_common"));
    flags.extend(error.map(|error| error.problem_code().code()));
    flags.join(",")
}

/// The row with this uncertainty and its parts.
pub(super) fn with_sigma(row: ResultRow, sigma: &SizeSigma) -> ResultRow {
    ResultRow {
        sigma_mm: Some(sigma.total_mm),
        sigma_pitch_mm: Some(sigma.pitch_mm),
        sigma_roll_mm: Some(sigma.roll_mm),
        sigma_range_mm: Some(sigma.range_mm),
        sigma_marks_mm: Some(sigma.marks_mm),
        sigma_camera_mm: Some(sigma.camera_mm),
        sigma_mount_mm: Some(sigma.mount_mm),
        sigma_common_mm: Some(sigma.common_mm),
        sigma_disagreement_mm: Some(sigma.disagreement_mm),
        ..row
    }
}

/// The codes of doubts, joined by commas.
pub(super) fn doubt_codes(doubts: &[Doubt]) -> String {
    doubts.iter().map(|doubt| doubt.code()).collect::<Vec<_>>().join(",")
}

/// The signed error in per cent of the truth.
pub(super) fn error_pct(predicted_mm: Option<f64>, truth_mm: Option<f64>) -> Option<f64> {
    Some(100.0 * (predicted_mm? - truth_mm?) / truth_mm?)
}
