//! The table `left_out`: the reasons of the ledger for which images were left out of fused sizes, counted.

use model::{Flow, FlowStep, FrameReason};

use crate::parquet::Results;
use crate::table::{Cell, Column, Format, RowKind, Table, TableRow};

/// The reasons for which images of the study were left out, in the order of the ledger; none where the ledger was not read
/// ([`Results::read_flow`]).
#[must_use]
pub fn left_out(results: &Results) -> Option<Table> {
    let total = results.flow.as_ref()?.total();
    let rows: Vec<TableRow> = FrameReason::ALL.iter().filter_map(|reason| row(*reason, &total)).collect();
    let columns = vec![
        Column::key("reason").headed("reason"),
        Column::key("ends"),
        Column::result("images", "").headed("images"),
        Column::result("share_pct", "%").headed("share").formatted(Format::Decimals(1)),
        Column::result("marked", ""),
        Column::result("measured", ""),
        Column { name: "meaning".to_owned(), ..Column::note() }.headed("meaning"),
    ];
    let (found, left_out) = (total.images_at(FlowStep::Found), total.not_selected().images);
    Some(Table {
        stem: "left_out".to_owned(),
        label: None,
        title: "Why images were left out".to_owned(),
        statistic: format!(
            "{left_out} of the {found} images found are not selected, each for the first reason that applies; share: of \
             the images found.",
        ),
        columns,
        remarks: if rows.is_empty() { vec!["No image was left out.".to_owned()] } else { Vec::new() },
        rows,
        footnotes: Vec::new(),
        statement: results.metadata.statement.clone(),
    })
}

/// The row of a reason; none where it left no image out.
#[expect(clippy::cast_precision_loss, reason = "a count of images is far below 2^53")]
fn row(reason: FrameReason, total: &Flow) -> Option<TableRow> {
    let ends = reason.ends()?;
    let counts = total.with_reason(reason);
    let share_pct = 100.0 * counts.images as f64 / total.images_at(FlowStep::Found) as f64;
    let cells = vec![
        Cell::text(reason.code()),
        Cell::text(ends.code()),
        Cell::Count(counts.images),
        Cell::number(Some(share_pct)),
        Cell::Count(counts.marked),
        Cell::Count(counts.measured),
        Cell::text(reason.meaning()),
    ];
    (counts.images > 0).then_some(TableRow { kind: RowKind::Row, label: None, cells, marks: Vec::new() })
}
