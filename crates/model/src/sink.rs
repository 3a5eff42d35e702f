//! Where rows go. pipeline fills a sink, cli connects it to report.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use crate::results::{FrameRow, ResultRow};
use crate::status::{SessionStatus, Stage};
use crate::table::TableSpec;

/// What the results of one run came from: kept in the metadata of the results file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunMetadata {
    /// Program and version.
    pub program: String,
    /// Commit that the program was built from, where that is known.
    #[serde(default)]
    pub commit: Option<String>,
    /// Name of the study.
    pub study: String,
    /// A sentence that every report made from this study must carry, if the study declares one.
    pub statement: Option<String>,
    /// Resolved settings, as JSON.
    pub settings: serde_json::Value,
    /// Tables to make.
    pub tables: Vec<TableSpec>,
    /// How each session fared, in the order of the sessions.
    pub sessions: Vec<SessionStatus>,
    /// SHA-256 of the input files, by path relative to the study. Those of a card stand together under `cards/SESSION`:
    /// SHA-256 over a line `sha256  path` for each, in the order of the paths.
    pub inputs_sha256: std::collections::BTreeMap<String, String>,
}

/// When and how long a run was at work: what differs from run to run, and stands beside the results, not in them.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RunLog {
    /// When it began, UTC.
    pub started_utc: String,
    /// When its results were complete, UTC.
    pub finished_utc: String,
    /// Between the two.
    pub seconds: f64,
    /// Sessions at a time.
    pub jobs: usize,
    /// Bound of the images in memory at once.
    pub image_memory_bytes: u64,
    /// What was done, by stage.
    pub stages: Vec<StageLog>,
    /// What was done, by session; those without anything to be done are left out.
    pub sessions: Vec<SessionLog>,
}

/// What was done of a stage.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StageLog {
    /// The stage.
    pub stage: Stage,
    /// Sessions for which it was done.
    pub done: usize,
    /// Sessions for which it was kept from an earlier run.
    pub kept: usize,
    /// Sum over the sessions; several are at work at a time.
    pub seconds: f64,
}

/// What was done of a session.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct SessionLog {
    /// Its name.
    pub session: String,
    /// Seconds of ingest; none when its recording was kept.
    pub ingest_s: Option<f64>,
    /// Seconds of the signals stage; none when its readings were kept.
    pub signals_s: Option<f64>,
    /// Seconds of measuring; none when its sizes were kept.
    pub measure_s: Option<f64>,
}

/// Takes the rows of a run, session by session in the order of their names, then the metadata.
pub trait ResultSink {
    /// Why a row could not be taken.
    type Error: std::error::Error + Send + Sync + 'static;

    /// Takes the rows of one session.
    ///
    /// # Errors
    /// When they cannot be stored.
    fn session(&mut self, results: Vec<ResultRow>, frames: Vec<FrameRow>) -> Result<(), Self::Error>;

    /// Takes the metadata and makes everything durable.
    ///
    /// # Errors
    /// When it cannot be stored.
    fn finish(&mut self, metadata: &RunMetadata, log: &RunLog) -> Result<(), Self::Error>;

    /// The files that [`finish`](Self::finish) makes.
    fn files(&self) -> Vec<PathBuf>;
}
