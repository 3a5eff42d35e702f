//! What each stage of a session is made from, as one hash.

use std::collections::BTreeMap;
use std::path::Path;

use ingest::Fingerprint;
use model::CameraSpec;
use serde::Serialize;

use crate::calibrate::CalibrationFile;
use crate::inputs::{sha256_of_bytes, sha256_of_file};
use crate::session::Prepared;
use crate::signals::ReadingSettings;
use crate::study::{MeasureSpec, SelectSpec, SessionDir, SessionSpec, SignalsSpec, Study, TimeSpec, UncertaintySpec};

/// Version of what the signals stage gives. A change of meaning gives another number, and recordings are read anew.
const SIGNALS_VERSION: u32 = 1;
/// Version of what measuring gives, likewise.
const MEASURE_VERSION: u32 = 2;

#[derive(Serialize)]
struct SignalsParts<'a> {
    version: u32,
    program: &'a str,
    ingest: &'a str,
    settings: ReadingSettings,
    time: &'a TimeSpec,
}

/// Key of the signals stage, of a recording with that key of ingest.
pub(super) fn signals_key(study: &Study, program: &str, ingest_key: &str) -> Result<String, serde_json::Error> {
    hash(&SignalsParts {
        version: SIGNALS_VERSION,
        program,
        ingest: ingest_key,
        settings: ReadingSettings::from(&study.spec.signals),
        time: &study.spec.time,
    })
}

/// All that measuring a session depends on, but the marks.
#[derive(Serialize)]
pub(super) struct MeasureParts<'a> {
    version: u32,
    program: &'a str,
    signals_key: &'a str,
    study: &'a str,
    session: &'a SessionSpec,
    session_toml: Option<&'a str>,
    signals: &'a SignalsSpec,
    select: &'a SelectSpec,
    mount_pitch_deg: Option<f64>,
    measure: &'a MeasureSpec,
    uncertainty: &'a UncertaintySpec,
    calibration: Option<&'a CalibrationFile>,
    marks_camera: &'a CameraSpec,
    objects_csv: &'a str,
    raters: Vec<&'a str>,
}

impl<'a> MeasureParts<'a> {
    pub fn new(
        study: &'a Study,
        dir: &'a SessionDir,
        prepared: &'a Prepared,
        program: &'a str,
        signals_key: &'a str,
        objects_csv: &'a str,
    ) -> Self {
        let spec = &study.spec;
        Self {
            version: MEASURE_VERSION,
            program,
            signals_key,
            study: &spec.name,
            session: &prepared.spec,
            session_toml: prepared.session_toml_sha256.as_ref().map(|(_, sha256)| sha256.as_str()),
            signals: &spec.signals,
            select: &spec.select,
            mount_pitch_deg: spec.mount.pitch_offset_deg,
            measure: &spec.measure,
            uncertainty: &spec.uncertainty,
            calibration: study.calibration.as_ref(),
            marks_camera: &prepared.marks_camera.0,
            objects_csv,
            raters: dir.marks.keys().map(String::as_str).collect(),
        }
    }

    /// What the system says of the marks, under these settings.
    pub fn fingerprint(&self, dir: &SessionDir) -> Result<Fingerprint, serde_json::Error> {
        let mut fingerprint = Fingerprint::default();
        fingerprint.add_text(&hash(self)?);
        for (name, path) in dir.marks_files() {
            fingerprint.add_file(&name, &path);
        }
        Ok(fingerprint)
    }

    /// The key: these settings, and the contents of the marks.
    pub fn key(&self, dir: &SessionDir) -> Result<String, serde_json::Error> {
        let of_file = |path: &Path| sha256_of_file(path).unwrap_or_else(|error| error.kind().to_string());
        let marks: BTreeMap<String, String> =
            dir.marks_files().into_iter().map(|(name, path)| (name, of_file(&path))).collect();
        hash(&(self, marks))
    }
}

/// SHA-256 of a value as JSON.
pub(super) fn hash<T: Serialize>(value: &T) -> Result<String, serde_json::Error> {
    Ok(sha256_of_bytes(&serde_json::to_vec(value)?))
}
