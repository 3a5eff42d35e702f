//! The result of one session: rows, ledger, status, and what is kept for other commands.

use std::collections::BTreeMap;

use model::calibrate::physical::BenchSize;
use model::{FrameRow, Problem, ResultRow, SessionStatus};
use serde::{Deserialize, Serialize};

use super::shown::Shown;
use crate::labelme::AutoRim;

/// The result of one session: rows, ledger, status, and what is kept for other commands.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct SessionOutput {
    /// How the session fared.
    pub status: SessionStatus,
    /// Rows of results.parquet.
    pub results: Vec<ResultRow>,
    /// Rows of the ledger, one for each image.
    pub frames: Vec<FrameRow>,
    /// SHA-256 of each file that was read, by its path relative to the study.
    pub inputs_sha256: BTreeMap<String, String>,
    /// The found rims by image (file on the card).
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub auto: BTreeMap<String, Vec<AutoRim>>,
    /// The search that gave them, where its result may be used again.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub searched: Option<Searched>,
    /// The pictures in which something was measured, for commands that show them.
    #[serde(default)]
    pub shown: Shown,
    /// The known sizes, where a calibration asks for them.
    #[serde(skip)]
    pub bench: BenchSession,
}

/// A search for rims that need not be repeated.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Searched {
    /// The key of everything that the search depends on.
    pub key: String,
    /// The pictures that could not be searched.
    pub problems: Vec<Problem>,
}

/// Known sizes and angles of one session of a bench.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct BenchSession {
    /// Whether session.toml declares a setup. Sessions that do are a bench; others belong to a study that happens to have
    /// true sizes.
    pub declared: bool,
    /// The known sizes, with the range as it was read.
    pub sizes: Vec<BenchSize>,
    /// The known sizes, with the range corrected for the sensor's cone where that can be done.
    pub cone_sizes: Vec<BenchSize>,
    /// The declared and the measured pitch of each image, in degrees.
    pub angles_deg: Vec<(f64, f64)>,
}
