//! Writes and reads `truth.parquet`, the truth of a simulated study.

use std::path::Path;

use model::results::{TRUTH_SCHEMA_VERSION, TruthRow};

use super::VERSION_KEY;
use super::read::{ReadError, read_rows_and};
use super::row_file::RowFile;
use super::sink::SinkError;

/// Key of the study's origin in the metadata, as JSON.
const MADE_KEY: &str = "aim_batch.simulate";

/// Writes rows to `path` in their order, with zstd, aside first and then renamed. The same rows and origin give the same bytes.
/// `made_from` is the origin of the study as JSON; it goes into the metadata as `aim_batch.simulate`.
///
/// # Errors
/// [`SinkError`] when the file cannot be written; an earlier one is then unchanged.
pub fn write_truth(path: &Path, rows: Vec<TruthRow>, made_from: &str) -> Result<(), SinkError> {
    let mut file = RowFile::create(path)?;
    file.push(rows)?;
    file.seal(&[(VERSION_KEY, TRUTH_SCHEMA_VERSION.to_string()), (MADE_KEY, made_from.to_owned())])?;
    Ok(file.put_in_place()?)
}

/// Reads the rows and the origin of the study that [`write_truth`] wrote.
///
/// # Errors
/// [`ReadError`]: no such file, not Parquet, not a truth of this program's version, a missing column, or a column or cell of
/// another type.
pub fn read_truth(path: &Path) -> Result<(Vec<TruthRow>, String), ReadError> {
    read_rows_and(path, TRUTH_SCHEMA_VERSION, MADE_KEY, Ok)
}
