//! The common part of the renderers for people: the columns that they show, and cells as words.

use crate::table::{Cell, Column, Format, Table, TableRow};

/// A number as text, with as many decimals as it needs, at most six.
pub(crate) fn shortest(number: f64) -> String {
    let text = format!("{number:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    unsigned_zero(text.to_owned())
}

/// The text of a number, without the sign of `-0.00`.
fn unsigned_zero(text: String) -> String {
    let is_zero = !text.bytes().any(|byte| byte.is_ascii_digit() && byte != b'0');
    match text.strip_prefix('-') {
        Some(rest) if is_zero => rest.to_owned(),
        _ => text,
    }
}

fn formatted(number: f64, format: Format) -> String {
    match format {
        Format::Decimals(decimals) => unsigned_zero(format!("{number:.decimals$}")),
        Format::Shortest => shortest(number),
    }
}

/// The text without control characters, which would move the cursor of a terminal, or end a line of a table.
pub(crate) fn printable(text: &str) -> String {
    text.chars().map(|character| if character.is_control() { '\u{fffd}' } else { character }).collect()
}

/// The columns that people see, with their indices.
pub(crate) fn shown(table: &Table) -> Vec<(usize, &Column)> {
    table.columns.iter().enumerate().filter(|(_, column)| column.heading.is_some()).collect()
}

/// Heading and unit of a column, such as `error (%)`.
pub(crate) fn heading(column: &Column) -> String {
    let heading = printable(column.heading.as_deref().unwrap_or(&column.name));
    match column.unit {
        Some(unit) if !unit.is_empty() => format!("{heading} ({unit})"),
        _ => heading,
    }
}

/// The text of a cell in a shown column, with its SD behind ± where it has one. `place` is the index among the shown columns,
/// `index` that among all.
pub(crate) fn cell(table: &Table, row: &TableRow, place: usize, (index, column): (usize, &Column)) -> String {
    if let Some(label) = row.label.as_ref().filter(|_| place == 0) {
        return label.clone();
    }
    let Some(cell) = row.cells.get(index) else { return String::new() };
    let text = match cell {
        Cell::Empty => return String::new(),
        Cell::Text(text) => printable(text),
        Cell::Number(number) => formatted(*number, column.format),
        Cell::Count(count) => count.to_string(),
    };
    let spread = column.spread.and_then(|name| table.columns.iter().position(|other| other.name == name));
    match spread.and_then(|index| row.cells.get(index)) {
        Some(Cell::Number(spread)) => format!("{text} \u{b1} {}", formatted(*spread, column.format)),
        _ => text,
    }
}

/// The caption with the number before it, such as `Table II. Error in dimensions for plates`.
pub(crate) fn caption(table: &Table) -> String {
    let title = printable(&table.title);
    match &table.label {
        Some(label) => format!("{}. {title}", printable(label)),
        None => title,
    }
}
