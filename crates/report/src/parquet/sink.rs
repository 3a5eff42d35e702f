//! The sink that pipeline fills.

use std::path::{Path, PathBuf};

use model::results::{CellError, FrameRow, RESULTS_SCHEMA_VERSION, ResultRow};
use model::{ResultSink, RunLog, RunMetadata};
use polars::prelude::PolarsError;
use serde::Serialize;

use super::row_file::RowFile;
use super::run_file;
use super::{RUN_KEY, VERSION_KEY};
use crate::atomic::{self, FileError};

/// Rows that could not be stored.
#[derive(Debug, thiserror::Error)]
pub enum SinkError {
    /// Both files would be the same.
    #[error("results and frames need two different files, got one for both: {}", path.display())]
    SamePath {
        /// The file.
        path: PathBuf,
    },
    /// A file could not be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A cell does not fit its column.
    #[error("a cell does not fit column '{column}' of the results schema; please report this as a bug")]
    Cell {
        /// Name of the column.
        column: &'static str,
        /// Expected and got.
        source: CellError,
    },
    /// Parquet could not be made or written.
    #[error("cannot write Parquet; is the disk full? The earlier file, if any, is as it was: {}", path.display())]
    Encode {
        /// The target.
        path: PathBuf,
        /// What Polars said.
        source: PolarsError,
    },
    /// The metadata is not JSON.
    #[error("the metadata of the run cannot be written as JSON")]
    Metadata(#[source] serde_json::Error),
    /// The files are complete already.
    #[error("the results are already finished; make a new sink for another run")]
    Finished,
}

/// Writes `results.parquet`, `frames.parquet` and `run.json`: zstd, the Parquet files byte-identical for equal rows and metadata, in place only when
/// [`finish`](ResultSink::finish) has succeeded. Dropped before, it leaves nothing behind. Memory holds at most 65,536
/// rows of each file, plus those of one session.
pub struct ParquetSink {
    results: PathBuf,
    frames: PathBuf,
    files: Option<(RowFile<ResultRow>, RowFile<FrameRow>)>,
}

/// What `run.json` holds: where the results came from, and when.
#[derive(Serialize)]
struct RunFile<'a> {
    schema_version: u32,
    #[serde(flatten)]
    metadata: &'a RunMetadata,
    times: &'a RunLog,
}

/// Version of the layout of `run.json`.
const RUN_FILE_VERSION: u32 = 1;

impl ParquetSink {
    /// Opens temporary files beside `results` and `frames`, so that a folder which cannot be written shows before the
    /// work and not after it.
    ///
    /// # Errors
    /// When the two are the same file, or a temporary file cannot be made in their folders.
    pub fn create(results: &Path, frames: &Path) -> Result<Self, SinkError> {
        if results == frames {
            return Err(SinkError::SamePath { path: results.to_owned() });
        }
        let files = Some((RowFile::create(results)?, RowFile::create(frames)?));
        Ok(Self { results: results.to_owned(), frames: frames.to_owned(), files })
    }
}

impl ResultSink for ParquetSink {
    type Error = SinkError;

    fn session(&mut self, results: Vec<ResultRow>, frames: Vec<FrameRow>) -> Result<(), SinkError> {
        let (result_file, frame_file) = self.files.as_mut().ok_or(SinkError::Finished)?;
        result_file.push(results)?;
        frame_file.push(frames)
    }

    fn finish(&mut self, metadata: &RunMetadata, log: &RunLog) -> Result<(), SinkError> {
        let (mut result_file, mut frame_file) = self.files.take().ok_or(SinkError::Finished)?;
        let run = serde_json::to_string(metadata).map_err(SinkError::Metadata)?;
        let key_values = [(VERSION_KEY, RESULTS_SCHEMA_VERSION.to_string()), (RUN_KEY, run)];
        frame_file.seal(&key_values)?;
        result_file.seal(&key_values)?;
        // Results last: whoever sees new results also finds their frames.
        frame_file.put_in_place()?;
        result_file.put_in_place()?;
        let run = RunFile { schema_version: RUN_FILE_VERSION, metadata, times: log };
        let text = serde_json::to_vec_pretty(&run).map_err(SinkError::Metadata)?;
        Ok(atomic::write(&run_file(&self.results), &text)?)
    }

    fn files(&self) -> Vec<PathBuf> {
        vec![self.results.clone(), self.frames.clone(), run_file(&self.results)]
    }
}
