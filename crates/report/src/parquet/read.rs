//! Reads results and ledgers back.

use std::io::{self, Cursor};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use model::results::{CellError, Column, ColumnType, FlowRow, FrameRow, RESULTS_SCHEMA_VERSION, ResultRow, Row};
use model::{RunMetadata, StudyFlow};
use polars::prelude::{
    DataFrame, DataType, ParallelStrategy, ParquetReader, PolarsError, PolarsResult, SerReader as _, TimeUnit,
};

use super::columns::{Cells, data_type};
use super::{RUN_KEY, VERSION_KEY};

/// Why results could not be read.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file cannot be opened or read.
    #[error("cannot read the file; check its name and your rights: {}", path.display())]
    Open {
        /// The file.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
    /// The file is not Parquet.
    #[error("not a Parquet file, or one cut short; make it again with 'aim-batch run': {}", path.display())]
    NotParquet {
        /// The file.
        path: PathBuf,
        /// The error of Polars.
        source: PolarsError,
    },
    /// The file contradicts itself.
    #[error("the file is damaged: the Parquet reader gave up on it; copy it again, or run the study again: {}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
    },
    /// The file lacks this program's metadata.
    #[error(
        "a Parquet file, but not made by aim-batch: its metadata has no '{key}' (some tools drop it when they write \
         a file again); take the file that 'aim-batch run' wrote: {}", path.display()
    )]
    NotOurs {
        /// The file.
        path: PathBuf,
        /// The key that is missing.
        key: &'static str,
    },
    /// The file has another schema.
    #[error(
        "expected schema version {expected}, got {got}; read it with the aim-batch that wrote it, or run the study \
         again: {}", path.display()
    )]
    OtherVersion {
        /// The file.
        path: PathBuf,
        /// The version that this program reads.
        expected: u32,
        /// The version of the file.
        got: String,
    },
    /// The run's metadata cannot be understood.
    #[error("'{RUN_KEY}' in the file's metadata is damaged; run the study again: {}", path.display())]
    Metadata {
        /// The file.
        path: PathBuf,
        /// The error of the JSON reader.
        source: serde_json::Error,
    },
    /// Results and ledger are not of one run.
    #[error("another run wrote this file than the results beside it; run the study again for both: {}", path.display())]
    OtherRun {
        /// The ledger.
        path: PathBuf,
    },
    /// A column is missing.
    #[error(
        "no column '{column}'; was results.parquet meant, or frames.parquet? Columns must keep their names: {}",
        path.display()
    )]
    MissingColumn {
        /// The file.
        path: PathBuf,
        /// Name of the column.
        column: &'static str,
    },
    /// A column has another type.
    #[error("expected {expected:?} in column '{column}', got {got}; take the file as aim-batch wrote it: {}", path.display())]
    ColumnType {
        /// The file.
        path: PathBuf,
        /// Name of the column.
        column: &'static str,
        /// Type of the schema.
        expected: ColumnType,
        /// Type in the file.
        got: String,
    },
    /// A cell does not fit.
    #[error("row {row}, column '{column}' does not fit the schema; take the file as aim-batch wrote it: {}", path.display())]
    Cell {
        /// The file.
        path: PathBuf,
        /// Number of the row, counted from 1.
        row: usize,
        /// Name of the column.
        column: &'static str,
        /// The type that was expected, and the value that was there.
        source: CellError,
    },
}

/// The results of a run: the content of `results.parquet`, and the numbers of images in `frames.parquet`.
#[derive(Debug, Clone, PartialEq)]
pub struct Results {
    /// The rows, in the order of the file.
    pub rows: Vec<ResultRow>,
    /// The metadata of their run.
    pub metadata: RunMetadata,
    /// The flow of images; none before [`Results::read_flow`].
    pub flow: Option<StudyFlow>,
}

impl Results {
    /// Reads `results.parquet`.
    ///
    /// # Errors
    /// [`ReadError`]: no such file, not Parquet, not made by aim-batch, another schema version, a missing column, or a
    /// column or cell of another type.
    pub fn read(path: &Path) -> Result<Self, ReadError> {
        let (rows, metadata) = read_rows(path)?;
        Ok(Self { rows, metadata, flow: None })
    }

    /// Counts the images in `frames.parquet`, whose path [`frames_file`](super::frames_file) returns, into `flow`.
    ///
    /// # Errors
    /// The same as of [`Results::read`], and where another run wrote the file.
    pub fn read_flow(&mut self, frames: &Path) -> Result<(), ReadError> {
        let (rows, metadata): (Vec<FlowRow>, _) = read_rows(frames)?;
        if metadata != self.metadata {
            return Err(ReadError::OtherRun { path: frames.to_owned() });
        }
        let mut flow = StudyFlow::default();
        rows.iter().for_each(|row| flow.add(row));
        self.flow = Some(flow);
        Ok(())
    }
}

