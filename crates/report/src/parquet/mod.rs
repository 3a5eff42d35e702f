//! Writes rows to Parquet files and reads them back. The columns come from the schema in crate `model`, never from a list here.

use std::path::{Path, PathBuf};

mod columns;
mod read;
mod row_file;
mod run_log;
mod sink;
mod truth;

pub use read::{ReadError, Results, read_frames};
pub use run_log::read_run_log;
pub use sink::{ParquetSink, SinkError};
pub use truth::{read_truth, write_truth};

/// Key of the schema's version in the key-value metadata.
const VERSION_KEY: &str = "aim_batch.schema_version";
/// Key of the run's metadata, as JSON.
const RUN_KEY: &str = "aim_batch.run";

/// The path of the ledger of `results`: `frames.parquet` beside `results.parquet`, `X.frames.parquet` beside `X.parquet`.
#[must_use]
pub fn frames_file(results: &Path) -> PathBuf {
    beside(results, "frames.parquet")
}

/// The path of the record of the run: `run.json` beside `results.parquet`, `X.run.json` beside `X.parquet`.
#[must_use]
pub fn run_file(results: &Path) -> PathBuf {
    beside(results, "run.json")
}

fn beside(results: &Path, name: &str) -> PathBuf {
    match results.file_stem().map(|stem| stem.to_string_lossy()) {
        Some(stem) if stem != "results" => results.with_file_name(format!("{stem}.{name}")),
        _ => results.with_file_name(name),
    }
}
