//! The stages of a session as the state keeps them.

use model::SessionStatus;

/// A stage of a session that was done.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct KeptStage {
    /// The key of everything that it was made from; empty when it failed, or when its input changed meanwhile, so that it is
    /// done again.
    pub key: String,
    /// The fingerprint of its input files at that time; none when they may have changed unseen.
    pub fingerprint: Option<String>,
    /// The time at which it was done, in UTC.
    pub made_utc: String,
    /// The time that it took.
    pub seconds: f64,
    /// SHA-256 of its output.
    pub output_sha256: String,
}

/// The stages that are kept of a session.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Kept {
    pub ingest: Option<KeptStage>,
    pub signals: Option<KeptStage>,
    pub measure: Option<KeptStage>,
    /// How the session fared.
    pub status: Option<SessionStatus>,
}
