//! The table `methods`: methods compared with each other, on the same marks.

use std::collections::BTreeMap;

use model::validation::paired;
use model::{Kind, Level, Method, Quantity, ResultRow};

use super::errors::row_error_pct;
use crate::parquet::Results;
use crate::table::{Cell, Column, RowKind, Table, TableRow};

const STATISTIC: &str = "Difference: mean of |error of the first| - |error of the second|, in per cent of the true sizes, on sizes \
                         that both measured; positive where the second is better. Interval: 95 %, bootstrap of whole objects. \
                         t: Student's, paired.";

const DRAWS: usize = 1000;
const SEED: u64 = 21;

/// The thing that both methods of a pair measured: session, image, object and rater.
type Place<'a> = (&'a str, Option<&'a str>, &'a str, &'a str);

/// Errors in per cent by place, and then by method.
type ByPlace<'a> = BTreeMap<Place<'a>, BTreeMap<Method, f64>>;

/// The comparison of every pair of methods, by level, kind and quantity.
#[must_use]
pub fn methods(results: &Results) -> Table {
    let mut errors: BTreeMap<(Level, Kind, Quantity), ByPlace<'_>> = BTreeMap::new();
    for row in &results.rows {
        let Some(error) = row_error_pct(row) else { continue };
        let places = errors.entry((row.level, row.kind, row.quantity)).or_default();
        places.entry(place(row)).or_default().insert(row.method, error);
    }
    let mut rows = Vec::new();
    for ((level, kind, quantity), places) in &errors {
        for (i, first) in Method::ALL.iter().enumerate() {
            rows.extend(Method::ALL[i + 1..].iter().filter_map(|second| {
                let key = [level.code(), kind.code(), quantity.code(), first.code(), second.code()];
                table_row(key, places, *first, *second)
            }));
        }
    }
    let mut columns: Vec<Column> =
        ["level", "kind", "quantity", "first", "second"].map(|name| Column::key(name).headed(name)).into();
    columns.push(Column::result("n", "").headed("n"));
    columns.push(Column::result("difference_pct", "%").headed("difference"));
    columns.push(Column::result("low_pct", "%").headed("from"));
    columns.push(Column::result("high_pct", "%").headed("to"));
    columns.push(Column::result("t", "").headed("t"));
    Table {
        stem: "methods".to_owned(),
        label: None,
        title: "Methods against each other".to_owned(),
        statistic: STATISTIC.to_owned(),
        columns,
        rows,
        footnotes: Vec::new(),
        remarks: Vec::new(),
        statement: results.metadata.statement.clone(),
    }
}

fn place(row: &ResultRow) -> Place<'_> {
    (&row.session, row.image.as_deref(), &row.object, &row.rater)
}

fn table_row(key: [&str; 5], places: &ByPlace<'_>, first: Method, second: Method) -> Option<TableRow> {
    let mut clusters: BTreeMap<&str, Vec<(f64, f64)>> = BTreeMap::new();
    for ((_, _, object, _), by_method) in places {
        if let (Some(a), Some(b)) = (by_method.get(&first), by_method.get(&second)) {
            clusters.entry(object).or_default().push((*a, *b));
        }
    }
    let found = paired(&clusters.into_values().collect::<Vec<_>>(), DRAWS, SEED)?;
    let mut cells: Vec<Cell> = key.map(Cell::text).into();
    cells.push(Cell::Count(found.n));
    let numbers = [Some(found.mean_difference), found.interval.map(|i| i.low), found.interval.map(|i| i.high), found.t];
    cells.extend(numbers.map(Cell::number));
    Some(TableRow { kind: RowKind::Row, label: None, cells, marks: Vec::new() })
}
