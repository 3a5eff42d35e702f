//! How a run tells what it is doing. Drawing is the caller's.

use model::{SessionStatus, Stage};

/// How much there is to do.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Totals {
    /// All sessions.
    pub sessions: usize,
    /// Those for which nothing is to be done.
    pub kept: usize,
    /// Bytes of cards to be read, where that is known.
    pub bytes: Option<u64>,
}

/// Told how far a run is. Called from several threads at once.
pub trait Reporter: Sync {
    /// The work begins.
    fn begin(&self, totals: &Totals);

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
    fn begin(&self, _totals: &Totals) {}
    fn stage(&self, _session: &str, _stage: Stage) {}
    fn bytes_to_read(&self, _session: &str, _bytes: u64) {}
    fn bytes_read(&self, _session: &str, _bytes: u64) {}
    fn done(&self, _status: &SessionStatus) {}
}
