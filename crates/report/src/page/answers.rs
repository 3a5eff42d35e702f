//! The rows that answer the question of a study: one size per object and rater, by one method.

use std::collections::BTreeMap;

use model::validation::ErrorSummary;
use model::{Kind, Level, Method, Quantity, ResultRow, median};

use crate::table::{Cell, Column, Format, RowKind, Table, TableRow};
use crate::tables::row_error_pct;

/// The fused sizes, or where there are none, those of selected images; by the method best, or where it is missing, by the method
/// that has most sizes.
pub(super) struct Answers<'a> {
    pub(super) method: Method,
    pub(super) level: Level,
    pub(super) rows: Vec<&'a ResultRow>,
}

impl<'a> Answers<'a> {
    /// The answers among all rows; none where no row has a size.
    pub(super) fn from_rows(rows: &'a [ResultRow]) -> Option<Self> {
        let measured = |level| {
            let counts = move |row: &&ResultRow| row.level == level && row.selected && row.predicted_mm.is_some();
            rows.iter().filter(counts).collect::<Vec<_>>()
        };
        let [fused, frames] = [Level::Fused, Level::Frame].map(|level| (level, measured(level)));
        let (level, rows) = if fused.1.is_empty() { frames } else { fused };
        let mut by_method: BTreeMap<Method, Vec<&ResultRow>> = BTreeMap::new();
        rows.into_iter().for_each(|row| by_method.entry(row.method).or_default().push(row));
        let most = || by_method.iter().rev().max_by_key(|(_, rows)| rows.len()).map(|(method, _)| *method);
        let method = if by_method.contains_key(&Method::Best) { Method::Best } else { most()? };
        Some(Self { method, level, rows: by_method.remove(&method)? })
    }

    /// The words for one of these sizes.
    pub(super) fn name(&self) -> &'static str {
        if self.level == Level::Fused { "fused size" } else { "size of a selected image" }
    }

    pub(super) fn errors_pct(&self) -> Vec<f64> {
        errors_pct(&self.rows)
    }

    /// The median of the standard uncertainties, each in per cent of its size.
    pub(super) fn median_sigma_pct(&self) -> Option<f64> {
        median_sigma_pct(&self.rows)
    }

    /// A table of the answers by kind of container and quantity.
    pub(super) fn table(&self) -> Table {
        let mut groups: BTreeMap<(Kind, Quantity), Vec<&ResultRow>> = BTreeMap::new();
        self.rows.iter().for_each(|row| groups.entry((row.kind, row.quantity)).or_default().push(row));
        let with_truth = !self.errors_pct().is_empty();
        let pct = |name: &str, heading: &str| Column::result(name, "%").headed(heading).formatted(Format::Decimals(1));
        let mut columns = vec![
            Column::key("kind").headed("kind"),
            Column::key("quantity").headed("quantity"),
            Column::result("sizes", "").headed("sizes"),
            pct("sigma_pct", "median sigma"),
        ];
        if with_truth {
            columns.push(Column::result("known", "").headed("with true size"));
            columns.extend([pct("bias_pct", "mean error"), pct("sd_pct", "SD"), pct("median_pct", "median |error|")]);
        }
        let row = |((kind, quantity), rows): (&(Kind, Quantity), &Vec<&ResultRow>)| {
            let mut cells = vec![Cell::text(kind.code()), Cell::text(quantity.code()), Cell::Count(rows.len())];
            cells.push(Cell::number(median_sigma_pct(rows)));
            if with_truth {
                cells.extend(error_cells(&errors_pct(rows)));
            }
            TableRow { kind: RowKind::Row, label: None, cells, marks: Vec::new() }
        };
        Table {
            stem: "answers".to_owned(),
            label: None,
            title: "Best answers by kind".to_owned(),
            statistic:
                "Sigma: standard uncertainty in per cent of the size. Error: 100 (predicted - original) / original; \
                        mean and sample SD are of the signed errors."
                    .to_owned(),
            columns,
            rows: groups.iter().map(row).collect(),
            footnotes: Vec::new(),
            remarks: Vec::new(),
            statement: None,
        }
    }
}

fn errors_pct(rows: &[&ResultRow]) -> Vec<f64> {
    rows.iter().filter_map(|row| row_error_pct(row)).collect()
}

fn median_sigma_pct(rows: &[&ResultRow]) -> Option<f64> {
    let of_row = |row: &&ResultRow| Some(100.0 * row.sigma_mm? / row.predicted_mm.filter(|size| *size > 0.0)?);
    let sigmas: Vec<f64> = rows.iter().filter_map(of_row).collect();
    (!sigmas.is_empty()).then(|| median(sigmas))
}

/// The median of the absolute errors, in per cent.
pub(super) fn median_absolute(errors: &[f64]) -> f64 {
    median(errors.iter().map(|error| error.abs()).collect())
}

fn error_cells(errors: &[f64]) -> [Cell; 4] {
    let summary = ErrorSummary::from_errors(errors);
    let summary = summary.as_ref();
    [
        Cell::Count(errors.len()),
        Cell::number(summary.map(|summary| summary.bias)),
        Cell::number(summary.and_then(|summary| summary.sd)),
        Cell::number(summary.map(|_| median_absolute(errors))),
    ]
}
