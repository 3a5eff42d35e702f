//! Why a run stopped.

use std::path::PathBuf;

use ingest::IngestError;
use model::Problem;

use crate::work::WorkError;

/// Why a run did not finish.
#[derive(Debug, thiserror::Error)]
pub enum RunError<E: std::error::Error + 'static> {
    /// Before its results could be stored.
    #[error(transparent)]
    Halted(#[from] Halted),
    /// The results could not be stored.
    #[error("cannot store the results: {0}")]
    Sink(#[source] E),
}

/// Why a run stopped before its results. What concerns one session never stops a run, unless that was asked for.
#[derive(Debug, thiserror::Error)]
pub enum Halted {
    /// The work folder.
    #[error(transparent)]
    Work(#[from] WorkError),
    /// A recording cannot be written there, or no thread can be had: no session could go on.
    #[error("{error}; {}. What was done is kept; run again to go on", error.remedy())]
    Ingest {
        /// What happened to the first session that met it.
        #[source]
        error: Box<IngestError>,
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
    /// A signal came.
    #[error("stopped by {}: {done} of {sessions} sessions are done and kept; run again to go on", signal_name(*signal))]
    Stopped {
        /// Its number.
        signal: usize,
        /// Sessions that are done, in this run or before.
        done: usize,
        /// All sessions.
        sessions: usize,
    },
    /// A session failed, and the run was to stop then.
    #[error(
        "session '{session}' failed, and --fail-fast was asked for [{}] {}: {}: {}; {}",
        problem.stage, problem.code, problem.place, problem.fact, problem.remedy
    )]
    FailFast {
        /// The session.
        session: String,
        /// What is wrong.
        problem: Box<Problem>,
    },
    /// What was kept of a session is damaged, and was damaged again after it was made anew.
    #[error(
        "the work folder does not keep what is written there (session '{0}'); check the disk, or give --work another folder"
    )]
    NotKept(String),
}

fn signal_name(signal: usize) -> String {
    match signal {
        2 => "SIGINT".to_owned(),
        15 => "SIGTERM".to_owned(),
        other => format!("signal {other}"),
    }
}
