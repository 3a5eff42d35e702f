//! A table as text for a terminal: UTF-8, no colours.

use comfy_table::{CellAlignment, ColumnConstraint, ContentArrangement, Width, presets};

use super::display::{caption, cell, heading, printable, shown};
use crate::table::{Align, Column, Role, Table};

/// Names wrap to lines of no fewer characters than this. On a terminal that is too narrow even for that, numbers break as well.
const NAMES_AT_LEAST: usize = 12;

/// The table with its caption above and its footnotes below. Words wrap to `width` columns; without it, lines are as long as
/// they need to be. The study's statement is not part of it: it stands below the whole set ([`terminal_set`]).
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

/// All tables, one below the other, and the study's statement at the end.
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
        fit(&mut grid, width, unbroken_widths(&columns, &headings, &rows));
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

/// Makes the grid as wide as the terminal, with no column narrower than its width in `widths` where that is possible.
fn fit(grid: &mut comfy_table::Table, width: usize, mut widths: Vec<usize>) {
    grid.set_content_arrangement(ContentArrangement::Dynamic);
    grid.set_width(to_u16(width));
    let Some(names) = widths.first().copied() else { return };
    // In addition, each column takes its spaces and a border.
    let needed = |spaces: usize| widths.iter().map(|width| width + spaces + 1).sum::<usize>() + 1;
    // The excess is taken from the space before cells where that is enough, and else from the names, which may wrap.
    let choices = [(2, names), (1, names), (2, NAMES_AT_LEAST), (1, NAMES_AT_LEAST)];
    let fitting = choices.into_iter().find_map(|(spaces, names_at_least)| {
        let left = names.checked_sub(needed(spaces).saturating_sub(width))?;
        (left >= names_at_least.min(names)).then_some((spaces, left))
    });
    let Some((spaces, left)) = fitting else { return };
    widths[0] = left;
    if spaces == 1 {
        grid.column_iter_mut().for_each(|column| {
            column.set_padding((0, 1));
        });
    }
    let at_least = |width: &usize| ColumnConstraint::LowerBoundary(Width::Fixed(to_u16(width + spaces)));
    grid.set_constraints(widths.iter().map(at_least));
}

fn to_u16(width: usize) -> u16 {
    u16::try_from(width).unwrap_or(u16::MAX)
}

/// The widths of columns at which no cell and no word of a heading is broken. Sentences may wrap between their words.
fn unbroken_widths(columns: &[(usize, &Column)], headings: &[String], rows: &[Vec<String>]) -> Vec<usize> {
    let length = |text: &str| text.chars().count();
    let longest_word = |text: &str| text.split(' ').map(length).max().unwrap_or(0);
    let unbroken = |(place, (_, column)): (usize, &(usize, &Column))| {
        let of_cell = |text: &str| if column.role == Role::Note { longest_word(text) } else { length(text) };
        let cells = rows.iter().map(|row| of_cell(&row[place]));
        cells.chain([longest_word(&headings[place])]).max().unwrap_or(0)
    };
    columns.iter().enumerate().map(unbroken).collect()
}

/// Appends the words of a sentence on lines of at most `width` characters.
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
