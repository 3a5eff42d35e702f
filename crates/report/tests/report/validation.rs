//! Tests of the tables accuracy, rater_agreement and methods against numbers that were computed by hand.

use model::results::ResultRow;
use model::{Level, Method};
use report::{Table, accuracy, methods, rater_agreement};

use crate::bench;
use crate::statistics::{number, text};

fn find(table: &Table, wanted: &[(&str, &str)]) -> usize {
    (0..table.rows.len()).find(|&row| wanted.iter().all(|(name, value)| text(table, row, name) == *value)).unwrap()
}

fn sized(object: &str, predicted_mm: f64, sigma_mm: f64) -> ResultRow {
    ResultRow { sigma_mm: Some(sigma_mm), ..bench::plate(object, true, Some(predicted_mm), 200.0) }
}

#[test]
fn errors_coverage_and_intervals() {
    // Errors of -1, +1, +3 and +5 %: -2, 2, 6 and 10 mm.
    let doubtful = ResultRow { doubts: "paper_approximation".to_owned(), ..sized("b", 210.0, 0.1) };
    let rows = vec![sized("a", 198.0, 3.0), sized("a", 202.0, 1.5), sized("b", 206.0, 2.0), doubtful];
    let table = accuracy(&bench::results(rows, Vec::new()));
    let row = find(&table, &[("by", "all")]);
    let near = |name: &str, expected: f64| {
        let got = number(&table, row, name).unwrap();
        assert!((got - expected).abs() < 1e-9, "{name}: {got} {expected}");
    };
    let sd = (20.0_f64 / 3.0).sqrt();
    near("n", 4.0);
    near("bias_pct", 2.0);
    near("sd_pct", sd);
    near("rmse_pct", 3.0);
    near("mae_pct", 2.5);
    near("median_pct", 2.0);
    near("q95_absolute_pct", 4.7);
    near("max_absolute_pct", 5.0);
    near("limit_low_pct", 2.0 - 1.959_963_984_540_054 * sd);
    near("clusters", 2.0);
    // Only both of a, both of b, or one of each can be drawn.
    near("bias_low_pct", 0.0);
    near("bias_high_pct", 4.0);
    // A size with a doubt claims nothing. Of the other three, one is within 1 sigma (-2 mm of 3 mm), and two are within 1.96 sigma
    // (also 2 mm of 1.5 mm).
    near("claimed", 3.0);
    near("within_68_pct", 100.0 / 3.0);
    near("within_95_pct", 200.0 / 3.0);
    for (by, group) in [("pitch", "030.0-047.5 deg"), ("height", "020.0 cm"), ("object", "a"), ("rater", "anna")] {
        find(&table, &[("by", by), ("group", group)]);
    }
}

#[test]
fn participants_are_the_clusters_where_there_are_several() {
    let of = |who: &str, mm: f64| ResultRow { participant: Some(who.to_owned()), ..sized("a", mm, 1.0) };
    let table = accuracy(&bench::results(vec![of("P1", 201.0), of("P2", 202.0), of("P3", 203.0)], Vec::new()));
    assert_eq!(number(&table, find(&table, &[("by", "all")]), "clusters"), Some(3.0));
    assert!(table.remarks[0].contains("participant"));
}

#[test]
fn raters_of_table_v() {
    let cm = [[25.7, 25.18, 7.17, 26.37], [15.1, 15.75, 15.1, 15.39], [14.83, 15.2, 15.41, 15.25]];
    let rows = ["white box", "pink bowl", "green bowl"]
        .into_iter()
        .zip(cm)
        .flat_map(|(object, sizes)| {
            ["A", "B", "C", "D"]
                .into_iter()
                .zip(sizes)
                .map(move |(rater, cm)| bench::fused(object, rater, Some(10.0 * cm), 1.0))
        })
        .collect();
    let table = rater_agreement(&bench::results(rows, Vec::new()));
    assert_eq!((number(&table, 0, "raters"), number(&table, 0, "targets")), (Some(4.0), Some(3.0)));
    // pingouin: crates/model/tests/vectors/agreement.json.
    assert!((number(&table, 0, "icc_2_1").unwrap() - 0.126_632_598_691_73).abs() < 1e-9);
}

#[test]
fn methods_on_the_same_marks() {
    let by = |method: Method, object: &str, mm: f64| ResultRow { method, ..sized(object, mm, 1.0) };
    let rows = vec![
        by(Method::Paper, "a", 210.0),
        by(Method::Ray, "a", 204.0),
        by(Method::Paper, "b", 192.0),
        by(Method::Ray, "b", 202.0),
        by(Method::Ray, "c", 300.0), // not measured by the other
    ];
    let table = methods(&bench::results(rows, Vec::new()));
    assert_eq!(table.rows.len(), 1);
    assert_eq!((text(&table, 0, "first"), text(&table, 0, "second")), ("paper", "ray"));
    assert_eq!(number(&table, 0, "n"), Some(2.0));
    // 5 - 2 and 4 - 1 per cent: no scatter, so no t.
    assert!((number(&table, 0, "difference_pct").unwrap() - 3.0).abs() < 1e-9 && number(&table, 0, "t").is_none());
    assert_eq!(text(&table, 0, "level"), Level::Frame.code());
}
