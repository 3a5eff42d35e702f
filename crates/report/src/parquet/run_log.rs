//! The times of a run, from `run.json`.

use std::path::Path;

use model::{RunLog, RunMetadata};
use serde::Deserialize;

/// What of `run.json` is read.
#[derive(Deserialize)]
struct RunFile {
    #[serde(flatten)]
    metadata: RunMetadata,
    times: RunLog,
}

/// When and how long the run with this `metadata` was at work, from its `run.json` (its name:
/// [`run_file`](super::run_file)). None where there is no such file, or it is of another run, or damaged: it adds to a report,
/// and no number comes from it.
#[must_use]
pub fn read_run_log(path: &Path, metadata: &RunMetadata) -> Option<RunLog> {
    let file: RunFile = serde_json::from_slice(&std::fs::read(path).ok()?).ok()?;
    (file.metadata == *metadata).then_some(file.times)
}
