//! A table as Markdown, for documents: a pipe table as GitHub and Pandoc read it.

use super::display::{caption, cell, heading, printable, shown};
use crate::table::{Align, Table};

/// The table as Markdown: a heading of level 3, the table, its footnotes, and the study's statement.
#[must_use]
pub fn markdown(table: &Table) -> String {
    let columns = shown(table);
    let mut text = format!("### {}\n\n", escaped(&caption(table)));
    text.push_str(&line(columns.iter().map(|(_, column)| escaped(&heading(column)))));
    text.push_str(&line(columns.iter().map(|(_, column)| {
        match column.align {
            Align::Left => ":---",
            Align::Right => "---:",
        }
        .to_owned()
    })));
    for row in &table.rows {
        text.push_str(&line(columns.iter().enumerate().map(|(place, column)| {
            let text = escaped(&cell(table, row, place, *column));
            let text = if row.label.is_some() && !text.is_empty() { format!("**{text}**") } else { text };
            if place == 0 && !row.marks.is_empty() {
                format!("{text} <sup>{}</sup>", row.marks.join(", "))
            } else {
                text
            }
        })));
    }
    for footnote in &table.footnotes {
        text.push_str(&format!("\n<sup>{}</sup> {}\n", footnote.mark, markdown_text(&footnote.text)));
    }
    for remark in std::iter::once(&table.statistic).chain(&table.remarks).chain(&table.statement) {
        text.push_str(&format!("\n{}\n", markdown_text(remark)));
    }
    text
}

/// A sentence or name as Markdown that shows it unchanged.
pub(crate) fn markdown_text(text: &str) -> String {
    escaped(&printable(text))
}

fn line(cells: impl Iterator<Item = String>) -> String {
    format!("| {} |\n", cells.collect::<Vec<_>>().join(" | "))
}

/// The text, escaped so that it shows unchanged: no emphasis, links, HTML, formulas or cell borders.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '\\' | '`' | '*' | '_' | '[' | ']' | '|' | '~' | '$' | '#' | '{' | '}' | '^' => {
                escaped.push('\\');
                escaped.push(character);
            }
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            _ => escaped.push(character),
        }
    }
    escaped
}
