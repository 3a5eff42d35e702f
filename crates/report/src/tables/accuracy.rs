//! The table `accuracy`: errors against true sizes, limits of agreement, and coverage of the stated uncertainties.

use std::collections::{BTreeMap, BTreeSet};

use model::validation::{Coverage, ErrorSummary, Interval, bootstrap, coverage};
use model::{Kind, Level, Method, Quantity, ResultRow};

use super::bands::{height_name, pitch_name};
use super::errors::row_error_pct;
use crate::parquet::Results;
use crate::table::{Cell, Column, Format, RowKind, Table, TableRow};

const STATISTIC: &str = "Errors: 100 (predicted - original) / original, signed, in per cent; SD: sample SD; median: of the \
                         signed errors; q95 and max: of the absolute ones; limits: bias -+ 1.96 SD (Bland and Altman); \
                         68 and 95: per cent of sizes whose stated interval holds the truth, where no assumption is in doubt.";

/// Number of draws of the bootstrap. The seed is fixed, so that a table is the same each time.
const DRAWS: usize = 1000;
const SEED: u64 = 20;

/// The properties that the errors of one row of the table have in common.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Key {
    level: Level,
    kind: Kind,
    quantity: Quantity,
    method: Method,
    /// Index in [`BY`] of the property that groups the rows.
    by: usize,
    group: String,
}

/// The properties by which the rows of the results are grouped.
const BY: [&str; 5] = ["all", "pitch", "height", "object", "rater"];

/// The errors of all sizes with a truth by level, kind, quantity and method: all together, and by band of pitch, band of height
/// of the camera, object and rater.
#[must_use]
pub fn accuracy(results: &Results) -> Table {
    let participants: BTreeSet<&str> = results.rows.iter().filter_map(|row| row.participant.as_deref()).collect();
    let by_participant = participants.len() > 1;
    let mut groups: BTreeMap<Key, Vec<(&ResultRow, f64)>> = BTreeMap::new();
    for row in &results.rows {
        let Some(error) = row_error_pct(row) else { continue };
        for (by, group) in groups_of(row) {
            let key = Key { level: row.level, kind: row.kind, quantity: row.quantity, method: row.method, by, group };
            groups.entry(key).or_default().push((row, error));
        }
    }
    let cluster = if by_participant { "participant" } else { "object" };
    let rows: Vec<TableRow> =
        groups.iter().filter_map(|(key, errors)| table_row(key, errors, by_participant)).collect();
    let empty = "No size has a true size to compare with.".to_owned();
    let about = format!(
        "Intervals of bias and RMSE: 95 %, bootstrap of whole clusters ({cluster}), {DRAWS} draws, seed {SEED}."
    );
    Table {
        stem: "accuracy".to_owned(),
        label: None,
        title: "Accuracy against true sizes".to_owned(),
        statistic: STATISTIC.to_owned(),
        columns: columns(),
        remarks: if rows.is_empty() { vec![empty] } else { vec![about] },
        rows,
        footnotes: Vec::new(),
        statement: results.metadata.statement.clone(),
    }
}

/// The groups that a row belongs to, with the index in [`BY`] of each.
fn groups_of(row: &ResultRow) -> Vec<(usize, String)> {
    let named =
        [Some(String::new()), pitch_name(row), height_name(row), Some(row.object.clone()), Some(row.rater.clone())];
    named.into_iter().enumerate().filter_map(|(by, group)| Some((by, group?))).collect()
}

