//! The table `sizes`: the fused sizes, which are the purpose of a study without true sizes.

use model::{Level, ResultRow};

use super::errors::row_error_pct;
use crate::parquet::Results;
use crate::table::{Cell, Column, Format, RowKind, Table, TableRow};

const STATISTIC: &str = "Size: robust mean of the selected images of the session, weighted by inverse variance. Sigma: its \
                         predicted standard uncertainty (k = 1). Spread: sample SD between the images.";

/// The fused sizes of every object of every session, by rater, quantity and method.
#[must_use]
pub fn sizes(results: &Results) -> Table {
    let fused: Vec<&ResultRow> = results.rows.iter().filter(|row| row.level == Level::Fused).collect();
    let with_truth = fused.iter().any(|row| row.truth_mm.is_some());
    let key = |name: &str| Column::key(name).headed(name);
    let mm = |name: &str, heading: &str| Column::result(name, "mm").headed(heading).formatted(Format::Decimals(1));
    let columns = vec![
        key("session"),
        key("object"),
        key("rater"),
        key("quantity"),
        key("method"),
        Column::result("images", "").headed("images"),
        mm("predicted_mm", "size"),
        mm("sigma_mm", "sigma"),
        mm("spread_mm", "spread"),
        Column::result("original_mm", "mm").headed_if(with_truth, "original").formatted(Format::Decimals(1)),
        Column::result("error_pct", "%").headed_if(with_truth, "error"),
    ];
    let empty =
        "No selected image is marked, so there is no fused size; frames.parquet tells why images were not selected.";
    Table {
        stem: "sizes".to_owned(),
        label: None,
        title: "Sizes".to_owned(),
        statistic: STATISTIC.to_owned(),
        columns,
        remarks: if fused.is_empty() { vec![empty.to_owned()] } else { Vec::new() },
        rows: fused.into_iter().map(size_row).collect(),
        footnotes: Vec::new(),
        statement: results.metadata.statement.clone(),
    }
}

fn size_row(row: &ResultRow) -> TableRow {
    let cells = vec![
        Cell::text(&row.session),
        Cell::text(&row.object),
        Cell::text(&row.rater),
        Cell::text(row.quantity.code()),
        Cell::text(row.method.code()),
        Cell::Count(usize::try_from(row.frames).unwrap_or(usize::MAX)),
        Cell::number(row.predicted_mm),
        Cell::number(row.sigma_mm),
        Cell::number(row.spread_mm),
        Cell::number(row.truth_mm),
        Cell::number(row_error_pct(row)),
    ];
    TableRow { kind: RowKind::Row, label: None, cells, marks: Vec::new() }
}
