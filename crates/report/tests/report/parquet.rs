//! Tests of rows that go to Parquet and back.

use model::results::{Column, ColumnType, FRAME_COLUMNS, FrameRow, RESULT_COLUMNS, ResultRow, Row, Value};
use model::{FrameReason, Kind, Level, Method, Quantity, ResultSink as _, RunLog, RunMetadata, Shape, UtcNs, Verdict};
use proptest::prelude::*;
use report::{ParquetSink, Results, read_frames};

use crate::bench;

/// The texts that a column can hold; none where it can hold any.
fn codes(column: &str) -> Option<Vec<&'static str>> {
    Some(match column {
        "kind" => Kind::ALL.iter().map(|code| code.code()).collect(),
        "shape" => Shape::ALL.iter().map(|code| code.code()).collect(),
        "quantity" => Quantity::ALL.iter().map(|code| code.code()).collect(),
        "method" | "method_used" => Method::ALL.iter().map(|code| code.code()).collect(),
        "level" => Level::ALL.iter().map(|code| code.code()).collect(),
        "consistency" => Verdict::ALL.iter().map(|code| code.code()).collect(),
        "reason" => FrameReason::ALL.iter().map(|code| code.code()).collect(),
        _ => return None,
    })
}

fn cell(column: &Column) -> BoxedStrategy<Value> {
    let value = match column.column_type {
        ColumnType::Text => match codes(column.name) {
            Some(codes) => proptest::sample::select(codes).prop_map(|code| Value::Text(code.to_owned())).boxed(),
            None => any::<String>().prop_map(Value::Text).boxed(),
        },
        ColumnType::Float => {
            let finite = proptest::num::f64::NORMAL | proptest::num::f64::ZERO | proptest::num::f64::SUBNORMAL;
            finite.prop_map(Value::Float).boxed()
        }
        ColumnType::Count => any::<u32>().prop_map(Value::Count).boxed(),
        ColumnType::Flag => any::<bool>().prop_map(Value::Flag).boxed(),
        ColumnType::TimeUtc => {
            (i64::MIN / 1000..i64::MAX / 1000).prop_map(|us| Value::TimeUtc(UtcNs(1000 * us))).boxed()
        }
    };
    if column.nullable { prop_oneof![Just(Value::Null), value].boxed() } else { value }
}

fn rows<R: Row + std::fmt::Debug>(columns: &'static [Column]) -> impl Strategy<Value = Vec<R>> {
    let row = columns.iter().map(cell).collect::<Vec<_>>().prop_map(|values| R::from_values(values).unwrap());
    proptest::collection::vec(row, 0..6)
}

fn write(dir: &std::path::Path, sessions: &[(&[ResultRow], &[FrameRow])], metadata: &RunMetadata) -> [Vec<u8>; 2] {
    let paths = ["results.parquet", "frames.parquet"].map(|name| dir.join(name));
    let mut sink = ParquetSink::create(&paths[0], &paths[1]).unwrap();
    for (results, frames) in sessions {
        sink.session(results.to_vec(), frames.to_vec()).unwrap();
    }
    sink.finish(metadata, &RunLog::default()).unwrap();
    paths.map(|path| std::fs::read(path).unwrap())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn rows_survive_the_file(
        results in rows::<ResultRow>(RESULT_COLUMNS),
        frames in rows::<FrameRow>(FRAME_COLUMNS),
        study in any::<String>(),
    ) {
        let dir = tempfile::tempdir().unwrap();
        let metadata = RunMetadata { study, ..bench::plates().metadata };
        write(dir.path(), &[(&results, &frames)], &metadata);
        let read = Results::read(&dir.path().join("results.parquet")).unwrap();
        prop_assert_eq!(read, Results { rows: results, metadata, flow: None });
        prop_assert_eq!(read_frames(&dir.path().join("frames.parquet")).unwrap(), frames);
    }
}

#[test]
fn not_a_number_is_kept_apart_from_nothing() {
    let dir = tempfile::tempdir().unwrap();
    let mut results = bench::plates();
    results.rows[0].predicted_mm = Some(f64::NAN);
    write(dir.path(), &[(&results.rows, &[])], &results.metadata);
    let read = Results::read(&dir.path().join("results.parquet")).unwrap();
    assert!(read.rows[0].predicted_mm.unwrap().is_nan());
    assert_eq!(read.rows[1].predicted_mm, None);
}

#[test]
fn equal_rows_give_equal_bytes_however_sessions_divide_them() {
    let results = bench::paper_plates();
    // More than one row group.
    let many: Vec<ResultRow> = results.rows.iter().cycle().take(70_000).cloned().collect();
    let [one, two, three] = [(); 3].map(|()| tempfile::tempdir().unwrap());
    let whole = write(one.path(), &[(&many, &[])], &results.metadata);
    assert_eq!(whole, write(two.path(), &[(&many, &[])], &results.metadata), "the same run twice");
    let parts: Vec<(&[ResultRow], &[FrameRow])> = many.chunks(9_999).map(|rows| (rows, &[][..])).collect();
    assert_eq!(whole, write(three.path(), &parts, &results.metadata), "in other portions");
    assert_eq!(Results::read(&one.path().join("results.parquet")).unwrap().rows, many);
}

#[test]
fn a_run_without_rows_writes_files_that_can_be_read() {
    let dir = tempfile::tempdir().unwrap();
    let metadata = bench::plates().metadata;
    write(dir.path(), &[], &metadata);
    let read = Results::read(&dir.path().join("results.parquet")).unwrap();
    assert_eq!(read, Results { rows: Vec::new(), metadata, flow: None });
    assert_eq!(read_frames(&dir.path().join("frames.parquet")).unwrap(), []);
}