/// The rows of `frames.parquet`, one per image.
///
/// # Errors
/// As [`Results::read`].
pub fn read_frames(path: &Path) -> Result<Vec<FrameRow>, ReadError> {
    Ok(read_rows(path)?.0)
}

fn read_rows<R: Row>(path: &Path) -> Result<(Vec<R>, RunMetadata), ReadError> {
    read_rows_and(path, RESULTS_SCHEMA_VERSION, RUN_KEY, |run| {
        serde_json::from_str(&run).map_err(|source| ReadError::Metadata { path: path.to_owned(), source })
    })
}

/// The rows of a file, and its metadata under `key` as `parse` understands it. The file must have this `version` of the schema.
/// Version and metadata are checked before any row is read.
pub(super) fn read_rows_and<R: Row, M>(
    path: &Path,
    version: u32,
    key: &'static str,
    parse: impl FnOnce(String) -> Result<M, ReadError>,
) -> Result<(Vec<R>, M), ReadError> {
    // The file is read, not mapped: a mapped file that another job shortens would end this one.
    let bytes = std::fs::read(path).map_err(|source| ReadError::Open { path: path.to_owned(), source })?;
    let not_parquet = |source| ReadError::NotParquet { path: path.to_owned(), source };
    // There is one thread, so that a panic on damaged bytes arises here, where it is caught.
    let mut reader = ParquetReader::new(Cursor::new(bytes)).set_rechunk(true).read_parallel(ParallelStrategy::None);
    let metadata = parse(metadata(&mut reader, path, version, key)?)?;
    let schema = guarded(path, || reader.schema())?;
    let there = R::COLUMNS.iter().filter(|column| schema.contains(column.name));
    let names: Vec<String> = there.map(|column| column.name.to_owned()).collect();
    let frame = guarded(path, || reader.with_columns(Some(names)).finish())?;
    for column in R::COLUMNS {
        check_column(&frame, column, path)?;
    }
    let cells: Vec<Cells> = R::COLUMNS
        .iter()
        .map(|column| Cells::from_column(&frame, column))
        .collect::<Result<_, _>>()
        .map_err(not_parquet)?;
    let rows = (0..frame.height())
        .map(|row| {
            R::from_values(cells.iter().map(|column| column.get(row))).map_err(|(column, source)| ReadError::Cell {
                path: path.to_owned(),
                row: row + 1,
                column,
                source,
            })
        })
        .collect::<Result<_, _>>()?;
    Ok((rows, metadata))
}

/// Runs a part of Polars' reader, and turns its panics, which some damaged files cause, into errors.
fn guarded<T>(path: &Path, read: impl FnOnce() -> PolarsResult<T>) -> Result<T, ReadError> {
    // After a panic, nothing is used that the reader may have left half done.
    match catch_unwind(AssertUnwindSafe(read)) {
        Ok(read) => read.map_err(|source| ReadError::NotParquet { path: path.to_owned(), source }),
        Err(_) => Err(ReadError::Damaged { path: path.to_owned() }),
    }
}

fn metadata(
    reader: &mut ParquetReader<Cursor<Vec<u8>>>,
    path: &Path,
    expected: u32,
    key: &'static str,
) -> Result<String, ReadError> {
    let file = guarded(path, || reader.get_metadata())?;
    let value_of = |key: &'static str| {
        let mut pairs = file.key_value_metadata.iter().flatten();
        pairs
            .find_map(|pair| pair.value.clone().filter(|_| pair.key == key))
            .ok_or(ReadError::NotOurs { path: path.to_owned(), key })
    };
    let got = value_of(VERSION_KEY)?;
    if got.parse() != Ok(expected) {
        return Err(ReadError::OtherVersion { path: path.to_owned(), expected, got });
    }
    value_of(key)
}

fn check_column(frame: &DataFrame, column: &Column, path: &Path) -> Result<(), ReadError> {
    let found = frame
        .column(column.name)
        .map_err(|_| ReadError::MissingColumn { path: path.to_owned(), column: column.name })?
        .dtype();
    // A time zone may be written as 'UTC' or '+00:00'; the numbers are the same.
    let is_utc_us = matches!(found, DataType::Datetime(TimeUnit::Microseconds, Some(_)));
    if *found == data_type(column.column_type) || (column.column_type == ColumnType::TimeUtc && is_utc_us) {
        return Ok(());
    }
    Err(ReadError::ColumnType {
        path: path.to_owned(),
        column: column.name,
        expected: column.column_type,
        got: found.to_string(),
    })
}
