//! How a run tells what it is doing. Drawing is the caller's.

use model::{SessionStatus, Stage};

/// Told how far a run is. Called from several threads at once.
pub trait Reporter: Sync {
    /// The run begins: `sessions` are to be done.
    fn begin(&self, sessions: usize);

    /// A session begins a stage.
    fn stage(&self, session: &str, stage: Stage);

    /// A session's card has `bytes` to be read.
    fn bytes_to_read(&self, session: &str, bytes: u64);

    /// `bytes` more of it have been read.
    fn bytes_read(&self, session: &str, bytes: u64);

    /// A session is done, well or not.
    fn done(&self, status: &SessionStatus);
}

/// Tells nobody.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Reporter for Silent {
    fn begin(&self, _sessions: usize) {}
    fn stage(&self, _session: &str, _stage: Stage) {}
    fn bytes_to_read(&self, _session: &str, _bytes: u64) {}
    fn bytes_read(&self, _session: &str, _bytes: u64) {}
    fn done(&self, _status: &SessionStatus) {}
}
