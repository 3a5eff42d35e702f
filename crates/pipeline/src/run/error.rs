//! The errors of a run.

use std::path::PathBuf;

use ingest::IngestError;
use model::Problem;

use crate::work::WorkError;

/// The error of a run that did not finish.
#[derive(Debug, thiserror::Error)]
pub enum RunError<E: std::error::Error + 'static> {
    /// It stopped before its results could be stored.
    #[error(transparent)]
    Halted(#[from] Halted),
    /// The results could not be stored.
    #[error("cannot store the results: {0}")]
    Sink(#[source] E),
}

/// The reason why a run stopped before its results. What concerns one session never stops a run, unless that was asked for.
#[derive(Debug, thiserror::Error)]
pub enum Halted {
    /// The work folder cannot be used.
    #[error(transparent)]
    Work(#[from] WorkError),
    /// A recording cannot be written, or no thread can be had, so that no session could go on.
    #[error("{error}; {}. What was done is kept; run again to go on", error.remedy())]
    Ingest {
        /// The error of the first session that met it.
        #[source]
        error: Box<IngestError>,
    },
    /// The worker threads cannot be started.
    #[error("cannot start the worker threads: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// An input file of the study can no longer be read.
    #[error("cannot read an input file: {source}: {}", path.display())]
    Input {
        /// The file.
        path: PathBuf,
        /// The error of the system.
        source: std::io::Error,
    },
    /// The settings cannot be written as JSON.
    #[error("cannot record the settings: {0}")]
    Settings(#[from] serde_json::Error),
    /// A signal came.
    #[error("stopped by {}: {done} of {sessions} sessions are done and kept; run again to go on", signal_name(*signal))]
    Stopped {
        /// The number of the signal.
        signal: usize,
        /// The number of sessions that are done, in this run or before.
        done: usize,
        /// The number of all sessions.
        sessions: usize,
    },
    /// A session failed, and the run was to stop then.
    #[error(
        "session '{session}' failed, and --fail-fast was asked for [{}] {}: {}: {}; {}",
        problem.stage, problem.code, problem.place, problem.fact, problem.remedy
    )]
    FailFast {
        /// The name of the session.
        session: String,
        /// The problem of the session.
        problem: Box<Problem>,
    },
    /// The kept output of a session is damaged, and was damaged again after it was made anew.
    #[error(
        "the work folder does not keep what is written there (session '{0}'); check the disk, run with --force, or give --work another folder"
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
