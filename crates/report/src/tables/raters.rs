//! Layout `raters`: one row per object, one column per rater (Tables V, VI).

use model::{Level, TableSpec};

use super::assemble;
use super::errors::{Summary, error_pct, mean, not_measured, to_cm};
use super::footnotes::{NotedRow, Notes};
use super::printed;
use super::select::{Group, groups, has_several_quantities, raters};
use super::setups::quantity_cell;
use crate::parquet::Results;
use crate::table::{Cell, Column, ROW, RowKind, Table};

const STATISTIC: &str =
    "Error of a row: that of the raters' mean. Overall: mean \u{b1} population SD (n) of the errors of the rows.";

/// A printed truth that is further from the study's truth than this is another one. In mm.
const SAME_TRUTH_MM: f64 = 5e-3;

/// A row before it becomes cells.
struct Line<'a> {
    group: Group<'a>,
    /// The mean over sessions of each rater, in mm.
    by_rater_mm: Vec<Option<f64>>,
    truth_mm: Option<f64>,
    printed_truth_mm: Option<f64>,
    printed_error_pct: Option<f64>,
}

impl<'a> Line<'a> {
    fn new(group: Group<'a>, raters: &[&str], spec: &TableSpec) -> Self {
        let printed = if group.is_first { printed::rows(spec, group.object) } else { Vec::new() };
        let of_rater =
            |rater: &&str| mean(group.rows.iter().filter(|row| row.rater == *rater).map(|row| row.predicted_mm));
        Self {
            by_rater_mm: raters.iter().map(of_rater).collect(),
            truth_mm: mean(group.rows.iter().map(|row| row.truth_mm)),
            printed_truth_mm: printed.iter().find_map(|row| row.truth_mm),
            printed_error_pct: printed.iter().find_map(|row| row.error_pct),
            group,
        }
    }

    fn mean_mm(&self) -> Option<f64> {
        mean(self.by_rater_mm.iter().copied())
    }

    fn error_pct(&self) -> Option<f64> {
        error_pct(self.mean_mm(), self.truth_mm)
    }

    fn is_printed_truth_other(&self) -> bool {
        self.truth_mm.zip(self.printed_truth_mm).is_some_and(|(ours, printed)| (ours - printed).abs() > SAME_TRUTH_MM)
    }
}

pub(super) fn table(spec: &TableSpec, results: &Results) -> Table {
    let groups = groups(spec, &results.rows, Level::Fused);
    let raters = raters(&groups);
    let with_quantity = has_several_quantities(&groups);
    let lines: Vec<Line<'_>> = groups.into_iter().map(|group| Line::new(group, &raters, spec)).collect();
    let with_printed_truth = lines.iter().any(Line::is_printed_truth_other);

    let mut notes = Notes::from_spec(spec);
    let mut rows: Vec<NotedRow> = lines.iter().map(|line| line_row(line, &raters, &mut notes)).collect();
    let errors: Vec<f64> = lines.iter().filter_map(Line::error_pct).collect();
    let ours = Summary::population(&errors);
    rows.push(summary_row(RowKind::Overall, "all: mean \u{b1} SD", ours, &raters, spec, notes.rest()));
    if with_printed_truth {
        let against_printed = lines.iter().filter_map(|line| error_pct(line.mean_mm(), line.printed_truth_mm));
        let ours = Summary::population(&against_printed.collect::<Vec<f64>>());
        let label = "all, against printed truths";
        rows.push(summary_row(RowKind::OverallPrintedTruth, label, ours, &raters, spec, Vec::new()));
    }
    let columns = columns(&raters, with_quantity, with_printed_truth, printed::has_any(spec));
    assemble(spec, results, STATISTIC, columns, rows)
}

fn columns(raters: &[&str], with_quantity: bool, with_printed_truth: bool, with_printed: bool) -> Vec<Column> {
    let mut columns = vec![
        Column::key(ROW),
        Column::key("object").headed("object"),
        Column::key("quantity").headed_if(with_quantity, "quantity"),
    ];
    columns.extend(raters.iter().map(|rater| Column::result(format!("rater_{rater}_cm"), "cm").headed(*rater)));
    columns.extend([
        Column::result("mean_cm", "cm").headed("raters' mean"),
        Column::result("original_cm", "cm").headed("original"),
        Column::result("error_pct", "%").headed("error").with_spread("sd_pct"),
        Column::result("sd_pct", "%"),
        Column::result("n", ""),
        Column::result("printed_original_cm", "cm").headed_if(with_printed_truth, "printed truth"),
        Column::result("printed_error_pct", "%").headed_if(with_printed, "printed error").with_spread("printed_sd_pct"),
        Column::result("printed_sd_pct", "%"),
        Column::note(),
    ]);
    columns
}

fn line_row(line: &Line<'_>, raters: &[&str], notes: &mut Notes<'_>) -> NotedRow {
    let group = &line.group;
    let mut texts = if group.is_first { notes.of_object(group.object) } else { Vec::new() };
    if group.rows.is_empty() {
        texts.push("no fused size by this method in the results: was any marked image selected?".to_owned());
    }
    texts.extend(raters.iter().filter_map(|rater| {
        let of_rater = group.rows.iter().copied().filter(|row| row.rater == *rater);
        not_measured(of_rater).map(|text| format!("{rater}: {text}"))
    }));
    let mut cells = vec![Cell::text(RowKind::Row.code()), Cell::text(group.object), quantity_cell(group.quantity)];
    cells.extend(line.by_rater_mm.iter().map(|size| Cell::number(to_cm(*size))));
    cells.extend([
        Cell::number(to_cm(line.mean_mm())),
        Cell::number(to_cm(line.truth_mm)),
        Cell::number(line.error_pct()),
        Cell::Empty,
        Cell::Count(line.by_rater_mm.iter().flatten().count()),
        Cell::number(to_cm(line.printed_truth_mm)),
        Cell::number(line.printed_error_pct),
        Cell::Empty,
    ]);
    NotedRow { kind: RowKind::Row, label: None, cells, notes: texts }
}

fn summary_row(
    kind: RowKind,
    label: &str,
    ours: Summary,
    raters: &[&str],
    spec: &TableSpec,
    notes: Vec<String>,
) -> NotedRow {
    // The printed overall numbers stand beside our own, whatever truths the publication used.
    let printed = if kind == RowKind::Overall { printed::summary(spec, None) } else { None };
    let mut cells = vec![Cell::text(kind.code())];
    cells.extend(vec![Cell::Empty; 4 + raters.len()]); // object, quantity, raters, their mean, truth
    cells.extend([
        Cell::number(ours.mean),
        Cell::number(ours.sd),
        Cell::Count(ours.n),
        Cell::Empty,
        Cell::number(printed.map(|printed| printed.mean_pct)),
        Cell::number(printed.map(|printed| printed.sd_pct)),
    ]);
    NotedRow { kind, label: Some(format!("{label} (n = {})", ours.n)), cells, notes }
}
