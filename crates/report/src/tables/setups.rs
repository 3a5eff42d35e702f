//! Layout `setups`: one row per object, bench setup and rater (Tables II-IV).

use model::{Level, PrintedRow, Quantity, ResultRow, Selection, TableSpec};

use super::assemble;
use super::errors::{Summary, error_pct, mean, not_measured, to_cm};
use super::footnotes::{NotedRow, Notes};
use super::printed::{self, Setup};
use super::select::{Group, groups, has_several_quantities, raters};
use crate::parquet::Results;
use crate::table::{Cell, Column, Format, ROW, RowKind, Table};

const STATISTIC: &str = "Per object and overall: mean \u{b1} sample SD (n - 1) of the errors of the rows.";

/// A row before it becomes cells.
struct Line<'a> {
    setup: Option<Setup>,
    rater: &'a str,
    rows: Vec<&'a ResultRow>,
    printed: Option<&'a PrintedRow>,
}

impl Line<'_> {
    fn predicted_mm(&self) -> Option<f64> {
        mean(self.rows.iter().map(|row| row.predicted_mm))
    }

    fn truth_mm(&self) -> Option<f64> {
        mean(self.rows.iter().map(|row| row.truth_mm))
    }

    fn error_pct(&self) -> Option<f64> {
        error_pct(self.predicted_mm(), self.truth_mm())
    }
}

pub(super) fn table(spec: &TableSpec, results: &Results) -> Table {
    let groups = groups(spec, &results.rows, Level::Frame);
    let mut notes = Notes::from_spec(spec);
    let mut rows = Vec::new();
    let mut all_errors = Vec::new();
    for group in &groups {
        let lines = lines(group, spec);
        let errors: Vec<f64> = lines.iter().filter_map(Line::error_pct).collect();
        rows.extend(lines.iter().map(|line| line_row(group, line, &mut notes)));
        rows.push(object_row(group, spec, Summary::sample(&errors), &mut notes));
        all_errors.extend(errors);
    }
    rows.push(overall_row(spec, Summary::sample(&all_errors), &mut notes));
    let columns = columns(has_several_quantities(&groups), raters(&groups).len() > 1, printed::has_any(spec));
    assemble(spec, results, STATISTIC, columns, rows)
}

fn columns(with_quantity: bool, with_rater: bool, with_printed: bool) -> Vec<Column> {
    vec![
        Column::key(ROW),
        Column::key("object").headed("object"),
        Column::key("quantity").headed_if(with_quantity, "quantity"),
        Column::key("rater").headed_if(with_rater, "rater"),
        Column::key("height_cm").numbers("cm").headed("height"),
        Column::key("pitch_deg").numbers("deg").headed("pitch"),
        Column::result("range_mm", "mm").headed("D_tof").formatted(Format::Decimals(0)),
        Column::result("predicted_cm", "cm").headed("predicted"),
        Column::result("original_cm", "cm").headed("original"),
        Column::result("error_pct", "%").headed("error").with_spread("sd_pct"),
        Column::result("sd_pct", "%"),
        Column::result("n", ""),
        Column::result("printed_cm", "cm").headed_if(with_printed, "printed"),
        Column::result("printed_error_pct", "%").headed_if(with_printed, "printed error").with_spread("printed_sd_pct"),
        Column::result("printed_sd_pct", "%"),
        Column::note(),
    ]
}

/// The rows of an object by height, pitch and rater, with the setups that were printed and not measured.
fn lines<'a>(group: &Group<'a>, spec: &'a TableSpec) -> Vec<Line<'a>> {
    let printed = if group.is_first { printed::rows(spec, group.object) } else { Vec::new() };
    let mut lines: Vec<Line<'a>> = Vec::new();
    for row in &group.rows {
        let Some(setup) = Setup::from_nominal(row.setup_height_mm, row.setup_pitch_deg) else { continue };
        match lines.iter_mut().find(|line| line.rater == row.rater && line.setup.is_some_and(|known| known.is(setup))) {
            Some(line) => line.rows.push(row),
            None => lines.push(Line { setup: Some(setup), rater: &row.rater, rows: vec![row], printed: None }),
        }
    }
    for line in &mut lines {
        line.printed = printed.iter().copied().find(|row| is_printed_for(row, line.setup, line.rater));
    }
    // A table of selected frames leaves setups out on purpose. Any other table that lacks one has lost it.
    if spec.selection == Selection::All {
        for row in printed {
            let setup = Setup::from_nominal(row.setup_height_mm, row.setup_pitch_deg);
            if !lines.iter().any(|line| is_printed_for(row, line.setup, line.rater)) {
                let rater = row.rater.as_deref().unwrap_or_default();
                lines.push(Line { setup, rater, rows: Vec::new(), printed: Some(row) });
            }
        }
    }
    if lines.is_empty() {
        lines.push(Line { setup: None, rater: "", rows: Vec::new(), printed: None });
    }
    lines.sort_by(|a, b| {
        let [a_setup, b_setup] = [a, b].map(|line| line.setup.map_or([f64::NAN; 2], |s| [s.height_mm, s.pitch_deg]));
        let by_setup = a_setup[0].total_cmp(&b_setup[0]).then(a_setup[1].total_cmp(&b_setup[1]));
        by_setup.then(a.rater.cmp(b.rater))
    });
    lines
}

