//! Tests of the numbers in the tables against numbers that were computed by hand or printed in the paper.

use model::results::ResultRow;
use model::{Kind, Quantity, Selection, TableLayout, TableSpec};
use report::{Cell, RowKind, Table, error_by_height, error_by_pitch, tables};

use crate::bench;

pub fn column(table: &Table, name: &str) -> usize {
    table.columns.iter().position(|column| column.name == name).unwrap()
}

pub fn number(table: &Table, row: usize, name: &str) -> Option<f64> {
    match &table.rows[row].cells[column(table, name)] {
        Cell::Empty => None,
        Cell::Number(number) => Some(*number),
        Cell::Count(count) => Some(f64::from(u32::try_from(*count).unwrap())),
        Cell::Text(text) => panic!("a number was expected, got '{text}'"),
    }
}

pub fn text<'a>(table: &'a Table, row: usize, name: &str) -> &'a str {
    match &table.rows[row].cells[column(table, name)] {
        Cell::Text(text) => text,
        _ => "",
    }
}

fn assert_near(got: Option<f64>, expected: f64, tolerance: f64) {
    assert!(got.is_some_and(|got| (got - expected).abs() <= tolerance), "expected {expected}, got {got:?}");
}

fn row_of(table: &Table, kind: RowKind) -> usize {
    table.rows.iter().position(|row| row.kind == kind).unwrap()
}

#[test]
fn table_ii_of_the_paper_gives_what_its_rows_give() {
    let table = tables(&bench::paper_plates()).remove(0);
    assert_eq!(table.rows.len(), 5 * 9 + 5 + 1);
    let overall = row_of(&table, RowKind::Overall);
    assert_near(number(&table, overall, "error_pct"), 2.01, 0.005);
    assert_near(number(&table, overall, "sd_pct"), 4.90, 0.005);
    assert_eq!(number(&table, overall, "n"), Some(45.0));
    let printed = [
        ("circular plate (large)", 5.28, 4.39),
        ("circular plate (medium)", 0.96, 4.66),
        ("circular plate (small)", -1.31, 4.82),
        ("square plate (medium)", 2.40, 4.73),
        ("square plate (small)", 2.71, 4.38),
    ];
    let means: Vec<usize> = (0..table.rows.len()).filter(|row| table.rows[*row].kind == RowKind::ObjectMean).collect();
    assert_eq!(means.len(), printed.len());
    for (row, (object, mean, sd)) in means.into_iter().zip(printed) {
        assert_eq!(text(&table, row, "object"), object);
        assert_near(number(&table, row, "error_pct"), mean, 0.02);
        assert_near(number(&table, row, "sd_pct"), sd, 0.02);
    }
}

#[test]
fn setups_skip_what_is_missing_and_say_so() {
    let table = tables(&bench::plates()).remove(0);
    // plate a at 20 and 35 cm, its mean, plate b at 20 and 35 cm, its mean, overall.
    assert_eq!(table.rows.len(), 7);
    assert_near(number(&table, 2, "error_pct"), 0.0, 1e-12);
    assert_near(number(&table, 2, "sd_pct"), 50.0_f64.sqrt(), 1e-12);
    assert_eq!(number(&table, 4, "predicted_cm"), None);
    assert_eq!(number(&table, 4, "error_pct"), None);
    assert_eq!(text(&table, 4, "note"), "not measured: above_horizon");
    assert_eq!(number(&table, 5, "n"), Some(1.0));
    assert_eq!(number(&table, 5, "sd_pct"), None, "one error has no sample SD");
    assert_near(number(&table, 6, "error_pct"), 5.0 / 3.0, 1e-12);
    assert_near(number(&table, 6, "sd_pct"), (100.0_f64 / 3.0).sqrt(), 1e-12);
    assert_eq!(number(&table, 6, "printed_sd_pct"), Some(4.1));
    assert_eq!(number(&table, 0, "printed_cm"), Some(17.1));
    let marks: Vec<String> = table.rows.iter().map(|row| row.marks.join("")).collect();
    assert_eq!(marks, ["a", "", "b", "", "c", "", "d"]);
}

