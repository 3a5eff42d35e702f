//! Tests of files that are not ours, are damaged, or are not in their place.

use std::fs;
use std::path::Path;

use model::{ResultSink as _, RunLog};
use polars::prelude::{DataFrame, KeyValueMetadata, ParquetWriter, Series};
use polars::prelude::{IntoColumn as _, NamedFrom as _};
use report::{FileError, ParquetSink, ReadError, Results, SinkError, read_frames};

use crate::bench;

/// A Parquet file with one column, and these key-value pairs.
fn foreign(path: &Path, column: Series, pairs: &[(&str, &str)]) {
    let pairs = pairs.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    let mut frame = DataFrame::new(column.len(), vec![column.into_column()]).unwrap();
    ParquetWriter::new(fs::File::create(path).unwrap())
        .with_key_value_metadata(Some(KeyValueMetadata::from_static(pairs)))
        .finish(&mut frame)
        .unwrap();
}

#[test]
fn every_way_a_file_can_be_wrong_has_its_error() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("x.parquet");
    let read = || Results::read(&path).unwrap_err();
    let run = serde_json::to_string(&bench::plates().metadata).unwrap();
    let count = || Series::new("schema_version".into(), [1_u32]);

    assert!(matches!(read(), ReadError::Open { .. }));
    fs::write(&path, "object,predicted_mm\n").unwrap();
    assert!(matches!(read(), ReadError::NotParquet { .. }));
    foreign(&path, count(), &[]);
    assert!(matches!(read(), ReadError::NotOurs { key: "aim_batch.schema_version", .. }));
    foreign(&path, count(), &[("aim_batch.schema_version", "999")]);
    assert!(matches!(read(), ReadError::OtherVersion { expected: 2, got, .. } if got == "999"));
    foreign(&path, count(), &[("aim_batch.schema_version", "2")]);
    assert!(matches!(read(), ReadError::NotOurs { key: "aim_batch.run", .. }));
    foreign(&path, count(), &[("aim_batch.schema_version", "2"), ("aim_batch.run", "{")]);
    assert!(matches!(read(), ReadError::Metadata { .. }));
    foreign(&path, count(), &[("aim_batch.schema_version", "2"), ("aim_batch.run", &run)]);
    assert!(matches!(read(), ReadError::MissingColumn { column: "study", .. }));
    let text = Series::new("schema_version".into(), ["1"]);
    foreign(&path, text, &[("aim_batch.schema_version", "2"), ("aim_batch.run", &run)]);
    let error = read();
    assert!(matches!(error, ReadError::ColumnType { column: "schema_version", .. }));
    assert!(error.to_string().ends_with(&path.display().to_string()), "{error}");
}

#[test]
fn frames_are_not_results() {
    let dir = tempfile::tempdir().unwrap();
    let [results, frames] = ["results.parquet", "frames.parquet"].map(|name| dir.path().join(name));
    let mut sink = ParquetSink::create(&results, &frames).unwrap();
    sink.finish(&bench::plates().metadata, &RunLog::default()).unwrap();
    assert!(matches!(Results::read(&frames), Err(ReadError::MissingColumn { column: "object", .. })));
    assert!(matches!(read_frames(&results), Err(ReadError::MissingColumn { column: "reason", .. })));
    assert!(matches!(sink.finish(&bench::plates().metadata, &RunLog::default()), Err(SinkError::Finished)));
    assert!(matches!(sink.session(Vec::new(), Vec::new()), Err(SinkError::Finished)));
}

#[test]
fn folders_that_cannot_be_written_show_before_the_run() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("results.parquet");
    let create = |results: &Path, frames: &Path| ParquetSink::create(results, frames).err().unwrap();
    let nowhere = dir.path().join("no/such/results.parquet");
    assert!(matches!(create(&nowhere, &file), SinkError::File(FileError::Create { .. })));
    assert!(matches!(create(dir.path(), &file), SinkError::File(FileError::Folder { .. })));
    assert!(matches!(create(&file, &file), SinkError::SamePath { .. }));
}

#[test]
fn a_run_that_ends_early_leaves_the_earlier_files_and_no_temporary_ones() {
    let dir = tempfile::tempdir().unwrap();
    let [results, frames] = ["results.parquet", "frames.parquet"].map(|name| dir.path().join(name));
    fs::write(&results, "earlier").unwrap();
    let mut sink = ParquetSink::create(&results, &frames).unwrap();
    sink.session(bench::plates().rows, Vec::new()).unwrap();
    drop(sink);
    assert_eq!(fs::read_to_string(&results).unwrap(), "earlier");
    assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 1);
}

#[test]
fn a_file_cut_short_anywhere_is_refused() {
    let dir = tempfile::tempdir().unwrap();
    let [results, frames] = ["results.parquet", "frames.parquet"].map(|name| dir.path().join(name));
    let mut sink = ParquetSink::create(&results, &frames).unwrap();
    sink.session(bench::plates().rows, Vec::new()).unwrap();
    sink.finish(&bench::plates().metadata, &RunLog::default()).unwrap();
    let whole = fs::read(&results).unwrap();
    for length in (0..whole.len()).step_by(97) {
        fs::write(&results, &whole[..length]).unwrap();
        assert!(matches!(Results::read(&results), Err(ReadError::NotParquet { .. })), "{length} bytes");
    }
}