fn columns() -> Vec<Column> {
    let mut columns: Vec<Column> =
        ["level", "kind", "quantity", "method", "by", "group"].map(|name| Column::key(name).headed(name)).into();
    columns.push(Column::result("n", "").headed("n"));
    for (name, heading) in [
        ("bias_pct", "bias"),
        ("sd_pct", "SD"),
        ("rmse_pct", "RMSE"),
        ("mae_pct", "MAE"),
        ("median_pct", "median"),
        ("q95_absolute_pct", "q95"),
        ("max_absolute_pct", "max"),
        ("limit_low_pct", "limit"),
        ("limit_high_pct", "limit"),
    ] {
        columns.push(Column::result(name, "%").headed(heading));
    }
    for name in ["bias_low_pct", "bias_high_pct", "rmse_low_pct", "rmse_high_pct"] {
        columns.push(Column::result(name, "%"));
    }
    columns.push(Column::result("clusters", ""));
    columns.push(Column::result("claimed", ""));
    for (name, heading) in [("within_68_pct", "68"), ("within_95_pct", "95")] {
        columns.push(Column::result(name, "%").headed(heading).formatted(Format::Decimals(1)));
    }
    columns
}

fn table_row(key: &Key, errors: &[(&ResultRow, f64)], by_participant: bool) -> Option<TableRow> {
    let values: Vec<f64> = errors.iter().map(|(_, error)| *error).collect();
    let summary = ErrorSummary::from_errors(&values)?;
    let clusters = clusters(errors, by_participant);
    let interval = |statistic: fn(&[f64]) -> f64| bootstrap(&clusters, |sample| Some(statistic(sample)), DRAWS, SEED);
    let (of_bias, of_rmse) = (interval(bias), interval(rmse));
    let claimed = claimed(errors);
    let ends = |interval: Option<Interval>| [interval.map(|i| i.low), interval.map(|i| i.high)];
    let share = |of: fn(&Coverage) -> f64| coverage(&claimed).map(|c| 100.0 * of(&c));
    let mut cells = vec![
        Cell::text(key.level.code()),
        Cell::text(key.kind.code()),
        Cell::text(key.quantity.code()),
        Cell::text(key.method.code()),
        Cell::text(BY[key.by]),
        Cell::text(&key.group),
        Cell::Count(summary.n),
    ];
    let numbers = [
        Some(summary.bias),
        summary.sd,
        Some(summary.rmse),
        Some(summary.mae),
        Some(summary.median),
        Some(summary.q95_absolute),
        Some(summary.max_absolute),
        summary.limits.map(|l| l[0]),
        summary.limits.map(|l| l[1]),
    ];
    cells.extend(numbers.into_iter().chain(ends(of_bias)).chain(ends(of_rmse)).map(Cell::number));
    cells.extend([Cell::Count(clusters.len()), Cell::Count(claimed.len())]);
    cells.extend([share(|c| c.within_68), share(|c| c.within_95)].map(Cell::number));
    Some(TableRow { kind: RowKind::Row, label: None, cells, marks: Vec::new() })
}

/// The mean of the errors. It is computed alone, as the RMS below, because a whole [`ErrorSummary`] sorts the errors, which took
/// most of the time of a report when the bootstrap repeated it a thousand times.
#[expect(clippy::cast_precision_loss, reason = "a count of sizes is far below 2^53")]
fn bias(errors: &[f64]) -> f64 {
    errors.iter().sum::<f64>() / errors.len() as f64
}

/// The root mean square of the errors.
#[expect(clippy::cast_precision_loss, reason = "a count of sizes is far below 2^53")]
fn rmse(errors: &[f64]) -> f64 {
    (errors.iter().map(|error| error * error).sum::<f64>() / errors.len() as f64).sqrt()
}

/// The errors, grouped by participant or by object.
fn clusters(errors: &[(&ResultRow, f64)], by_participant: bool) -> Vec<Vec<f64>> {
    let mut clusters: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    for (row, error) in errors {
        let name = if by_participant { row.participant.as_deref().unwrap_or_default() } else { row.object.as_str() };
        clusters.entry(name).or_default().push(*error);
    }
    clusters.into_values().collect()
}

/// The errors and the uncertainties, in mm, of the sizes without a doubt about their method.
fn claimed(errors: &[(&ResultRow, f64)]) -> Vec<(f64, f64)> {
    let of_row = |(row, _): &(&ResultRow, f64)| Some((row.predicted_mm? - row.truth_mm?, row.sigma_mm?));
    errors.iter().filter(|(row, _)| row.doubts.is_empty()).filter_map(of_row).collect()
}
