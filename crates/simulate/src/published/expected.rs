//! The tables that a correct program must print for this study: the published predictions, with errors and statistics that are
//! computed anew from them. They are not the printed errors, several of which are misprints (see the notes in study.toml).

use model::ErrorStats;
use serde::Serialize;

use super::tables::{Published, RaterRow, SetupRow, Table};
use crate::error::SimulateError;
use crate::study::StudyFolder;

/// Tolerance, in percentage points, of the summary rows of heights. They rest on sizes that are printed to 0.01 cm, which is
/// 0.3 % of them.
const HEIGHTS_TOLERANCE_PCT: f64 = 0.3;
/// Tolerance, in percentage points, of the overall rows of the other tables.
const OVERALL_TOLERANCE_PCT: f64 = 0.05;
/// Tolerances of a single row: of its error in percentage points, and of its size in cm.
const ROW_TOLERANCE_PCT: f64 = 0.15;
const ROW_TOLERANCE_CM: f64 = 0.02;

/// A row of `expected/table_II.csv` to `table_IV.csv`. Where its tolerance is empty, that of the command line counts.
#[derive(Debug, Clone, Serialize)]
struct SetupExpected<'a> {
    row: &'static str,
    object: Option<&'a str>,
    height_cm: Option<f64>,
    pitch_deg: Option<f64>,
    predicted_cm: Option<f64>,
    original_cm: Option<f64>,
    error_pct: f64,
    sd_pct: Option<f64>,
    tolerance_pct: Option<f64>,
}

/// A row of `expected/table_V.csv` and `table_VI.csv`.
#[derive(Debug, Clone, Serialize)]
struct RaterExpected<'a> {
    row: &'static str,
    object: Option<&'a str>,
    #[serde(rename = "rater_RA1_cm")]
    ra1_cm: Option<f64>,
    #[serde(rename = "rater_RA2_cm")]
    ra2_cm: Option<f64>,
    #[serde(rename = "rater_RA3_cm")]
    ra3_cm: Option<f64>,
    #[serde(rename = "rater_RA4_cm")]
    ra4_cm: Option<f64>,
    mean_cm: Option<f64>,
    original_cm: Option<f64>,
    error_pct: f64,
    sd_pct: Option<f64>,
    tolerance_pct: Option<f64>,
}

/// Writes the folder `expected`.
pub(super) fn write(folder: &StudyFolder, published: &Published) -> Result<(), SimulateError> {
    let heights = Some(HEIGHTS_TOLERANCE_PCT);
    for (table, tolerance_pct) in
        [(&published.plates, None), (&published.bowl_heights, heights), (&published.bowl_diameters, None)]
    {
        folder.write_csv(&format!("expected/table_{}.csv", table.id), &setup_rows(table, tolerance_pct))?;
    }
    let sizes = &published.container_sizes;
    folder.write_csv(&format!("expected/table_{}.csv", sizes.id), &rater_rows(sizes, None))?;
    let table = &published.container_heights;
    let mut rows = rater_rows(table, heights);
    let against_printed: Vec<_> = table.rows.iter().map(|row| error_pct(mean_cm(row), row.printed_truth_cm)).collect();
    rows.extend(rater_overall("overall_printed_truth", &against_printed, heights));
    folder.write_csv(&format!("expected/table_{}.csv", table.id), &rows)
}

/// The error in per cent, signed as in the paper.
fn error_pct(predicted_cm: f64, original_cm: f64) -> f64 {
    100.0 * (predicted_cm - original_cm) / original_cm
}

/// The tolerance of a row with sizes up to `largest_cm`, in per cent of a size and in percentage points of its error; none where
/// the usual one holds.
fn row_tolerance_pct(largest_cm: f64) -> Option<f64> {
    Some(rounded((100.0 * ROW_TOLERANCE_CM / largest_cm).min(ROW_TOLERANCE_PCT)))
}

/// The number, rounded to four decimals, which is far finer than any tolerance, and free of noise in the last bit.
fn rounded(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}

/// The rows of each object, then its mean and sample SD, and at the end the mean and sample SD of all rows.
fn setup_rows(table: &Table<SetupRow>, tolerance_pct: Option<f64>) -> Vec<SetupExpected<'_>> {
    let mut expected = Vec::new();
    let errors = |rows: &[&SetupRow]| -> Vec<f64> {
        rows.iter().map(|row| error_pct(row.predicted_cm, row.original_cm)).collect()
    };
    for object in table.objects() {
        let rows: Vec<_> = table.rows.iter().filter(|row| row.object == object).collect();
        expected.extend(rows.iter().map(|row| SetupExpected {
            row: "row",
            object: Some(object),
            height_cm: Some(row.height_cm),
            pitch_deg: Some(row.pitch_deg),
            predicted_cm: Some(row.predicted_cm),
            original_cm: Some(row.original_cm),
            error_pct: rounded(error_pct(row.predicted_cm, row.original_cm)),
            sd_pct: None,
            tolerance_pct: row_tolerance_pct(row.predicted_cm),
        }));
        expected.extend(setup_summary("object_mean", Some(object), &errors(&rows), tolerance_pct));
    }
    let all: Vec<_> = table.rows.iter().collect();
    expected.extend(setup_summary("overall", None, &errors(&all), tolerance_pct.or(Some(OVERALL_TOLERANCE_PCT))));
    expected
}

fn setup_summary<'a>(
    row: &'static str,
    object: Option<&'a str>,
    errors_pct: &[f64],
    tolerance_pct: Option<f64>,
) -> Option<SetupExpected<'a>> {
    let stats = ErrorStats::from_errors(errors_pct)?;
    Some(SetupExpected {
        row,
        object,
        height_cm: None,
        pitch_deg: None,
        predicted_cm: None,
        original_cm: None,
        error_pct: rounded(stats.mean),
        sd_pct: stats.sample_sd.map(rounded),
        tolerance_pct,
    })
}

fn mean_cm(row: &RaterRow) -> f64 {
    row.predicted_cm().iter().sum::<f64>() / 4.0
}

/// A row for each container, and then the mean and the population SD over the rows.
fn rater_rows(table: &Table<RaterRow>, tolerance_pct: Option<f64>) -> Vec<RaterExpected<'_>> {
    let errors_pct: Vec<_> = table.rows.iter().map(|row| error_pct(mean_cm(row), row.implied_truth_cm)).collect();
    let rows = table.rows.iter().zip(&errors_pct).map(|(row, error_pct)| {
        let [ra1_cm, ra2_cm, ra3_cm, ra4_cm] = row.predicted_cm().map(Some);
        RaterExpected {
            row: "row",
            object: Some(&row.object),
            ra1_cm,
            ra2_cm,
            ra3_cm,
            ra4_cm,
            mean_cm: Some(rounded(mean_cm(row))),
            original_cm: Some(row.implied_truth_cm),
            error_pct: rounded(*error_pct),
            sd_pct: None,
            tolerance_pct: None,
        }
    });
    rows.chain(rater_overall("overall", &errors_pct, tolerance_pct)).collect()
}

fn rater_overall(row: &'static str, errors_pct: &[f64], tolerance_pct: Option<f64>) -> Option<RaterExpected<'static>> {
    let stats = ErrorStats::from_errors(errors_pct)?;
    Some(RaterExpected {
        row,
        object: None,
        ra1_cm: None,
        ra2_cm: None,
        ra3_cm: None,
        ra4_cm: None,
        mean_cm: None,
        original_cm: None,
        error_pct: rounded(stats.mean),
        sd_pct: Some(rounded(stats.population_sd)),
        tolerance_pct,
    })
}
