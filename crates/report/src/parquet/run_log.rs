//! Reads the times of a run from `run.json`.

use std::path::Path;

use model::{RunLog, RunMetadata};
use serde::Deserialize;

/// The part of `run.json` that is read.
#[derive(Deserialize)]
struct RunFile {
    #[serde(flatten)]
    metadata: RunMetadata,
    times: RunLog,
}

/// The times of the run with this `metadata`, from its `run.json`, whose path [`run_file`](super::run_file) returns. None where
/// there is no such file, or it is damaged or of another run: it only adds to a report, and no number comes from it.
#[must_use]
pub fn read_run_log(path: &Path, metadata: &RunMetadata) -> Option<RunLog> {
    let file: RunFile = serde_json::from_slice(&std::fs::read(path).ok()?).ok()?;
    (file.metadata == *metadata).then_some(file.times)
}
