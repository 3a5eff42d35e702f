//! Compares our tables with a folder of expected ones: the gate of automatic runs.

mod comparison;
mod expected;

use std::path::Path;

pub use comparison::{Comparison, Difference};
pub use expected::CompareError;
use expected::{ExpectedFile, ExpectedRow};

use crate::parquet::Results;
use crate::render::{header, record};
use crate::table::{Role, Table};
use crate::write_dir::every_table;

/// Compares our tables with every CSV file in `expected_dir`. The files have the names and the layout of those of
/// [`write_dir`](crate::write_dir) (docs/tables.md). `tolerance_pct` is in percentage points for errors in per cent, and
/// in per cent of the expected number for sizes. A column `tolerance_pct` in an expected file overrules it row by row.
///
/// # Errors
/// [`CompareError`]: the tolerance is no number from 0 up, the folder or a file cannot be read, there is no CSV file or no
/// number in it, or a cell that should hold a number does not.
pub fn compare(expected_dir: &Path, results: &Results, tolerance_pct: f64) -> Result<Comparison, CompareError> {
    if !(tolerance_pct.is_finite() && tolerance_pct >= 0.0) {
        return Err(CompareError::Tolerance { got: tolerance_pct.to_string() });
    }
    let tables = every_table(results);
    let mut comparison = Comparison::default();
    for path in expected::csv_files(expected_dir)? {
        let file = ExpectedFile::read(&path)?;
        match tables.iter().find(|table| table.stem == file.stem) {
            Some(table) => compare_file(&file, table, tolerance_pct, &mut comparison)?,
            None => comparison.differences.push(Difference::missing(&file.name(), "", "", "a table", "no such table")),
        }
    }
    if comparison.checked == 0 && comparison.differences.is_empty() {
        return Err(CompareError::NothingToCompare { path: expected_dir.to_owned() });
    }
    Ok(comparison)
}

/// A column that the expected file and our table both have, with its index in each.
struct Pair {
    theirs: usize,
    ours: usize,
    name: String,
}

fn compare_file(
    file: &ExpectedFile,
    table: &Table,
    tolerance_pct: f64,
    comparison: &mut Comparison,
) -> Result<(), CompareError> {
    let header = header(table);
    let mut keys = Vec::new();
    let mut results = Vec::new();
    for (theirs, name) in file.columns() {
        let Some(ours) = header.iter().position(|column| column == name) else {
            comparison.differences.push(Difference::missing(&file.name(), "", name, "a column", "no such column"));
            continue;
        };
        let pair = Pair { theirs, ours, name: name.to_owned() };
        match table.columns[ours].role {
            Role::Key => keys.push(pair),
            Role::Result => results.push(pair),
            Role::Note => {}
        }
    }
    let records: Vec<Vec<String>> = table.rows.iter().map(record).collect();
    for row in &file.rows {
        let allowed = file.tolerance(row)?.unwrap_or(tolerance_pct);
        compare_row(file, row, &keys, &results, &records, allowed, comparison)?;
    }
    Ok(())
}

fn compare_row(
    file: &ExpectedFile,
    row: &ExpectedRow,
    keys: &[Pair],
    results: &[Pair],
    records: &[Vec<String>],
    tolerance_pct: f64,
    comparison: &mut Comparison,
) -> Result<(), CompareError> {
    let described = describe(row, keys);
    let matching: Vec<&Vec<String>> = records
        .iter()
        .filter(|record| keys.iter().all(|key| is_same_key(row.cell(key.theirs), &record[key.ours])))
        .collect();
    let &[record] = matching.as_slice() else {
        let got = match matching.len() {
            0 => "no such row".to_owned(),
            n => format!("{n} such rows: more key columns are needed"),
        };
        comparison.differences.push(Difference::missing(&file.name(), &described, "", "a row", &got));
        return Ok(());
    };
    for pair in results {
        let Some(expected) = file.number(row, pair.theirs, &pair.name)? else { continue };
        comparison.check(&file.name(), &described, &pair.name, expected, &record[pair.ours], tolerance_pct);
    }
    Ok(())
}

/// Whether two key cells are the same: equal words, or equal numbers that may be written differently (20 and 20.0).
fn is_same_key(expected: &str, ours: &str) -> bool {
    match (expected.parse::<f64>(), ours.parse::<f64>()) {
        (Ok(expected), Ok(ours)) => (expected - ours).abs() < 1e-6,
        _ => expected == ours.trim(),
    }
}

fn describe(row: &ExpectedRow, keys: &[Pair]) -> String {
    let words = keys.iter().filter(|key| !row.cell(key.theirs).is_empty()).map(|key| {
        let cell = row.cell(key.theirs);
        if cell.parse::<f64>().is_ok() { format!("{} {cell}", key.name) } else { cell.to_owned() }
    });
    words.collect::<Vec<_>>().join(", ")
}
