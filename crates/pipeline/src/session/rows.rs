//! Rows of the results (level frame) and of the ledger.

use std::collections::{BTreeMap, BTreeSet};

use ingest::card::{Card, CardFile, Patterns};
use model::results::RESULTS_SCHEMA_VERSION;
use model::{
    Estimate, FrameReason, FrameRow, Level, MeasureError, Method, ObjectMarks, Pose, Problem, Quantity, ResultRow,
    Severity, Stage, View, estimate,
};

use super::marks::SessionMarks;
use super::{Frame, Session};
use crate::study::{Object, SessionDir, Study};

/// One object as one rater marked it on one frame.
struct Marked<'a> {
    session: &'a Session<'a>,
    frame: &'a Frame,
    rater: &'a str,
    object: &'a Object,
    marks: &'a ObjectMarks,
}

/// Sizes of everything that is marked on frames with a pose, in the order that docs/results.md gives.
pub(super) fn measure_all(session: &Session<'_>, marks: &SessionMarks, problems: &mut Vec<Problem>) -> Vec<ResultRow> {
    let mut rows = Vec::new();
    for frame in &session.frames {
        for (rater, objects) in marks.of_image(&frame.image.file) {
            if frame.signals.pose.is_none() {
                problems.push(unusable(session, frame, rater));
                continue;
            }
            for marks in objects {
                // Marks of unknown objects were refused when they were read.
                let Some(object) = session.study.objects.get(&marks.object) else { continue };
                rows.extend(measure_one(&Marked { session, frame, rater, object, marks }, problems));
            }
        }
    }
    rows.sort_by(|a, b| order(a).cmp(&order(b)));
    rows
}

/// What the rows of one session are ordered by.
fn order(row: &ResultRow) -> impl Ord + '_ {
    (row.time_utc, &row.image, &row.object, &row.rater, row.quantity, row.method)
}

fn unusable(session: &Session<'_>, frame: &Frame, rater: &str) -> Problem {
    Problem {
        severity: Severity::Loss,
        stage: Stage::Signals,
        code: "marked_image_without_pose".to_owned(),
        place: session.place_of(&frame.image.file),
        fact: format!("marked by {rater}, but {}", frame.signals.reason.meaning()),
        remedy: "mark another image of the same object, or see frames.parquet for the numbers behind it".to_owned(),
    }
}

fn measure_one(marked: &Marked<'_>, problems: &mut Vec<Problem>) -> Vec<ResultRow> {
    let study = marked.session.study;
    let inputs = study.spec.uncertainty.inputs();
    let mut rows = Vec::new();
    let mut told = BTreeSet::new();
    for method in &study.spec.measure.methods {
        let Some(pose) = marked.frame.signals.pose_for(*method) else { continue };
        let view = View::new(marked.session.marks_camera, pose);
        for (quantity, size) in estimate(&view, *method, &marked.object.container, marked.marks, &inputs) {
            if let Err(error) = &size
                && told.insert((quantity, error.code()))
            {
                problems.push(unmeasured(marked, quantity, error));
            }
            rows.push(row(marked, pose, *method, quantity, &size));
        }
    }
    if rows.is_empty() {
        problems.push(nothing(marked));
    }
    rows
}

fn unmeasured(marked: &Marked<'_>, quantity: Quantity, error: &MeasureError) -> Problem {
    Problem {
        severity: Severity::Loss,
        stage: Stage::Measure,
        code: error.code().to_owned(),
        place: marked.session.place_of(&marked.frame.image.file),
        fact: format!("{quantity} of '{}' marked by {}: {error}", marked.marks.object, marked.rater),
        remedy: "correct the marks in LabelMe and run again".to_owned(),
    }
}

fn nothing(marked: &Marked<'_>) -> Problem {
    let shape = marked.object.container.shape;
    Problem {
        severity: Severity::Loss,
        stage: Stage::Measure,
        code: "nothing_to_measure".to_owned(),
        place: marked.session.place_of(&marked.frame.image.file),
        fact: format!("the marks of '{}' by {} give no size of a {shape}", marked.marks.object, marked.rater),
        remedy: "mark a diameter, width, length, height or the rim (docs/study.md)".to_owned(),
    }
}

