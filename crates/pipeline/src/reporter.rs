//! The progress of a run, as it is reported. Drawing it is up to the caller.

use model::{SessionStatus, Stage};

/// The amount of work of a run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Totals {
    /// The number of all sessions.
    pub sessions: usize,
    /// The number of sessions for which nothing has to be done.
    pub kept: usize,
    /// The number of bytes of cards that have to be read, where that is known.
    pub bytes: Option<u64>,
}

/// Receives the progress of a run. Its functions are called from several threads at once.
pub trait Reporter: Sync {
    /// Called when the work begins.
    fn begin(&self, totals: &Totals);

    /// Called when a session begins a stage.
    fn stage(&self, session: &str, stage: Stage);

    /// Called when it is known that `bytes` of a session's card have to be read.
    fn bytes_to_read(&self, session: &str, bytes: u64);

    /// Called when `bytes` more of the card have been read.
    fn bytes_read(&self, session: &str, bytes: u64);

    /// Called when a session is done, well or not.
    fn done(&self, status: &SessionStatus);
}

/// A reporter that reports to nobody.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Reporter for Silent {
    fn begin(&self, _totals: &Totals) {}
    fn stage(&self, _session: &str, _stage: Stage) {}
    fn bytes_to_read(&self, _session: &str, _bytes: u64) {}
    fn bytes_read(&self, _session: &str, _bytes: u64) {}
    fn done(&self, _status: &SessionStatus) {}
}
