//! What one session gives.

use std::collections::BTreeMap;

use model::calibrate::physical::BenchSize;
use model::{FrameRow, Problem, ResultRow, SessionStatus};
use serde::{Deserialize, Serialize};

use super::shown::Shown;
use crate::labelme::AutoRim;

/// What one session gives.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct SessionOutput {
    /// How it fared.
    pub status: SessionStatus,
    /// Sizes.
    pub results: Vec<ResultRow>,
    /// Every image.
    pub frames: Vec<FrameRow>,
    /// SHA-256 of what was read, by path relative to the study.
    pub inputs_sha256: BTreeMap<String, String>,
    /// Rims that the program found itself, by image (file on the card).
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub auto: BTreeMap<String, Vec<AutoRim>>,
    /// What they came from, where they may serve again.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub searched: Option<Searched>,
    /// What was measured where, for those who show pictures.
    #[serde(default)]
    pub shown: Shown,
    /// Known sizes, where a calibration asks for them.
    #[serde(skip)]
    pub bench: BenchSession,
}

/// A search for rims that need not be made again.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Searched {
    /// Key of what it was made from.
    pub key: String,
    /// Pictures that could not be searched.
    pub problems: Vec<Problem>,
}

/// What one session of a bench tells.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct BenchSession {
    /// Whether session.toml declares a setup: such sessions are a bench, others a study that happens to have true sizes.
    pub declared: bool,
    /// Known sizes with the readings as they are.
    pub sizes: Vec<BenchSize>,
    /// The same with the range corrected for the sensor's cone, where it can be.
    pub cone_sizes: Vec<BenchSize>,
    /// Declared and measured pitch of each image, in degrees.
    pub angles_deg: Vec<(f64, f64)>,
}
