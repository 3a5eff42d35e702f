//! Step *signals* of one session: reads its MCAP file.
//!
//! - Input: the MCAP file of the session, and `[signals]` and `[time]` of study.toml.
//! - Output: a [`Recording`], which holds the images, the sensor readings around each of them, and problems and notes.

use std::collections::BTreeMap;
use std::path::Path;

use ingest::{DroppedImage, ImageEntry, SessionReader};
use model::{Problem, ProblemCode, Severity, Stage};
use serde::{Deserialize, Serialize};

use super::lag;
use crate::signals::{self, GravityCalibrate, GravityCalibration, Reading};
use crate::study::Study;

/// The result of stage signals: everything that measuring needs to know of a recording, apart from the pictures.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Recording {
    /// The images, in the order of time.
    pub images: Vec<ImageEntry>,
    /// The sensor readings around each image.
    pub readings: Vec<Reading>,
    /// The images of the card that could not be used.
    pub dropped: Vec<DroppedImage>,
    /// Problems of the card, and notes.
    pub problems: Vec<Problem>,
    /// SHA-256 of the card's files, by name.
    pub inputs_sha256: BTreeMap<String, String>,
    /// Camera pitch minus sensor pitch, as the device profile declares it.
    pub mount_pitch_deg: f64,
}

impl Recording {
    /// Whether every file of the card could be read to its end.
    pub fn is_whole(&self) -> bool {
        !self.inputs_sha256.values().any(|hash| hash == ingest::UNREADABLE)
    }
}

pub(crate) fn read(study: &Study, mcap: &Path, name: &str) -> Result<Recording, Problem> {
    let refuse = |error| bad_mcap(name, &error);
    let mut reader = SessionReader::open(mcap).map_err(refuse)?;
    let metadata = reader.metadata().clone();
    let images = reader.images().map_err(refuse)?;
    let lag_s = study.spec.time.image_lag_s;
    let times: Vec<_> = images.iter().map(|image| image.time.plus_seconds(lag_s)).collect();
    let settings = study.spec.signals.reading_settings();
    let sensed = signals::at_images(&mut reader, &times, &settings).map_err(refuse)?;
    let mut problems = metadata.problems.clone();
    problems.extend(sensed.calibration.and_then(|calibration| calibration_note(study, name, &calibration)));
    // A survey has no pictures; the lag is only a note, so nothing is lost without it.
    if study.spec.time.estimate_lag && !metadata.is_survey() {
        let estimate = lag::estimate(&mut reader, &images).map_err(refuse)?;
        problems.push(lag::note(name, &estimate, lag_s));
    }
    Ok(Recording {
        images,
        readings: sensed.readings,
        dropped: metadata.dropped_images,
        problems,
        inputs_sha256: metadata.inputs_sha256,
        mount_pitch_deg: metadata.mount_pitch_deg,
    })
}

pub(super) fn bad_mcap(session: &str, error: &ingest::ReadError) -> Problem {
    Problem {
        severity: Severity::Loss,
        stage: Stage::Signals,
        code: ProblemCode::BadMcap,
        place: format!("mcap/{session}.mcap"),
        fact: error.to_string(),
        remedy: "run again with --force to ingest the card anew".to_owned(),
    }
}

/// Logs the gravity calibration, and returns a note where the study asks for it to be applied.
fn calibration_note(study: &Study, name: &str, calibration: &GravityCalibration) -> Option<Problem> {
    let verdict = calibration.verdict.code();
    tracing::info!(session = name, verdict, "gravity calibration: {calibration}");
    if study.spec.signals.gravity_calibration != GravityCalibrate::Apply {
        return None;
    }
    let (code, fact, remedy) = if calibration.accepted().is_some() {
        let remedy = "none needed; gravity_calibration = \"report\" leaves samples as they are";
        (ProblemCode::GravityCalibrationApplied, calibration.to_string(), remedy)
    } else {
        let fact = format!("{verdict}: {calibration}; {}", calibration.verdict.expected());
        let remedy = "samples were used as recorded; before or after wearing, lay the device still for 20 s on each side \
                      and at slants between (docs/signals.md)";
        (ProblemCode::GravityCalibrationRefused, fact, remedy)
    };
    Some(Problem {
        severity: Severity::Note,
        stage: Stage::Signals,
        code,
        place: format!("cards/{name}"),
        fact,
        remedy: remedy.to_owned(),
    })
}
