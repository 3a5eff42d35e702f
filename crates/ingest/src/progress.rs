//! How ingest tells what it is doing. Drawing is the caller's.

/// Told how far the ingest of one session is. Called from the thread that ingests.
pub trait IngestProgress: Sync {
    /// Before a pass over the card: `bytes` are in the files of this session. Hashing and ingest are a pass each.
    fn begin(&self, bytes: u64);

    /// `bytes` more have been read. The sum passes `begin`'s figure when one file holds two streams and is read twice.
    fn advance(&self, bytes: u64);
}

/// Tells nobody.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoProgress;

impl IngestProgress for NoProgress {
    fn begin(&self, _bytes: u64) {}

    fn advance(&self, _bytes: u64) {}
}
