//! For a terminal: UTF-8, no colours.

use comfy_table::{CellAlignment, ColumnConstraint, ContentArrangement, Width, presets};

use super::display::{caption, cell, heading, printable, shown};
use crate::table::{Align, Table};

/// Names wrap to lines of no fewer characters than this; a terminal that is narrower still breaks numbers, too.
const NAMES_AT_LEAST: usize = 12;

/// The table with its caption above and its footnotes below. `width` in columns wraps words to fit; none leaves lines
/// as long as they need. The study's statement is not here but under the set: [`terminal_set`].
#[must_use]
pub fn terminal(table: &Table, width: Option<usize>) -> String {
    let mut text = caption(table) + "\n";
    text.push_str(&grid(table, width));
    text.push('\n');
    for footnote in &table.footnotes {
        push_wrapped(&mut text, &format!("[{}] {}", footnote.mark, footnote.text), width);
    }
    for remark in std::iter::once(&table.statistic).chain(&table.remarks) {
        push_wrapped(&mut text, remark, width);
    }
    text
}

/// All tables, one under the other, and the study's statement at the end.
#[must_use]
pub fn terminal_set(tables: &[Table], width: Option<usize>) -> String {
    let mut text = tables.iter().map(|table| terminal(table, width)).collect::<Vec<_>>().join("\n");
    if let Some(statement) = tables.iter().find_map(|table| table.statement.as_ref()) {
        text.push('\n');
        push_wrapped(&mut text, statement, width);
    }
    text
}

fn grid(table: &Table, width: Option<usize>) -> String {
    let columns = shown(table);
    let headings: Vec<String> = columns.iter().map(|(_, column)| heading(column)).collect();
    let rows: Vec<Vec<String>> = table
        .rows
        .iter()
        .map(|row| {
            let mut cells: Vec<String> =
                columns.iter().enumerate().map(|(place, column)| cell(table, row, place, *column)).collect();
            if let Some(first) = cells.first_mut().filter(|_| !row.marks.is_empty()) {
                first.push_str(&format!(" [{}]", row.marks.join(", ")));
            }
            cells
        })
        .collect();
    let mut grid = comfy_table::Table::new();
    grid.load_preset(presets::UTF8_FULL_CONDENSED).force_no_tty();
    grid.set_header(&headings);
    for row in &rows {
        grid.add_row(row);
    }
    if let Some(width) = width {
        grid.set_content_arrangement(ContentArrangement::Dynamic);
        grid.set_width(u16::try_from(width).unwrap_or(u16::MAX));
        let mut widths = unbroken_widths(&headings, &rows);
        // Each column takes two spaces and a border more. What is too much is taken from the names, which may wrap.
        let excess = (widths.iter().map(|width| width + 3).sum::<usize>() + 1).saturating_sub(width);
        if let Some(names) = widths.first_mut() {
            *names = names.saturating_sub(excess);
            if *names >= NAMES_AT_LEAST || excess == 0 {
                grid.set_constraints(widths.iter().map(|width| {
                    ColumnConstraint::LowerBoundary(Width::Fixed(u16::try_from(width + 2).unwrap_or(u16::MAX)))
                }));
            }
        }
    }
    for (place, (_, column)) in columns.iter().enumerate() {
        if let Some(drawn) = grid.column_mut(place) {
            drawn.set_cell_alignment(match column.align {
                Align::Left => CellAlignment::Left,
                Align::Right => CellAlignment::Right,
            });
        }
    }
    grid.to_string()
}

/// Widths at which no cell and no word of a heading is broken.
fn unbroken_widths(headings: &[String], rows: &[Vec<String>]) -> Vec<usize> {
    let length = |text: &str| text.chars().count();
    (0..headings.len())
        .map(|place| {
            let words = headings[place].split(' ').map(length);
            words.chain(rows.iter().map(|row| length(&row[place]))).max().unwrap_or(0)
        })
        .collect()
}

/// Words on lines of at most `width` characters.
fn push_wrapped(text: &mut String, sentence: &str, width: Option<usize>) {
    let width = width.unwrap_or(usize::MAX);
    let mut used = 0;
    for word in printable(sentence).split_whitespace() {
        let length = word.chars().count();
        if used > 0 && used + 1 + length > width {
            text.push('\n');
            used = 0;
        } else if used > 0 {
            text.push(' ');
            used += 1;
        }
        text.push_str(word);
        used += length;
    }
    text.push('\n');
}