#[test]
fn images_of_one_setup_and_rater_count_once_with_their_mean() {
    let spec = bench::spec("I", TableLayout::Setups, &[]);
    let rows = vec![
        bench::plate("p", true, Some(180.0), 200.0),
        bench::plate("p", true, Some(200.0), 200.0),
        ResultRow { rater: "ben".to_owned(), ..bench::plate("p", true, Some(210.0), 200.0) },
        // A row without a nominal setup is no row of this layout.
        bench::row("p", Kind::Plate, Quantity::Diameter, Some(1.0), 200.0),
    ];
    let table = tables(&bench::results(rows, vec![spec])).remove(0);
    assert_eq!(table.rows.len(), 4);
    assert_near(number(&table, 0, "error_pct"), -5.0, 1e-12);
    assert_eq!(number(&table, 0, "n"), Some(2.0));
    assert_eq!((text(&table, 0, "rater"), text(&table, 1, "rater")), ("anna", "ben"));
    assert_near(number(&table, 1, "error_pct"), 5.0, 1e-12);
    assert!(table.columns[column(&table, "rater")].heading.is_some(), "several raters are told apart");
}

#[test]
fn near_target_leaves_out_frames_that_were_not_selected() {
    let spec = TableSpec {
        selection: Selection::NearTarget,
        printed: bench::plates().metadata.tables.remove(0).printed,
        ..bench::spec("I", TableLayout::Setups, &[])
    };
    let unselected = ResultRow { selected: false, ..bench::plate("plate a", true, Some(100.0), 200.0) };
    let rows = vec![unselected, bench::plate("plate a", false, Some(190.0), 200.0)];
    let table = tables(&bench::results(rows, vec![spec])).remove(0);
    assert_eq!(table.rows.len(), 3);
    assert_near(number(&table, 2, "error_pct"), -5.0, 1e-12);
}

#[test]
fn a_printed_setup_without_frames_leaves_a_hole_that_shows() {
    let mut results = bench::plates();
    results.rows.retain(|row| row.object != "plate a");
    let table = tables(&results).remove(0);
    assert_eq!((text(&table, 0, "object"), number(&table, 0, "printed_cm")), ("plate a", Some(17.1)));
    assert_eq!(number(&table, 0, "predicted_cm"), None);
    assert!(text(&table, 0, "note").contains("no size of a bench setup by this method"));
}

#[test]
fn two_quantities_of_one_object_are_two_blocks_and_printed_numbers_stand_by_the_first() {
    let mut results = bench::plates();
    let mut more: Vec<ResultRow> = results.rows.clone();
    more.iter_mut().for_each(|row| row.quantity = Quantity::Height);
    results.rows.extend(more);
    results.metadata.tables[0].quantities = vec![Quantity::Height, Quantity::Diameter];
    let table = tables(&results).remove(0);
    assert_eq!(table.rows.len(), 13);
    assert_eq!((text(&table, 0, "quantity"), text(&table, 3, "quantity")), ("height", "diameter"));
    assert_eq!((number(&table, 0, "printed_cm"), number(&table, 3, "printed_cm")), (Some(17.1), None));
}

#[test]
fn raters_by_hand() {
    let table = tables(&bench::raters()).remove(0);
    assert_eq!(table.rows.len(), 4);
    assert_eq!(number(&table, 0, "rater_anna_cm"), Some(11.0));
    assert_near(number(&table, 0, "error_pct"), 0.0, 1e-12);
    assert_eq!(number(&table, 1, "rater_ben_cm"), None);
    assert_eq!(number(&table, 1, "n"), Some(1.0));
    assert_near(number(&table, 1, "error_pct"), 10.0, 1e-12);
    assert_eq!(text(&table, 1, "note"), "printed with the wrong sign; ben: not measured: rim_not_marked");
    assert_near(number(&table, 2, "error_pct"), 5.0, 1e-12);
    assert_near(number(&table, 2, "sd_pct"), 5.0, 1e-12);
    assert_eq!(table.rows[3].kind, RowKind::OverallPrintedTruth);
    assert_near(number(&table, 3, "error_pct"), 0.0, 1e-12);
    assert_near(number(&table, 3, "sd_pct"), 0.0, 1e-12);
}

