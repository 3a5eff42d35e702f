//! Sinks for the rows of a run: pipeline fills a sink, and cli connects it to report.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use crate::results::{FrameRow, ResultRow};
use crate::status::{SessionStatus, Stage};
use crate::table::TableSpec;

/// The origin of the results of one run, which is kept in the metadata of the results file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunMetadata {
    /// Name and version of the program.
    pub program: String,
    /// The commit that the program was built from, where that is known.
    #[serde(default)]
    pub commit: Option<String>,
    /// Name of the study.
    pub study: String,
    /// A sentence that every report made from this study must carry, if the study declares one.
    pub statement: Option<String>,
    /// The resolved settings, as JSON.
    pub settings: serde_json::Value,
    /// The error tables that the study asks for.
    pub tables: Vec<TableSpec>,
    /// The status of each session, in the order of the sessions.
    pub sessions: Vec<SessionStatus>,
    /// SHA-256 of the input files, by path relative to the study. The files of a card stand together under `cards/SESSION`,
    /// with the SHA-256 over a line `sha256  path` for each file, in the order of the paths.
    pub inputs_sha256: std::collections::BTreeMap<String, String>,
}

/// When a run was at work, and for how long. This differs from run to run, so it stands beside the results and not in them.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RunLog {
    /// When the run began, UTC.
    pub started_utc: String,
    /// When its results were complete, UTC.
    pub finished_utc: String,
    /// Seconds between the two.
    pub seconds: f64,
    /// Number of sessions that may be worked on at a time.
    pub jobs: usize,
    /// Bound of the memory that images take at any time.
    pub image_memory_bytes: u64,
    /// The work of the run by stage.
    pub stages: Vec<StageLog>,
    /// The work of the run by session; sessions without work are left out.
    pub sessions: Vec<SessionLog>,
}

/// The work of a run on one stage.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StageLog {
    /// The stage.
    pub stage: Stage,
    /// Number of sessions for which the stage was done.
    pub done: usize,
    /// Number of sessions for which it was kept from an earlier run.
    pub kept: usize,
    /// Number of sessions that failed at this stage or before it.
    pub failed: usize,
    /// Seconds, summed over the sessions, of which several may be worked on at a time.
    pub seconds: f64,
}

/// The work of a run on one session.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct SessionLog {
    /// Name of the session.
    pub session: String,
    /// Seconds of ingest; `None` when the recording was kept.
    pub ingest_s: Option<f64>,
    /// Seconds of the signals stage; `None` when the readings were kept.
    pub signals_s: Option<f64>,
    /// Seconds of measuring; `None` when the sizes were kept.
    pub measure_s: Option<f64>,
}

/// A sink for the results of a run: it takes the rows, session by session in the order of their names, and then the metadata.
pub trait ResultSink {
    /// The reason why rows or metadata could not be taken.
    type Error: std::error::Error + Send + Sync + 'static;

    /// Takes the rows of one session.
    ///
    /// # Errors
    /// When the rows cannot be stored.
    fn session(&mut self, results: Vec<ResultRow>, frames: Vec<FrameRow>) -> Result<(), Self::Error>;

    /// Takes the metadata and makes everything durable.
    ///
    /// # Errors
    /// When the metadata cannot be stored.
    fn finish(&mut self, metadata: &RunMetadata, log: &RunLog) -> Result<(), Self::Error>;

    /// The files that [`finish`](Self::finish) writes.
    fn files(&self) -> Vec<PathBuf>;
}
