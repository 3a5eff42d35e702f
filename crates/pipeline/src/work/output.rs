//! What the state says of a session.

use model::SessionStatus;

/// A stage of a session that was done.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct KeptStage {
    /// What it was made from; empty when it failed, or its input changed meanwhile: it is then done again.
    pub key: String,
    /// What the system said of its input files then; none when they may have changed unseen.
    pub fingerprint: Option<String>,
    /// When it was done.
    pub made_utc: String,
    /// How long that took.
    pub seconds: f64,
    /// SHA-256 of what came out.
    pub output_sha256: String,
}

/// What is kept of a session.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Kept {
    pub ingest: Option<KeptStage>,
    pub signals: Option<KeptStage>,
    pub measure: Option<KeptStage>,
    /// How it fared.
    pub status: Option<SessionStatus>,
}
