//! What each stage of a session is made from, as one hash.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use ingest::Fingerprint;
use model::CameraSpec;
use serde::Serialize;

use crate::calibration::CalibrationFile;
use crate::inputs::{sha256_of_bytes, sha256_of_file};
use crate::rims::{self, RimShape};
use crate::session::Prepared;
use crate::signals::ReadingSettings;
use crate::study::{
    AUTO, MarksSource, MeasureSpec, Named, SelectSpec, SessionDir, SessionSpec, SignalsSpec, Study, TimeSpec,
    UncertaintySpec,
};

/// Version of what the signals stage gives. A change of meaning gives another number, and recordings are read anew.
const SIGNALS_VERSION: u32 = 1;
/// Version of what measuring gives, likewise.
const MEASURE_VERSION: u32 = 5;

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
        settings: study.spec.signals.reading_settings(),
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
    names: Option<&'a BTreeMap<String, Named>>,
    raters: Vec<&'a str>,
    marks_source: MarksSource,
    search: Option<SearchParts<'a>>,
}

/// What the search for rims depends on, where there is one.
#[derive(Serialize)]
struct SearchParts<'a> {
    version: u32,
    min_confidence: f64,
    min_diameter_mm: f64,
    camera: &'a CameraSpec,
    #[serde(skip_serializing_if = "is_default")]
    shapes: &'a [RimShape],
}

/// Searches for round rims keep the keys that they had before there were others.
fn is_default(shapes: &[RimShape]) -> bool {
    shapes == [RimShape::Circle]
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
        let (spec, source) = (&study.spec, study.spec.marks.source);
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
            names: study.names.get(&dir.name),
            raters: if source.reads() { dir.marks.keys().map(String::as_str).collect() } else { Vec::new() },
            marks_source: source,
            search: source.searches().then_some(SearchParts {
                version: rims::VERSION,
                min_confidence: spec.marks.min_confidence,
                min_diameter_mm: spec.marks.min_diameter_mm,
                camera: &prepared.source.camera_spec,
                shapes: &spec.marks.shapes,
            }),
        }
    }

    /// The files of marks that are read.
    fn marks_files(&self, dir: &SessionDir) -> Vec<(String, PathBuf)> {
        if self.marks_source.reads() { dir.marks_files() } else { Vec::new() }
    }

    /// What the system says of the marks, under these settings.
    pub fn fingerprint(&self, dir: &SessionDir) -> Result<Fingerprint, serde_json::Error> {
        let mut fingerprint = Fingerprint::default();
        fingerprint.add_text(&hash(self)?);
        for (name, path) in self.marks_files(dir) {
            fingerprint.add_file(&name, &path);
        }
        Ok(fingerprint)
    }

    /// The key: these settings, and the contents of the marks.
    pub fn key(&self, dir: &SessionDir) -> Result<String, serde_json::Error> {
        let marks: BTreeMap<String, String> =
            self.marks_files(dir).into_iter().map(|(name, path)| (name, sha256_or_error(&path))).collect();
        hash(&(self, marks))
    }
}

/// All that a search for rims depends on, and what is made of them: not what they are called, nor how they are measured.
#[derive(Serialize)]
struct SearchedParts<'a> {
    version: u32,
    program: &'a str,
    signals_key: &'a str,
    session: &'a SessionSpec,
    signals: &'a SignalsSpec,
    select: &'a SelectSpec,
    mount_pitch_deg: Option<f64>,
    uncertainty: &'a UncertaintySpec,
    calibration: Option<&'a CalibrationFile>,
    marks_camera: &'a CameraSpec,
    search: SearchParts<'a>,
    /// Images that are not searched, and names that are taken: the files of rater auto.
    checked: BTreeMap<String, String>,
}

/// Key of a search for rims; none where there is no search.
pub(super) fn search_key(parts: MeasureParts<'_>, dir: &SessionDir) -> Result<Option<String>, serde_json::Error> {
    let files = parts.marks_files(dir);
    let Some(search) = parts.search else { return Ok(None) };
    let checked = files.into_iter().filter(|(name, _)| name.starts_with(&format!("{AUTO}/")));
    let parts = SearchedParts {
        version: parts.version,
        program: parts.program,
        signals_key: parts.signals_key,
        session: parts.session,
        signals: parts.signals,
        select: parts.select,
        mount_pitch_deg: parts.mount_pitch_deg,
        uncertainty: parts.uncertainty,
        calibration: parts.calibration,
        marks_camera: parts.marks_camera,
        search,
        checked: checked.map(|(name, path)| (name, sha256_or_error(&path))).collect(),
    };
    hash(&parts).map(Some)
}

/// SHA-256 of a file, or what keeps it from being read.
fn sha256_or_error(path: &Path) -> String {
    sha256_of_file(path).unwrap_or_else(|error| error.kind().to_string())
}

/// SHA-256 of a value as JSON.
pub(super) fn hash<T: Serialize>(value: &T) -> Result<String, serde_json::Error> {
    Ok(sha256_of_bytes(&serde_json::to_vec(value)?))
}
