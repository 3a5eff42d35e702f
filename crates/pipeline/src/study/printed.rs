//! The printed numbers of publications, from CSV files of the study.

use std::path::Path;

use ingest::nfc;
use model::{PrintedRow, PrintedSummary, PrintedTable, TableSpec};
use serde::Deserialize;

use super::StudyError;
use super::csv_file::read_rows;
use super::spec::{PrintedFiles, TableEntry};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RowLine {
    object: String,
    #[serde(default)]
    height_cm: Option<f64>,
    #[serde(default)]
    pitch_deg: Option<f64>,
    #[serde(default)]
    rater: Option<String>,
    #[serde(default)]
    predicted_cm: Option<f64>,
    #[serde(default)]
    original_cm: Option<f64>,
    #[serde(default)]
    error_pct: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SummaryLine {
    #[serde(default)]
    object: Option<String>,
    mean_pct: f64,
    sd_pct: f64,
}

/// The table with its printed files read.
pub(super) fn resolve(entry: &TableEntry, study_dir: &Path) -> Result<TableSpec, StudyError> {
    let printed = entry.printed.as_ref().map(|files| read_printed(files, study_dir)).transpose()?;
    Ok(TableSpec {
        id: entry.id.clone(),
        title: entry.title.clone(),
        layout: entry.layout,
        quantities: entry.quantities.clone(),
        method: entry.method,
        selection: entry.selection,
        objects: entry.objects.iter().map(nfc).collect(),
        kinds: entry.kinds.clone(),
        printed,
        notes: entry.notes.clone(),
    })
}

fn read_printed(files: &PrintedFiles, study_dir: &Path) -> Result<PrintedTable, StudyError> {
    let rows =
        read_rows::<RowLine>(&study_dir.join(&files.rows))?.into_iter().map(|(_, line)| printed_row(line)).collect();
    let summaries = match &files.summaries {
        Some(file) => read_rows::<SummaryLine>(&study_dir.join(file))?
            .into_iter()
            .map(|(_, line)| PrintedSummary {
                object: line.object.map(nfc),
                mean_pct: line.mean_pct,
                sd_pct: line.sd_pct,
            })
            .collect(),
        None => Vec::new(),
    };
    Ok(PrintedTable { source: files.source.clone(), rows, summaries })
}

fn printed_row(line: RowLine) -> PrintedRow {
    let mm = |cm: f64| cm * 10.0;
    PrintedRow {
        object: nfc(line.object),
        setup_height_mm: line.height_cm.map(mm),
        setup_pitch_deg: line.pitch_deg,
        rater: line.rater.map(nfc),
        predicted_mm: line.predicted_cm.map(mm),
        truth_mm: line.original_cm.map(mm),
        error_pct: line.error_pct,
    }
}
