//! A session's MCAP file: its images with their signals, and what is worth a note about them.

use std::path::Path;

use ingest::{SessionMetadata, SessionReader};
use model::{Problem, Severity, Stage};

use super::{Frame, lag};
use crate::signals::{self, GravityCalibration, SignalSettings};
use crate::study::{GravityCalibrate, Study};

/// What the MCAP file of a session gives.
pub(super) struct Read {
    pub metadata: SessionMetadata,
    pub frames: Vec<Frame>,
    /// Worth knowing; nothing is lost by it.
    pub notes: Vec<Problem>,
}

pub(super) fn read(study: &Study, mcap: &Path, name: &str) -> Result<Read, Problem> {
    let refuse = |error: ingest::ReadError| Problem {
        severity: Severity::Loss,
        stage: Stage::Signals,
        code: "bad_mcap".to_owned(),
        place: format!("mcap/{name}.mcap"),
        fact: error.to_string(),
        remedy: "run again with --force to ingest the card anew".to_owned(),
    };
    let mut reader = SessionReader::open(mcap).map_err(refuse)?;
    let metadata = reader.metadata().clone();
    let images = reader.images().map_err(refuse)?;
    let lag_s = study.spec.time.image_lag_s;
    let times: Vec<_> = images.iter().map(|image| image.time.plus_seconds(lag_s)).collect();
    let settings = SignalSettings {
        signals: study.spec.signals.clone(),
        select: study.spec.select.clone(),
        mount_pitch_rad: study.spec.mount.pitch_offset_deg.unwrap_or(metadata.mount_pitch_deg).to_radians(),
    };
    let found = signals::at_images(&mut reader, &times, &settings).map_err(refuse)?;
    let mut notes: Vec<Problem> =
        found.calibration.and_then(|c| calibration_note(study, name, &c)).into_iter().collect();
    // A survey has no pictures; the lag is a note, by which nothing is lost.
    if study.spec.time.estimate_lag && !metadata.is_survey() {
        let estimate = lag::estimate(&mut reader, &images).map_err(refuse)?;
        notes.push(lag::note(name, &estimate, lag_s));
    }
    let frames = images.into_iter().zip(found.frames).map(|(image, signals)| Frame { image, signals }).collect();
    Ok(Read { metadata, frames, notes })
}

/// Logs the facts; a note where the study asked for the calibration to be applied.
fn calibration_note(study: &Study, name: &str, calibration: &GravityCalibration) -> Option<Problem> {
    let verdict = calibration.verdict.code();
    tracing::info!(session = name, verdict, "gravity calibration: {calibration}");
    if study.spec.signals.gravity_calibration != GravityCalibrate::Apply {
        return None;
    }
    let (code, fact, remedy) = if calibration.accepted().is_some() {
        let remedy = "none needed; gravity_calibration = \"report\" leaves samples as they are";
        ("gravity_calibration_applied", calibration.to_string(), remedy)
    } else {
        let fact = format!("{verdict}: {calibration}; {}", calibration.verdict.expected());
        let remedy = "samples were used as recorded; before or after wearing, lay the device still for 20 s on each side \
                      and at slants between (docs/signals.md)";
        ("gravity_calibration_refused", fact, remedy)
    };
    Some(Problem {
        severity: Severity::Note,
        stage: Stage::Signals,
        code: code.to_owned(),
        place: format!("cards/{name}"),
        fact,
        remedy: remedy.to_owned(),
    })
}
