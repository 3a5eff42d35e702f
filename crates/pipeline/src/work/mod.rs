//! The work folder keeps what can be made anew, so that it need not be.
//!
//! | | |
//! |---|---|
//! | `state.sqlite` | which stage of which session was made from what, and its output ([`state`]) |
//! | `mcap/SESSION.mcap` | the recording of a session |
//! | `annotated/SESSION.annotated.mcap` | the recording with marks and sizes for viewers, where that was asked for |
//! | `lock` | held by the run at work ([`lock`]) |

mod database;
mod error;
mod lock;
mod output;
mod state;

use std::path::{Path, PathBuf};

pub use error::WorkError;
pub use lock::Holder;
use lock::Lock;
pub(crate) use output::{Kept, KeptStage};
pub(crate) use state::{StageOutput, State, Written};

/// The work folder of a run, held by this process alone.
pub(crate) struct WorkFolder {
    pub state: State,
    pub mcap_dir: PathBuf,
    _lock: Lock,
}

impl WorkFolder {
    /// Opens the folder, makes it where there is none, and takes its lock. Files that a killed run left half-written are
    /// removed. A state file that cannot be read is set aside, and everything is made anew.
    pub fn open(dir: &Path, program: &str) -> Result<Self, WorkError> {
        let mcap_dir = dir.join("mcap");
        let whole = std::fs::create_dir_all(&mcap_dir).and_then(|()| mcap_dir.canonicalize());
        let mcap_dir = whole.map_err(|source| WorkError::Folder { path: mcap_dir, source })?;
        let lock = Lock::take(&dir.join("lock"), program)?;
        remove_partial(&mcap_dir);
        Ok(Self { state: State::open(&state_file(dir))?, mcap_dir, _lock: lock })
    }

    /// The path of the recording of a session.
    pub fn mcap(&self, session: &str) -> PathBuf {
        self.mcap_dir.join(format!("{session}.mcap"))
    }
}

impl WorkFolder {
    /// The folder of annotated recordings, made where there is none. Files that a killed run left half-written are removed.
    pub fn annotated_dir(&self) -> Result<PathBuf, WorkError> {
        let dir = self.mcap_dir.with_file_name(ANNOTATED);
        std::fs::create_dir_all(&dir).map_err(|source| WorkError::Folder { path: dir.clone(), source })?;
        remove_partial(&dir);
        Ok(dir)
    }

    /// Deletes what the folder has of other sessions than these.
    pub fn prune(&self, sessions: &[&str]) -> Result<(), WorkError> {
        for session in self.state.kept_by_session()?.into_keys().filter(|session| !sessions.contains(&session.as_str()))
        {
            let annotated = self.mcap_dir.with_file_name(ANNOTATED).join(annotated_name(&session));
            remove_file(&annotated)?;
            remove_file(&self.mcap(&session))?;
            self.state.forget(&session)?;
            tracing::info!(session, "no longer in the study: deleted from the work folder");
        }
        Ok(())
    }
}

fn remove_file(path: &Path) -> Result<(), WorkError> {
    match std::fs::remove_file(path) {
        Err(source) if source.kind() != std::io::ErrorKind::NotFound => {
            Err(WorkError::File { path: path.to_owned(), source })
        }
        _ => Ok(()),
    }
}

/// The name of the folder of annotated recordings in the work folder.
const ANNOTATED: &str = "annotated";

fn annotated_name(session: &str) -> String {
    format!("{session}.annotated.mcap")
}

/// The path of the annotated recording of a session in a work folder.
pub(crate) fn annotated_of(dir: &Path, session: &str) -> PathBuf {
    dir.join(ANNOTATED).join(annotated_name(session))
}

/// The path of the state in a work folder.
pub(crate) fn state_file(dir: &Path) -> PathBuf {
    dir.join("state.sqlite")
}

/// The path of the recording of a session in a work folder.
pub(crate) fn recording_of(dir: &Path, session: &str) -> PathBuf {
    dir.join("mcap").join(format!("{session}.mcap"))
}

/// Removes the files that ingest writes before it gives them their names. Nobody else writes them while the lock is held.
fn remove_partial(mcap_dir: &Path) {
    let entries = std::fs::read_dir(mcap_dir).into_iter().flatten().flatten();
    for entry in entries.filter(|entry| ingest::is_partial(&entry.file_name())) {
        match std::fs::remove_file(entry.path()) {
            Ok(()) => tracing::info!("removed what an interrupted run left: {}", entry.path().display()),
            Err(error) => tracing::warn!("left by an interrupted run: {}: {error}", entry.path().display()),
        }
    }
}
