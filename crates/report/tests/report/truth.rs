//! Tests of writing truth.parquet and reading it back.

use model::results::TruthRow;
use model::{Kind, Shape, UtcNs};
use report::{ReadError, read_truth, write_truth};

fn rows() -> Vec<TruthRow> {
    let row = TruthRow::of_image("s1", "IMAGES/a.JPG", UtcNs(1_770_019_200_250_001_000), [55.0, -1.5, 512.25]);
    let with = TruthRow {
        participant: Some("P001".to_owned()),
        object: Some("lunch box".to_owned()),
        kind: Some(Kind::Box),
        shape: Some(Shape::Rectangle),
        true_width_mm: Some(120.0),
        true_length_mm: Some(180.0),
        turn_deg: Some(-11.0),
        marked: true,
        ..row.clone()
    };
    vec![row, with]
}

#[test]
fn rows_come_back_as_they_went_and_equal_rows_give_equal_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let [a, b] = ["a.parquet", "b.parquet"].map(|name| folder.path().join(name));
    write_truth(&a, rows(), "{\"seed\":7}").unwrap();
    write_truth(&b, rows(), "{\"seed\":7}").unwrap();
    assert_eq!(read_truth(&a).unwrap(), (rows(), "{\"seed\":7}".to_owned()));
    assert_eq!(std::fs::read(&a).unwrap(), std::fs::read(&b).unwrap());
}

#[test]
fn truth_is_not_taken_for_results_nor_a_cut_file_for_a_whole_one() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("truth.parquet");
    write_truth(&path, rows(), "{}").unwrap();
    assert!(matches!(report::Results::read(&path), Err(ReadError::NotOurs { .. })));
    let bytes = std::fs::read(&path).unwrap();
    std::fs::write(&path, &bytes[..bytes.len() - 9]).unwrap();
    assert!(read_truth(&path).is_err());
}
