//! Where rows go. pipeline fills a sink, cli connects it to report.

use serde::{Deserialize, Serialize};

use crate::results::{FrameRow, ResultRow};
use crate::status::SessionStatus;
use crate::table::TableSpec;

/// What the results of one run came from: kept in the metadata of the results file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunMetadata {
    /// Program and version.
    pub program: String,
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
    /// SHA-256 of every input file, by path relative to the study.
    pub inputs_sha256: std::collections::BTreeMap<String, String>,
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
    fn finish(&mut self, metadata: &RunMetadata) -> Result<(), Self::Error>;
}
