//! A table as CSV, for machines: every column, with the rows of means in the same file.

use super::display::shortest;
use crate::table::{Cell, Table, TableRow};

/// The table as CSV (RFC 4180, UTF-8, lines that end in LF), with a header line.
#[must_use]
pub fn csv(table: &Table) -> String {
    let mut text = line(&header(table));
    for row in &table.rows {
        text.push_str(&line(&record(row)));
    }
    text
}

/// The names of the columns.
pub(crate) fn header(table: &Table) -> Vec<String> {
    table.columns.iter().map(|column| column.name.clone()).collect()
}

/// The cells of a row as text.
pub(crate) fn record(row: &TableRow) -> Vec<String> {
    row.cells
        .iter()
        .map(|cell| match cell {
            Cell::Empty => String::new(),
            Cell::Text(text) => text.clone(),
            Cell::Number(number) => shortest(*number),
            Cell::Count(count) => count.to_string(),
        })
        .collect()
}

fn line(fields: &[String]) -> String {
    let fields: Vec<String> = fields.iter().map(|field| quoted(field)).collect();
    fields.join(",") + "\n"
}

fn quoted(field: &str) -> String {
    if field.contains([',', '"', '\n', '\r']) || field != field.trim() {
        format!("\"{}\"", field.replace('"', "\"\""))
    } else {
        field.to_owned()
    }
}