fn is_printed_for(row: &PrintedRow, setup: Option<Setup>, rater: &str) -> bool {
    let same_setup = match (Setup::from_nominal(row.setup_height_mm, row.setup_pitch_deg), setup) {
        (Some(printed), Some(measured)) => printed.is(measured),
        _ => false,
    };
    same_setup && row.rater.as_deref().is_none_or(|printed| printed == rater)
}

fn line_row(group: &Group<'_>, line: &Line<'_>, notes: &mut Notes<'_>) -> NotedRow {
    let mut texts = line.setup.map(|setup| notes.of_setup(group.object, setup)).unwrap_or_default();
    if line.rows.is_empty() {
        texts.push("no size of a bench setup by this method in the results".to_owned());
    }
    texts.extend(not_measured(line.rows.iter().copied()));
    let measured = line.rows.iter().filter(|row| row.predicted_mm.is_some()).count();
    let cells = vec![
        Cell::text(RowKind::Row.code()),
        Cell::text(group.object),
        quantity_cell(group.quantity),
        if line.rater.is_empty() { Cell::Empty } else { Cell::text(line.rater) },
        Cell::number(line.setup.map(|setup| setup.height_mm / 10.0)),
        Cell::number(line.setup.map(|setup| setup.pitch_deg)),
        Cell::number(mean(line.rows.iter().map(|row| row.range_mm))),
        Cell::number(to_cm(line.predicted_mm())),
        Cell::number(to_cm(line.truth_mm())),
        Cell::number(line.error_pct()),
        Cell::Empty,
        Cell::Count(measured),
        Cell::number(to_cm(line.printed.and_then(|printed| printed.predicted_mm))),
        Cell::number(line.printed.and_then(|printed| printed.error_pct)),
        Cell::Empty,
    ];
    NotedRow { kind: RowKind::Row, label: None, cells, notes: texts }
}

pub(super) fn quantity_cell(quantity: Option<Quantity>) -> Cell {
    quantity.map_or(Cell::Empty, |quantity| Cell::text(quantity.code()))
}

fn object_row(group: &Group<'_>, spec: &TableSpec, ours: Summary, notes: &mut Notes<'_>) -> NotedRow {
    let texts = if group.is_first { notes.of_object(group.object) } else { Vec::new() };
    let printed = if group.is_first { printed::summary(spec, Some(group.object)) } else { None };
    let label = format!("mean \u{b1} SD (n = {})", ours.n);
    let mut cells =
        vec![Cell::text(RowKind::ObjectMean.code()), Cell::text(group.object), quantity_cell(group.quantity)];
    cells.extend(summary_cells(ours, printed));
    NotedRow { kind: RowKind::ObjectMean, label: Some(label), cells, notes: texts }
}

fn overall_row(spec: &TableSpec, ours: Summary, notes: &mut Notes<'_>) -> NotedRow {
    let label = format!("all: mean \u{b1} SD (n = {})", ours.n);
    let mut cells = vec![Cell::text(RowKind::Overall.code()), Cell::Empty, Cell::Empty];
    cells.extend(summary_cells(ours, printed::summary(spec, None)));
    NotedRow { kind: RowKind::Overall, label: Some(label), cells, notes: notes.rest() }
}

/// The cells of a row of means, from the column `rater` to `printed_sd_pct`.
fn summary_cells(ours: Summary, printed: Option<&model::PrintedSummary>) -> Vec<Cell> {
    let mut cells = vec![Cell::Empty; 6];
    cells.extend([
        Cell::number(ours.mean),
        Cell::number(ours.sd),
        Cell::Count(ours.n),
        Cell::Empty,
        Cell::number(printed.map(|printed| printed.mean_pct)),
        Cell::number(printed.map(|printed| printed.sd_pct)),
    ]);
    cells
}
