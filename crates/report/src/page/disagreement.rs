//! The table of the fused sizes whose images or raters do not agree.

use model::{Level, Method, ResultRow, Verdict};

use crate::table::{Cell, Column, Format, RowKind, Table, TableRow};

/// More rows than this are not shown; the table of all measurements has them.
const MOST_ROWS: usize = 50;

const STATISTIC: &str = "The sizes behind each of these rows differ by more than their uncertainties allow (chi-square test at the \
                         1 % level). Sigma: standard uncertainty, the disagreement included. Off: what lies more than 3 of its \
                         uncertainties from the others, and counts less or not at all.";

/// The inconsistent rows of levels fused and consensus, by method best where there are such rows; none where all agree.
pub(super) fn table(rows: &[ResultRow]) -> Option<Table> {
    let fused = || rows.iter().filter(|row| row.level != Level::Frame);
    let has_best = fused().any(|row| row.method == Method::Best);
    let counts =
        |row: &&ResultRow| row.consistency == Some(Verdict::Inconsistent) && (!has_best || row.method == Method::Best);
    let rows: Vec<&ResultRow> = fused().filter(counts).collect();
    let more = rows.len().saturating_sub(MOST_ROWS);
    let remark = format!("{more} more are not shown: filter the measurements by consistency.");
    let key = |name: &str| Column::key(name).headed(name);
    let number = |name: &str, heading: &str, unit: &'static str| {
        Column::result(name, unit).headed(heading).formatted(Format::Decimals(1))
    };
    (!rows.is_empty()).then(|| Table {
        stem: "disagreement".to_owned(),
        label: None,
        title: "Sizes that disagree".to_owned(),
        statistic: STATISTIC.to_owned(),
        columns: vec![
            key("session"),
            key("object"),
            key("rater"),
            key("quantity"),
            key("method"),
            number("predicted_mm", "size", "mm"),
            number("sigma_mm", "sigma", "mm"),
            number("spread_mm", "spread", "mm"),
            number("chi_squared", "chi-square", ""),
            Column::result("chi_squared_degrees", "").headed("its degrees"),
            key("off"),
        ],
        rows: rows.iter().take(MOST_ROWS).map(|row| table_row(row)).collect(),
        footnotes: Vec::new(),
        remarks: if more > 0 { vec![remark] } else { Vec::new() },
        statement: None,
    })
}

fn table_row(row: &ResultRow) -> TableRow {
    let off = row.flags.split(',').filter_map(|flag| Some(flag.strip_prefix("outlier")?.split_once(':')?.1));
    let degrees = row.chi_squared_degrees.and_then(|degrees| usize::try_from(degrees).ok()).unwrap_or_default();
    let cells = vec![
        Cell::text(&row.session),
        Cell::text(&row.object),
        Cell::text(&row.rater),
        Cell::text(row.quantity.code()),
        Cell::text(row.method.code()),
        Cell::number(row.predicted_mm),
        Cell::number(row.sigma_mm),
        Cell::number(row.spread_mm),
        Cell::number(row.chi_squared),
        Cell::Count(degrees),
        Cell::text(off.collect::<Vec<_>>().join(", ")),
    ];
    TableRow { kind: RowKind::Row, label: None, cells, marks: Vec::new() }
}
