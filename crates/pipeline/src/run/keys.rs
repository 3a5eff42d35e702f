//! The key of each stage of a session: one hash of everything that it is made from.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use ingest::Fingerprint;
use model::{CameraSpec, Problem};
use serde::Serialize;

use crate::calibration::CalibrationFile;
use crate::inputs::{sha256_of_bytes, sha256_of_file};
use crate::labelme::{self, MarksAuthor, MarksFrame, author_of};
use crate::session::Prepared;
use crate::signals::ReadingSettings;
use crate::study::{
    AUTO, MarksSource, MarksSpec, MeasureSpec, MountSpec, Named, SelectSpec, SessionDir, SessionSpec, SignalsSpec,
    Study, StudySpec, TimeSpec, UncertaintySpec,
};
use rims::RimShape;

/// Version of what the signals stage gives. A change of meaning gives another number, and recordings are read anew.
const SIGNALS_VERSION: u32 = 2;
/// Version of what measuring gives, likewise.
const MEASURE_VERSION: u32 = 8;

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

/// Everything that a search for rims depends on, besides the files of marks and the search's own settings; what is made of the rims
/// (their pose, which of them are one container) depends on it too. It is a part of [`MeasureParts`], so a setting that belongs to a
/// search belongs to measuring as well.
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
    #[serde(skip_serializing_if = "Option::is_none")]
    marks_frame: Option<MarksFrame>,
    search: Option<SearchParts<'a>>,
}

/// The search's own settings, where there is a search.
#[derive(Serialize)]
struct SearchParts<'a> {
    version: u32,
    min_confidence: f64,
    min_diameter_mm: f64,
    camera: &'a CameraSpec,
    shapes: &'a [RimShape],
}

/// Everything that measuring a session depends on, besides the files of marks.
#[derive(Serialize)]
pub(super) struct MeasureParts<'a> {
    searched: SearchedParts<'a>,
    study: &'a str,
    session_toml: Option<&'a str>,
    measure: &'a MeasureSpec,
    objects_csv: &'a str,
    names: Option<&'a BTreeMap<String, Named>>,
    layout: &'a [Problem],
    raters: Vec<&'a str>,
    marks_source: MarksSource,
}

impl<'a> MeasureParts<'a> {
    /// Takes study.toml apart without `..`: a new key does not compile until it is given its place here.
    pub fn new(
        study: &'a Study,
        dir: &'a SessionDir,
        prepared: &'a Prepared,
        program: &'a str,
        signals_key: &'a str,
        objects_csv: &'a str,
    ) -> Self {
        let StudySpec {
            name,
            marks,
            mount: MountSpec { pitch_offset_deg },
            signals,
            select,
            measure,
            uncertainty,
            // These two decide nothing but how the file is read, and what reports say.
            schema_version: _,
            statement: _,
            // The profile, the camera and the zone are in the key of the recording; cameras, as files, also below.
            time_zone: _,
            device_profile: _,
            camera: _,
            // The clock is in the key of the signals.
            time: _,
            // Tables are made of rows.
            tables: _,
        } = &study.spec;
        // The camera of the marks is here as the file that it names.
        let MarksSpec { camera: _, frame, source, min_confidence, min_diameter_mm, shapes } = marks;
        let search = source.searches().then_some(SearchParts {
            version: rims::VERSION,
            min_confidence: *min_confidence,
            min_diameter_mm: *min_diameter_mm,
            camera: &prepared.source.camera_spec,
            shapes,
        });
        let searched = SearchedParts {
            version: MEASURE_VERSION,
            program,
            signals_key,
            session: &prepared.spec,
            signals,
            select,
            mount_pitch_deg: *pitch_offset_deg,
            uncertainty,
            calibration: study.calibration.as_ref(),
            marks_camera: &prepared.marks_camera.0,
            marks_frame: *frame,
            search,
        };
        Self {
            searched,
            study: name,
            session_toml: prepared.session_toml_sha256.as_ref().map(|(_, sha256)| sha256.as_str()),
            measure,
            objects_csv,
            names: study.names.get(&dir.name),
            layout: &dir.problems,
            raters: if source.reads_all() { dir.marks.keys().map(String::as_str).collect() } else { Vec::new() },
            marks_source: *source,
        }
    }

    /// The files of marks that are looked at.
    fn marks_files(&self, dir: &SessionDir) -> Vec<(String, PathBuf)> {
        if self.marks_source.reads_all() { dir.marks_files() } else { auto_files(dir) }
    }

    /// These settings, and what the file system says of the marks.
    pub fn fingerprint(&self, dir: &SessionDir) -> Result<Fingerprint, serde_json::Error> {
        let mut fingerprint = Fingerprint::default();
        fingerprint.add_text(&hash(self)?);
        for (name, path) in self.marks_files(dir) {
            fingerprint.add_file(&name, &path);
        }
        Ok(fingerprint)
    }

    /// The key of measuring: these settings, and the contents of the marks.
    pub fn key(&self, dir: &SessionDir) -> Result<String, serde_json::Error> {
        let mut files = self.marks_files(dir);
        if !self.marks_source.reads_all() {
            // Files that a run wrote do not count, so they do not make the next one measure again.
            files.retain(|(_, path)| {
                labelme::read_bytes(path).map_or(true, |bytes| author_of(&bytes) == MarksAuthor::Person)
            });
        }
        hash(&(self, contents(files)))
    }

    /// The key of the search for rims; none where there is no search. Of the marks it depends on the files of the rater auto alone, where
    /// all files are read: images that they hold are then not searched, and names that they hold are taken.
    pub fn search_key(&self, dir: &SessionDir) -> Result<Option<String>, serde_json::Error> {
        if self.searched.search.is_none() {
            return Ok(None);
        }
        let files = if self.marks_source.reads_all() { auto_files(dir) } else { Vec::new() };
        hash(&(&self.searched, contents(files))).map(Some)
    }
}

/// The files of marks of the rater auto.
fn auto_files(dir: &SessionDir) -> Vec<(String, PathBuf)> {
    let mut files = dir.marks_files();
    files.retain(|(name, _)| name.starts_with(&format!("{AUTO}/")));
    files
}

/// SHA-256 of each file, by its name.
fn contents(files: Vec<(String, PathBuf)>) -> BTreeMap<String, String> {
    files.into_iter().map(|(name, path)| (name, sha256_or_error(&path))).collect()
}

/// SHA-256 of a file, or what keeps it from being read.
fn sha256_or_error(path: &Path) -> String {
    sha256_of_file(path).unwrap_or_else(|error| error.kind().to_string())
}

/// SHA-256 of a value as JSON.
pub(super) fn hash<T: Serialize>(value: &T) -> Result<String, serde_json::Error> {
    Ok(sha256_of_bytes(&serde_json::to_vec(value)?))
}

#[cfg(test)]
mod tests;
