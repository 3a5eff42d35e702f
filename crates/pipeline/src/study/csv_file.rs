//! Small CSV files written by people.

use std::path::Path;

use serde::de::DeserializeOwned;

use super::StudyError;

/// Rows with their line numbers. Blanks around cells are dropped; the header names the columns, in any order.
pub(super) fn read_rows<T: DeserializeOwned>(path: &Path) -> Result<Vec<(u64, T)>, StudyError> {
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .from_path(path)
        .map_err(|source| StudyError::Csv { path: path.to_owned(), source })?;
    let headers = reader.headers().map_err(|source| StudyError::Csv { path: path.to_owned(), source })?.clone();
    reader
        .records()
        .map(|record| {
            let record = record?;
            let line = record.position().map_or(0, csv::Position::line);
            Ok((line, record.deserialize(Some(&headers))?))
        })
        .collect::<Result<_, csv::Error>>()
        .map_err(|source| StudyError::Csv { path: path.to_owned(), source })
}
