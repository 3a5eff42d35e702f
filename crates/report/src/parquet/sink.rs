//! The sink that pipeline fills with rows.

use std::path::{Path, PathBuf};

use model::results::{CellError, FrameRow, RESULTS_SCHEMA_VERSION, ResultRow};
use model::{ResultSink, RunLog, RunMetadata};
use polars::prelude::PolarsError;
use serde::Serialize;

use super::row_file::RowFile;
use super::run_file;
use super::{RUN_KEY, VERSION_KEY};
use crate::atomic::{self, FileError};

/// Why rows could not be stored.
#[derive(Debug, thiserror::Error)]
pub enum SinkError {
    /// Results and ledger would be the same file.
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
        /// The type that was expected, and the value that was there.
        source: CellError,
    },
    /// Parquet could not be encoded or written.
    #[error("cannot write Parquet; is the disk full? The earlier file, if any, is as it was: {}", path.display())]
    Encode {
        /// The target.
        path: PathBuf,
        /// The error of Polars.
        source: PolarsError,
    },
    /// The metadata cannot be put into JSON.
    #[error("the metadata of the run cannot be written as JSON")]
    Metadata(#[source] serde_json::Error),
    /// The files are complete already.
    #[error("the results are already finished; make a new sink for another run")]
    Finished,
}

/// A sink that writes `results.parquet`, `frames.parquet` (both with zstd) and `run.json`. Equal rows and metadata give the same
/// bytes of the Parquet files. The files are put in place only when [`finish`](ResultSink::finish) succeeds; a sink that is
/// dropped before leaves nothing behind. Memory holds at most 65,536 rows of each file, plus those of one session.
pub struct ParquetSink {
    results: PathBuf,
    frames: PathBuf,
    files: Option<(RowFile<ResultRow>, RowFile<FrameRow>)>,
}

/// The content of `run.json`: the origin of the results, and the times of the run.
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
    /// Opens temporary files beside `results` and `frames`, so that a folder that cannot be written is known before the work and
    /// not after it.
    ///
    /// # Errors
    /// The two are the same file, or a temporary file cannot be made in their folders.
    pub fn create(results: &Path, frames: &Path) -> Result<Self, SinkError> {
        if results == frames {
            return Err(SinkError::SamePath { path: results.to_owned() });
        }
        atomic::check(&run_file(results))?;
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
        // The results come last, so that the frames of new results are there as well.
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
