//! Tests of the gate: our tables against expected ones.

use std::path::Path;

use report::{CompareError, Comparison, Results, compare, write_dir};

use crate::bench;

fn compare_with(files: &[(&str, &str)], results: &Results, tolerance_pct: f64) -> Result<Comparison, CompareError> {
    let dir = tempfile::tempdir().unwrap();
    for (name, text) in files {
        std::fs::write(dir.path().join(name), text).unwrap();
    }
    compare(dir.path(), results, tolerance_pct)
}

fn table_i(text: &str, tolerance_pct: f64) -> Comparison {
    compare_with(&[("table_I.csv", text)], &bench::plates(), tolerance_pct).unwrap()
}

#[test]
fn our_own_tables_are_as_expected_with_no_tolerance() {
    for results in [bench::plates(), bench::raters(), bench::paper_plates()] {
        let dir = tempfile::tempdir().unwrap();
        write_dir(&results, dir.path()).unwrap();
        let comparison = compare(dir.path(), &results, 0.0).unwrap();
        assert!(comparison.is_ok(), "{comparison}");
        assert!(comparison.checked > 20, "{comparison}");
    }
}

#[test]
fn errors_may_differ_by_percentage_points_and_sizes_by_per_cent() {
    let text = "row,object,height_cm,pitch_deg,predicted_cm,error_pct\nrow,plate a,20,42.0,17.0,-4.9\n";
    let comparison = table_i(text, 0.7);
    assert_eq!((comparison.checked, comparison.differences.len()), (2, 0), "{comparison}");
    // 17.1 against 17.0 is 0.588 %, -5 against -4.9 is 0.1 points.
    let comparison = table_i(text, 0.5);
    assert_eq!(comparison.differences.len(), 1, "{comparison}");
    assert_eq!(comparison.differences[0].column, "predicted_cm");
    assert!((comparison.differences[0].difference.unwrap() - 100.0 * 0.1 / 17.0).abs() < 1e-6);
    assert_eq!(table_i(text, 0.05).differences.len(), 2);
}

#[test]
fn a_row_may_have_its_own_tolerance() {
    let text = "row,object,height_cm,pitch_deg,error_pct,tolerance_pct\nrow,plate a,20,42,-4,1\nrow,plate a,35,55,4,\n";
    let comparison = table_i(text, 0.1);
    assert_eq!(comparison.checked, 2);
    assert_eq!(comparison.differences.len(), 1, "{comparison}");
    assert_eq!(comparison.differences[0].row, "row, plate a, height_cm 35, pitch_deg 55");
}

#[test]
fn what_is_missing_is_a_difference() {
    let text = "row,object,height_cm,pitch_deg,predicted_cm,wisdom\n\
                row,plate c,20,42,17.1,\nrow,plate b,35,55,20,\nrow,plate b,20,42,21,\n";
    let files = [("table_I.csv", text), ("table_IX.csv", "row,object\noverall,\n")];
    let comparison = compare_with(&files, &bench::plates(), 1.0).unwrap();
    insta::assert_snapshot!("differences", comparison.to_string());
    assert_eq!(comparison.differences.len(), 4);
}

#[test]
fn counts_must_be_equal_and_rows_told_apart() {
    let comparison = table_i("row,object,n\nobject_mean,plate a,3\n", 50.0);
    assert_eq!(comparison.differences.len(), 1, "{comparison}");
    let ambiguous = table_i("row,object,error_pct\nrow,plate a,5\n", 50.0);
    assert_eq!(ambiguous.differences[0].got, "2 such rows: more key columns are needed");
}

#[test]
fn misuse_is_an_error_and_not_a_pass() {
    let plates = bench::plates();
    let missing = compare(Path::new("no-such-folder"), &plates, 0.1).unwrap_err();
    assert!(matches!(missing, CompareError::Read { .. }));
    let empty = compare_with(&[("README.md", "no tables")], &plates, 0.1).unwrap_err();
    assert!(matches!(empty, CompareError::NoFiles { .. }));
    let no_numbers = compare_with(&[("table_I.csv", "row,object,error_pct\n")], &plates, 0.1).unwrap_err();
    assert!(matches!(no_numbers, CompareError::NothingToCompare { .. }));
    for tolerance in [-0.1, f64::NAN, f64::INFINITY] {
        let error = compare_with(&[("table_I.csv", "row\n")], &plates, tolerance).unwrap_err();
        assert!(matches!(error, CompareError::Tolerance { .. }));
    }
    let words = "row,object,n\nobject_mean,plate a,two\n";
    let error = compare_with(&[("table_I.csv", words)], &plates, 0.1).unwrap_err();
    assert!(matches!(&error, CompareError::Number { line: 2, column, got, .. } if column == "n" && got == "two"));
    let tolerance = "row,object,n,tolerance_pct\nobject_mean,plate a,2,-1\n";
    let error = compare_with(&[("table_I.csv", tolerance)], &plates, 0.1).unwrap_err();
    assert!(matches!(&error, CompareError::Number { column, .. } if column == "tolerance_pct"));
    let ragged = compare_with(&[("table_I.csv", "row,object\noverall\n")], &plates, 0.1).unwrap_err();
    assert!(matches!(ragged, CompareError::Csv { .. }));
}
