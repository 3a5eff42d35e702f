//! The tables as they are printed in the paper, which the report shows beside its own.

use serde::Serialize;

use super::tables::{Published, RATERS, RaterRow, SetupRow, SummaryRow, Table};
use crate::error::SimulateError;
use crate::study::StudyFolder;

/// A row of `printed/table_*.csv`; a cell is empty where it does not apply.
#[derive(Debug, Clone, Serialize)]
struct PrintedRow<'a> {
    object: &'a str,
    height_cm: Option<f64>,
    pitch_deg: Option<f64>,
    rater: Option<&'static str>,
    predicted_cm: f64,
    original_cm: f64,
    error_pct: f64,
}

/// A row of `printed/table_*_summary.csv`. The one without an object is the overall row.
#[derive(Debug, Clone, Serialize)]
struct PrintedSummary<'a> {
    object: Option<&'a str>,
    mean_pct: f64,
    sd_pct: f64,
}

/// Writes the folder `printed`.
pub(super) fn write(folder: &StudyFolder, published: &Published) -> Result<(), SimulateError> {
    for table in [&published.plates, &published.bowl_heights, &published.bowl_diameters] {
        write_table(folder, table, |row| vec![setup_row(row)])?;
    }
    for table in [&published.container_sizes, &published.container_heights] {
        write_table(folder, table, rater_rows)?;
    }
    Ok(())
}

fn write_table<'a, R>(
    folder: &StudyFolder,
    table: &'a Table<R>,
    printed: impl Fn(&'a R) -> Vec<PrintedRow<'a>>,
) -> Result<(), SimulateError> {
    let rows: Vec<_> = table.rows.iter().flat_map(printed).collect();
    folder.write_csv(&format!("printed/table_{}.csv", table.id), &rows)?;
    let summaries: Vec<_> = table.summaries.iter().map(summary).collect();
    folder.write_csv(&format!("printed/table_{}_summary.csv", table.id), &summaries)
}

fn summary(row: &SummaryRow) -> PrintedSummary<'_> {
    PrintedSummary { object: row.object.as_deref(), mean_pct: row.mean_pct, sd_pct: row.sd_pct }
}

fn setup_row(row: &SetupRow) -> PrintedRow<'_> {
    PrintedRow {
        object: &row.object,
        height_cm: Some(row.height_cm),
        pitch_deg: Some(row.pitch_deg),
        rater: None,
        predicted_cm: row.predicted_cm,
        original_cm: row.original_cm,
        error_pct: row.error_pct,
    }
}

fn rater_rows(row: &RaterRow) -> Vec<PrintedRow<'_>> {
    let raters = RATERS.into_iter().zip(row.predicted_cm());
    raters
        .map(|(rater, predicted_cm)| PrintedRow {
            object: &row.object,
            height_cm: None,
            pitch_deg: None,
            rater: Some(rater),
            predicted_cm,
            original_cm: row.printed_truth_cm,
            error_pct: row.error_pct,
        })
        .collect()
}
