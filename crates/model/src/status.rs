//! How a session fared.

use serde::{Deserialize, Serialize};

use crate::codes::coded_enum;

coded_enum! {
    /// Where in the road a problem arose.
    Stage {
        Study = "study": "reading study.toml and the files it names",
        Ingest = "ingest": "reading the SD card",
        Signals = "signals": "pitch, roll, stillness and range",
        Marks = "marks": "reading what people marked",
        Measure = "measure": "from marks to sizes",
    }
}

coded_enum! {
    /// What a problem cost.
    Severity {
        Loss = "loss": "data was lost or could not be used: exit code 3",
        Note = "note": "worth knowing, nothing was lost by it",
    }
}

/// One thing that went wrong, for the person who must act on it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Problem {
    /// What it cost.
    pub severity: Severity,
    /// Where in the road.
    pub stage: Stage,
    /// Stable code, snake case.
    pub code: String,
    /// The file or folder, relative to the study.
    pub place: String,
    /// What is wrong: expected and got.
    pub fact: String,
    /// What to do about it.
    pub remedy: String,
}

/// How one session fared.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SessionStatus {
    /// Name of the session.
    pub session: String,
    /// Whether nothing of the session could be used.
    pub failed: bool,
    /// Images on the card.
    pub images: usize,
    /// Images with a pose.
    pub with_pose: usize,
    /// Images used for fused sizes.
    pub selected: usize,
    /// Sizes that could be measured: of single images and fused, by all methods.
    pub sizes: usize,
    /// What went wrong, and what is worth knowing; empty when all is well.
    pub problems: Vec<Problem>,
}

impl SessionStatus {
    /// Whether something of the session was lost.
    #[must_use]
    pub fn has_losses(&self) -> bool {
        self.failed || self.problems.iter().any(|problem| problem.severity == Severity::Loss)
    }
}
