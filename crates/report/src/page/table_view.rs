//! Tables as the page shows them.

use super::data::{Datum, Grid, GridColumn, GridKind, Words, script_json};
use crate::render::display::{caption, cell, heading, printable, shown};
use crate::table::{Align, Column, Footnote, RowKind, Table, TableRow};

/// A table with more rows than this is long.
const LONG: usize = 120;
/// So many rows of a long table stand in the document, for readers without the script. The script shows all of them, a page at
/// a time.
const SHOWN_OF_LONG: usize = 40;
/// A table of more rows than this scrolls in a frame of its own, below its headings.
const TALL: usize = 40;

/// A table as the template shows it, with every cell as text for people.
pub(super) struct TableView {
    pub(super) stem: String,
    pub(super) caption: String,
    pub(super) statistic: String,
    pub(super) columns: Vec<ColumnView>,
    pub(super) rows: Vec<RowView>,
    pub(super) footnotes: Vec<Footnote>,
    pub(super) remarks: Vec<String>,
    /// Number of rows of the table. `rows` may hold fewer.
    pub(super) total: usize,
    pub(super) is_tall: bool,
    /// Whether the table lies beside the page as files.
    pub(super) has_files: bool,
    /// All rows of a long table, as JSON.
    pub(super) json: Option<String>,
}

pub(super) struct ColumnView {
    pub(super) heading: String,
    pub(super) is_number: bool,
}

pub(super) struct RowView {
    /// Whether the row holds means or sums. Such rows stay below when rows are sorted.
    pub(super) is_summary: bool,
    pub(super) first: String,
    pub(super) marks: Vec<String>,
    pub(super) cells: Vec<CellView>,
}

pub(super) struct CellView {
    pub(super) text: String,
    pub(super) is_number: bool,
}

impl TableView {
    /// The table as the template shows it. Fails where a long one cannot be written as JSON.
    pub(super) fn from_table(table: &Table, has_files: bool) -> Result<Self, serde_json::Error> {
        let is_long = table.rows.len() > LONG;
        let rows = if is_long { &table.rows[..SHOWN_OF_LONG] } else { &table.rows[..] };
        let is_number = |align: Align| align == Align::Right;
        Ok(Self {
            stem: table.stem.clone(),
            caption: caption(table),
            statistic: printable(&table.statistic),
            columns: shown(table)
                .into_iter()
                .map(|(_, column)| ColumnView { heading: heading(column), is_number: is_number(column.align) })
                .collect(),
            rows: rows.iter().map(|row| row_view(table, row)).collect(),
            footnotes: table.footnotes.clone(),
            remarks: table.remarks.iter().map(|remark| printable(remark)).collect(),
            total: table.rows.len(),
            is_tall: rows.len() > TALL,
            has_files,
            json: if is_long { Some(script_json(&grid(table))?) } else { None },
        })
    }
}

fn texts(table: &Table, row: &TableRow) -> Vec<CellView> {
    let view = |(place, (index, column)): (usize, (usize, &Column))| {
        let is_number = column.align == Align::Right;
        let text = cell(table, row, place, (index, column));
        CellView { text: if is_number { text.replace('-', "\u{2212}") } else { text }, is_number }
    };
    shown(table).into_iter().enumerate().map(view).collect()
}

fn row_view(table: &Table, row: &TableRow) -> RowView {
    let mut cells = texts(table, row);
    let first = if cells.is_empty() { String::new() } else { cells.remove(0).text };
    RowView { is_summary: row.kind != RowKind::Row, first, marks: row.marks.clone(), cells }
}

fn grid(table: &Table) -> Grid {
    let mut words = Words::default();
    let columns = shown(table).into_iter().map(|(_, column)| GridColumn {
        name: column.name.clone(),
        heading: heading(column),
        meaning: "",
        kind: if column.align == Align::Right { GridKind::Number } else { GridKind::Text },
        decimals: 0,
        detail: false,
    });
    let columns = columns.collect();
    let mut datum = |place: usize, view: CellView, row: &TableRow| match view {
        CellView { text, .. } if place == 0 && !row.marks.is_empty() => {
            words.place(&format!("{text} [{}]", row.marks.join(", ")))
        }
        CellView { text, is_number: true } if !text.is_empty() => Datum::Shown(text),
        CellView { text, .. } => words.place(&text),
    };
    let rows = table.rows.iter().map(|row| {
        let cells = texts(table, row).into_iter().enumerate();
        cells.map(|(place, view)| datum(place, view, row)).collect()
    });
    let rows = rows.collect();
    Grid { columns, rows, words: words.into_list() }
}