#[test]
fn equal_printed_truths_make_no_second_overall_row() {
    let mut results = bench::raters();
    let printed = results.metadata.tables[0].printed.as_mut().unwrap();
    printed.rows[1].truth_mm = Some(50.0);
    let table = tables(&results).remove(0);
    assert_eq!(table.rows.len(), 3);
    assert!(table.columns[column(&table, "printed_original_cm")].heading.is_none());
}

#[test]
fn without_truth_there_is_no_error_and_a_note_without_row_is_kept() {
    let mut results = bench::plates();
    results.rows.iter_mut().for_each(|row| row.truth_mm = None);
    results.metadata.tables[0].notes = vec![bench::note(Some("plate z"), None, "gone")];
    let table = tables(&results).remove(0);
    assert_eq!(number(&table, 0, "predicted_cm"), Some(17.1));
    assert_eq!(number(&table, 0, "error_pct"), None);
    let overall = row_of(&table, RowKind::Overall);
    assert_eq!((number(&table, overall, "n"), number(&table, overall, "error_pct")), (Some(0.0), None));
    assert_eq!(text(&table, overall, "note"), "plate z: gone");
    assert!(error_by_pitch(&results).rows.is_empty());
}

/// The mean absolute errors of all plates by band, from the paper's own rows.
#[test]
fn errors_by_pitch_and_height_of_the_paper() {
    let results = bench::paper_plates();
    let across = |table: &Table| -> Vec<(Option<f64>, Option<f64>)> {
        (0..table.rows.len())
            .filter(|row| text(table, *row, "quantity") == "across")
            .map(|row| (number(table, row, "mean_absolute_pct"), number(table, row, "n")))
            .collect()
    };
    let by_pitch = error_by_pitch(&results);
    let by_height = error_by_height(&results);
    for (rows, expected) in
        [(across(&by_pitch), ["3.88", "2.71", "6.28"]), (across(&by_height), ["5.02", "5.19", "2.65"])]
    {
        assert_eq!(rows.len(), 3);
        for ((mean_absolute, n), expected) in rows.into_iter().zip(expected) {
            assert_eq!(format!("{:.2}", mean_absolute.unwrap()), expected);
            assert_eq!(n, Some(15.0));
        }
    }
    assert_eq!(text(&by_height, 0, "basis"), "nominal");
}

#[test]
fn pitch_borders_belong_to_the_upper_band_and_90_to_the_last() {
    let at = |pitch_deg: f64, predicted_mm: f64| ResultRow {
        pitch_deg: Some(pitch_deg),
        range_mm: Some(500.0),
        ..bench::row("p", Kind::Bowl, Quantity::Diameter, Some(predicted_mm), 100.0)
    };
    let results = bench::results(vec![at(47.5, 101.0), at(47.499, 102.0), at(90.0, 103.0), at(0.0, 104.0)], Vec::new());
    let table = error_by_pitch(&results);
    let bands: Vec<_> = (0..table.rows.len())
        .map(|row| {
            ["pitch_from_deg", "pitch_to_deg", "bias_pct"].map(|name| number(&table, row, name).unwrap().round())
        })
        .collect();
    assert_eq!(bands, [[0.0, 30.0, 4.0], [30.0, 48.0, 2.0], [48.0, 63.0, 1.0], [75.0, 90.0, 3.0]]);
    let by_height = error_by_height(&results);
    assert_eq!(text(&by_height, 0, "basis"), "measured");
    // 500 sin 47.5 deg = 368.6 mm lies between 30 and 40 cm.
    assert_eq!(number(&by_height, 1, "height_from_cm"), Some(30.0));
    assert_eq!(number(&by_height, 1, "n"), Some(2.0));
}
