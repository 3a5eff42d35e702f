//! A Parquet file that grows by rows.

use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use std::sync::PoisonError;

use model::results::Row;
use polars::io::parquet::write::{BatchedWriter, KeyValueMetadata, ParquetMetadataContext};
use polars::prelude::{DataFrame, Field, ParquetCompression, ParquetWriter, Schema};

use super::columns::{data_type, to_columns};
use super::sink::SinkError;
use crate::atomic::{Aside, FileError};

/// Number of rows of a row group. Memory holds one group. The borders of groups depend on nothing but the order of the rows, so
/// that neither sessions nor threads show in the bytes.
const ROWS_PER_GROUP: usize = 1 << 16;

/// A Parquet file of rows `R`, under a temporary name until it is put in place.
pub(super) struct RowFile<R> {
    path: PathBuf,
    aside: Aside,
    writer: BatchedWriter<BufWriter<File>>,
    pending: Vec<R>,
}

impl<R: Row> RowFile<R> {
    pub(super) fn create(path: &Path) -> Result<Self, SinkError> {
        let aside = Aside::create(path)?;
        let handle = aside.file().try_clone().map_err(|source| FileError::Create { path: path.to_owned(), source })?;
        let schema: Schema =
            R::COLUMNS.iter().map(|column| Field::new(column.name.into(), data_type(column.column_type))).collect();
        let writer = ParquetWriter::new(BufWriter::new(handle))
            .with_compression(ParquetCompression::Zstd(None))
            .batched(&schema)
            .map_err(|source| SinkError::Encode { path: path.to_owned(), source })?;
        Ok(Self { path: path.to_owned(), aside, writer, pending: Vec::new() })
    }

    /// Appends rows. Those that fill a row group are written.
    pub(super) fn push(&mut self, rows: Vec<R>) -> Result<(), SinkError> {
        self.pending.extend(rows);
        while self.pending.len() >= ROWS_PER_GROUP {
            let rest = self.pending.split_off(ROWS_PER_GROUP);
            let group = std::mem::replace(&mut self.pending, rest);
            self.write_group(&group)?;
        }
        Ok(())
    }

    fn write_group(&mut self, rows: &[R]) -> Result<(), SinkError> {
        let columns = to_columns(rows).map_err(|(column, source)| SinkError::Cell { column, source })?;
        DataFrame::new(rows.len(), columns)
            .and_then(|frame| self.writer.write_batch(&frame))
            .map_err(|source| SinkError::Encode { path: self.path.clone(), source })
    }

    /// Writes the rows that are left and the footer, and syncs the file, which keeps its temporary name.
    pub(super) fn seal(&mut self, key_values: &[(&str, String)]) -> Result<(), SinkError> {
        let rest = std::mem::take(&mut self.pending);
        if !rest.is_empty() {
            self.write_group(&rest)?;
        }
        let pairs = key_values.iter().map(|(key, value)| ((*key).to_owned(), value.clone())).collect();
        // The metadata of a run is known only now, so it goes to the inner writer. There is no embedded Arrow schema: without
        // it every reader takes Parquet's own types (string, double, timestamp[us, UTC]) and not Polars' string views.
        KeyValueMetadata::from_static(pairs)
            .collect(ParquetMetadataContext { arrow_schema: "" })
            .and_then(|pairs| self.writer.get_writer().lock().unwrap_or_else(PoisonError::into_inner).end(Some(pairs)))
            .map_err(|source| SinkError::Encode { path: self.path.clone(), source })?;
        Ok(self.aside.sync()?)
    }

    pub(super) fn put_in_place(self) -> Result<(), FileError> {
        drop(self.writer); // Windows renames only closed files
        self.aside.put_in_place()
    }
}
