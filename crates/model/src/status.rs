//! The status of a session, and the problems that it had.

use serde::{Deserialize, Deserializer, Serialize};

use crate::codes::coded_enum;
use crate::problem_code::ProblemCode;

coded_enum! {
    /// The stage of the work at which a problem arose.
    Stage {
        Study = "study": "reading study.toml and the files it names",
        Ingest = "ingest": "reading the SD card",
        Signals = "signals": "pitch, roll, stillness and range",
        Marks = "marks": "reading what people marked",
        Measure = "measure": "from marks to sizes",
    }
}

coded_enum! {
    /// The cost of a problem.
    Severity {
        Loss = "loss": "data was lost or could not be used: exit code 3",
        Note = "note": "worth knowing, nothing was lost by it",
    }
}

/// A problem: one thing that went wrong, for the person who must act on it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Problem {
    /// The cost of the problem.
    pub severity: Severity,
    /// The stage at which it arose.
    pub stage: Stage,
    /// The stable code, in snake case.
    #[serde(deserialize_with = "code_or_unknown")]
    pub code: ProblemCode,
    /// The file or folder that it concerns, relative to the study.
    pub place: String,
    /// The fact: what was expected, and what there is.
    pub fact: String,
    /// The remedy: what a person can do about it.
    pub remedy: String,
}

/// Reads a code; one that this version does not know is [`ProblemCode::UnknownCode`], so that results of a later version can be read.
fn code_or_unknown<'de, D: Deserializer<'de>>(deserializer: D) -> Result<ProblemCode, D::Error> {
    Ok(String::deserialize(deserializer)?.parse().unwrap_or(ProblemCode::UnknownCode))
}

/// The status of one session after a run.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SessionStatus {
    /// Name of the session.
    pub session: String,
    /// Whether nothing of the session could be used.
    pub failed: bool,
    /// Number of images on the card.
    pub images: usize,
    /// Number of images with a pose.
    pub with_pose: usize,
    /// Number of images used for fused sizes.
    pub selected: usize,
    /// Number of sizes that could be measured, of single images and fused, by all methods.
    pub sizes: usize,
    /// The problems of the session, losses and notes; empty when all is well.
    pub problems: Vec<Problem>,
    /// A sample of the files of its card, by which the same files in two sessions are seen: the least 16 of the SHA-256 of their
    /// contents, 12 hexadecimal digits of each, in order; empty without files.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub card_sketch: Vec<String>,
}

impl SessionStatus {
    /// Whether something of the session was lost.
    #[must_use]
    pub fn has_losses(&self) -> bool {
        self.failed || self.problems.iter().any(|problem| problem.severity == Severity::Loss)
    }
}
