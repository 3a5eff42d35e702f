//! Makes tables from results.

mod accuracy;
mod agreement;
mod bands;
mod errors;
mod flow;
mod footnotes;
mod left_out;
mod methods;
mod printed;
mod raters;
mod select;
mod setups;
mod sizes;

use model::{TableLayout, TableSpec};

pub use accuracy::accuracy;
pub use agreement::rater_agreement;
pub use bands::{error_by_height, error_by_pitch};
pub(crate) use bands::{height_band_cm, pitch_band_deg};
pub(crate) use flow::step_heading;
pub use flow::{flow, flow_in_short};
pub use left_out::left_out;
pub use methods::methods;
pub use sizes::sizes;

pub(crate) use errors::row_error_pct;

use crate::parquet::Results;
use crate::table::{Column, Table};
use footnotes::NotedRow;

/// The tables that the study asks for, in its order.
#[must_use]
pub fn tables(results: &Results) -> Vec<Table> {
    results
        .metadata
        .tables
        .iter()
        .map(|spec| match spec.layout {
            TableLayout::Setups => setups::table(spec, results),
            TableLayout::Raters => raters::table(spec, results),
        })
        .collect()
}

/// Puts a table together from the columns and rows of its layout.
fn assemble(spec: &TableSpec, results: &Results, statistic: &str, columns: Vec<Column>, rows: Vec<NotedRow>) -> Table {
    let (rows, footnotes) = footnotes::mark(rows);
    let mut remarks = Vec::new();
    if let Some(printed) = &spec.printed {
        remarks.push(format!("Printed: {}.", printed.source.trim_end_matches('.')));
    }
    Table {
        stem: format!("table_{}", spec.id),
        label: Some(format!("Table {}", spec.id)),
        title: spec.title.clone(),
        statistic: format!(
            "Error: 100 (predicted - original) / original, signed. {statistic} Method: {}.",
            spec.method
        ),
        columns,
        rows,
        footnotes,
        remarks,
        statement: results.metadata.statement.clone(),
    }
}