fn row(
    marked: &Marked<'_>,
    pose: Pose,
    method: Method,
    quantity: Quantity,
    size: &Result<Estimate, MeasureError>,
) -> ResultRow {
    let Marked { session, frame, rater, object, marks } = marked;
    let measured = size.as_ref().ok().map(|e| e.measured);
    let sigma = size.as_ref().ok().and_then(|e| e.sigma);
    let truth_mm = object.truth_mm.get(&quantity).copied();
    let predicted_mm = measured.map(|m| m.predicted_mm);
    let selected = frame.signals.reason == FrameReason::Selected;
    let mut flags: Vec<&str> = Vec::new();
    flags.extend((!selected).then(|| frame.signals.reason.code()));
    flags.extend(frame.signals.flags.iter().map(|flag| flag.code()));
    flags.extend((!marks.inside_picture(session.marks_camera.size_px())).then_some("mark_outside_picture"));
    flags.extend(size.as_ref().err().map(MeasureError::code));
    ResultRow {
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
        sigma_mm: sigma.map(|s| s.total_mm()),
        sigma_pitch_mm: sigma.map(|s| s.pitch_mm),
        sigma_roll_mm: sigma.map(|s| s.roll_mm),
        sigma_range_mm: sigma.map(|s| s.range_mm),
        sigma_marks_mm: sigma.map(|s| s.marks_mm),
        sigma_camera_mm: sigma.map(|s| s.camera_mm),
        plane_z_mm: measured.map(|m| m.plane_z_mm),
        truth_mm,
        error_pct: error_pct(predicted_mm, truth_mm),
        selected,
        frames: 1,
        spread_mm: None,
        flags: flags.join(","),
    }
}

/// Signed error in per cent of the truth.
pub(super) fn error_pct(predicted_mm: Option<f64>, truth_mm: Option<f64>) -> Option<f64> {
    Some(100.0 * (predicted_mm? - truth_mm?) / truth_mm?)
}

/// One row for every image of the session: those with data by time, then the dropped ones by file.
pub(super) fn ledger(session: &Session<'_>, marks: &SessionMarks, results: &[ResultRow]) -> Vec<FrameRow> {
    let mut sizes: BTreeMap<&str, u32> = BTreeMap::new();
    for file in results.iter().filter(|row| row.predicted_mm.is_some()).filter_map(|row| row.image.as_deref()) {
        *sizes.entry(file).or_default() += 1;
    }
    let with_data = session.frames.iter().map(|frame| FrameRow {
        time_utc: Some(frame.image.time),
        reason: frame.signals.reason,
        bytes: u32::try_from(frame.image.bytes).unwrap_or(u32::MAX),
        width_px: Some(frame.image.width_px),
        height_px: Some(frame.image.height_px),
        gravity_mg: frame.signals.gravity_mg,
        stillness_mg: frame.signals.stillness_mg,
        pitch_deg: frame.signals.pitch_roll_rad.map(|(pitch, _)| pitch.to_degrees()),
        roll_deg: frame.signals.pitch_roll_rad.map(|(_, roll)| roll.to_degrees()),
        range_mm: frame.signals.range_mm,
        range_spread_mm: frame.signals.range_spread_mm,
        range_samples: frame.signals.range_samples,
        range_distinct: frame.signals.range_distinct,
        flags: frame.signals.flags.iter().map(|flag| flag.code()).collect::<Vec<_>>().join(","),
        raters: count(marks.of_image(&frame.image.file).count()),
        sizes: sizes.get(frame.image.file.as_str()).copied().unwrap_or_default(),
        ..empty_row(session, &frame.image.file, frame.signals.reason)
    });
    let dropped = session.dropped.iter().map(|image| FrameRow {
        time_utc: image.time,
        bytes: u32::try_from(image.bytes).unwrap_or(u32::MAX),
        width_px: image.width_px,
        height_px: image.height_px,
        ..empty_row(session, &image.file, image.reason)
    });
    with_data.chain(dropped).collect()
}

/// One row for every image on the card of a session of which nothing could be used, by file.
pub(super) fn ledger_of_failed(study: &Study, dir: &SessionDir) -> Vec<FrameRow> {
    let (Some(card_dir), Some(images)) = (&dir.card, &study.profile.images) else { return Vec::new() };
    if !study.holds(card_dir) {
        return Vec::new();
    }
    let (Ok(card), Ok(patterns)) = (Card::list(card_dir), Patterns::new(&images.files)) else { return Vec::new() };
    let row = |file: &CardFile| FrameRow {
        bytes: u32::try_from(file.bytes).unwrap_or(u32::MAX),
        ..FrameRow::without_numbers(&study.spec.name, &dir.name, &file.name, FrameReason::SessionFailed)
    };
    card.fitting(&patterns).iter().map(row).collect()
}

fn empty_row(session: &Session<'_>, file: &str, reason: FrameReason) -> FrameRow {
    let participant = session.spec.participant.clone();
    FrameRow { participant, ..FrameRow::without_numbers(&session.study.spec.name, &session.dir.name, file, reason) }
}

fn count(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}
