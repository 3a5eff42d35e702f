//! All sessions of a study, in parallel, into a sink.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use model::{ResultSink, RunMetadata, SessionStatus};

use crate::inputs::sha256_of_file;
use crate::reporter::Reporter;
use crate::session::SessionOptions;
use crate::sessions::{guarded, in_parallel};
use crate::study::Study;

/// Settings of a run that are not the study's.
#[derive(Debug, Clone)]
pub struct RunOptions {
    /// Worker threads; none for one per core that this process may use.
    pub jobs: Option<NonZeroUsize>,
    /// Folder for what may be made anew: MCAP files.
    pub work_dir: PathBuf,
    /// Whether to ingest cards again that have not changed.
    pub force: bool,
    /// Program and version, for provenance.
    pub program: String,
}

/// Why a run stopped. What concerns one session never stops a run.
#[derive(Debug, thiserror::Error)]
pub enum RunError<E: std::error::Error + 'static> {
    /// The work folder.
    #[error("cannot make the work folder: {source}: {}", path.display())]
    WorkDir {
        /// The folder.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The worker threads.
    #[error("cannot start the worker threads: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// An input file of the study that was there a moment ago.
    #[error("cannot read an input file: {source}: {}", path.display())]
    Input {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The settings do not go into JSON.
    #[error("cannot record the settings: {0}")]
    Settings(#[from] serde_json::Error),
    /// The results could not be stored.
    #[error("cannot store the results: {0}")]
    Sink(#[source] E),
}

/// Runs every session of a study, `jobs` at a time, and hands the rows to `sink` in the order of the sessions' names.
///
/// # Errors
/// [`RunError`] for what concerns the run as a whole. A session that fails is in the statuses returned.
pub fn run<S: ResultSink>(
    study: &Study,
    options: &RunOptions,
    reporter: &dyn Reporter,
    sink: &mut S,
) -> Result<Vec<SessionStatus>, RunError<S::Error>> {
    let mcap_dir = options.work_dir.join("mcap");
    let whole = std::fs::create_dir_all(&mcap_dir).and_then(|()| mcap_dir.canonicalize());
    let mcap_dir = whole.map_err(|source| RunError::WorkDir { path: mcap_dir, source })?;
    let session_options =
        SessionOptions { mcap_dir, force: options.force, survey: false, program: options.program.clone() };
    let mut inputs_sha256 = study_inputs(study)?;
    let outputs = in_parallel(study, options.jobs, reporter, |dir| {
        let output = guarded(study, dir, &session_options, reporter);
        reporter.done(&output.status);
        output
    })?;
    let mut sessions = Vec::new();
    for output in outputs {
        sink.session(output.results, output.frames).map_err(RunError::Sink)?;
        inputs_sha256.extend(output.inputs_sha256);
        sessions.push(output.status);
    }
    let metadata = RunMetadata {
        program: options.program.clone(),
        study: study.spec.name.clone(),
        statement: study.spec.statement.clone(),
        settings: settings(study)?,
        tables: study.tables.clone(),
        sessions: sessions.clone(),
        inputs_sha256,
    };
    sink.finish(&metadata).map_err(RunError::Sink)?;
    Ok(sessions)
}

fn settings(study: &Study) -> Result<serde_json::Value, serde_json::Error> {
    Ok(serde_json::json!({
        "study": study.spec,
        "camera": study.camera_spec,
        "marks_camera": study.marks_camera.as_ref().map(|(spec, _)| spec),
        "device_profile": study.profile,
        "calibration": study.calibration,
    }))
}

/// Hashes of the files that concern the whole study.
fn study_inputs<E: std::error::Error>(study: &Study) -> Result<BTreeMap<String, String>, RunError<E>> {
    let mut files = vec!["study.toml".to_owned(), "objects.csv".to_owned()];
    for printed in study.spec.tables.iter().filter_map(|table| table.printed.as_ref()) {
        files.push(printed.rows.clone());
        files.extend(printed.summaries.clone());
    }
    files.extend(device_files(&study.dir.join("devices")).into_iter().map(|name| format!("devices/{name}")));
    let hash = |file: String| {
        let path = study.dir.join(&file);
        sha256_of_file(&path).map(|sha| (file, sha)).map_err(|source| RunError::Input { path, source })
    };
    files.into_iter().map(hash).collect()
}

/// Names of the study's own profiles and cameras.
fn device_files(devices: &Path) -> Vec<String> {
    let names =
        std::fs::read_dir(devices).into_iter().flatten().filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    names.filter(|name| name.ends_with(".toml")).collect()
}
