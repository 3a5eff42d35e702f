//! The table `rater_agreement`: how closely raters agree.

use std::collections::{BTreeMap, BTreeSet};

use model::validation::agreement as icc;
use model::{Level, Method, Quantity};

use crate::parquet::Results;
use crate::table::{Cell, Column, Format, RowKind, Table, TableRow};

const STATISTIC: &str = "ICC(2,1): two-way random effects, absolute agreement, one rater. SEM: standard error of measurement \
                         of one rater. Targets: objects of sessions that every rater of the row has a fused size of.";

/// Sizes in mm by target (session and object), and then by rater.
type ByTarget<'a> = BTreeMap<(&'a str, &'a str), BTreeMap<&'a str, f64>>;

/// The agreement of raters by quantity and method, from fused sizes.
#[must_use]
pub fn rater_agreement(results: &Results) -> Table {
    let mut ratings: BTreeMap<(Quantity, Method), ByTarget<'_>> = BTreeMap::new();
    for row in results.rows.iter().filter(|row| row.level == Level::Fused) {
        let Some(size_mm) = row.predicted_mm else { continue };
        let targets = ratings.entry((row.quantity, row.method)).or_default();
        targets.entry((&row.session, &row.object)).or_default().insert(&row.rater, size_mm);
    }
    let rows = ratings.iter().filter_map(|((quantity, method), targets)| table_row(*quantity, *method, targets));
    let key = |name: &str| Column::key(name).headed(name);
    Table {
        stem: "rater_agreement".to_owned(),
        label: None,
        title: "Agreement of raters".to_owned(),
        statistic: STATISTIC.to_owned(),
        columns: vec![
            key("quantity"),
            key("method"),
            Column::result("raters", "").headed("raters"),
            Column::result("targets", "").headed("targets"),
            Column::result("icc_2_1", "").headed("ICC(2,1)").formatted(Format::Decimals(3)),
            Column::result("sem_mm", "mm").headed("SEM"),
        ],
        rows: rows.collect(),
        footnotes: Vec::new(),
        remarks: Vec::new(),
        statement: results.metadata.statement.clone(),
    }
}

/// The row of a quantity and a method; none where no two raters rated the same targets. It is made from that group of raters who
/// rated most targets in common, since a rater who marked one session only would leave nothing in common with the others.
fn table_row(quantity: Quantity, method: Method, targets: &ByTarget<'_>) -> Option<TableRow> {
    let mut rated: BTreeMap<BTreeSet<&str>, Vec<Vec<f64>>> = BTreeMap::new();
    for by_rater in targets.values().filter(|by_rater| by_rater.len() > 1) {
        let raters: BTreeSet<&str> = by_rater.keys().copied().collect();
        rated.entry(raters).or_default().push(by_rater.values().copied().collect());
    }
    let found = rated.values().max_by_key(|ratings| ratings.len()).and_then(|ratings| icc(ratings))?;
    let cells = vec![
        Cell::text(quantity.code()),
        Cell::text(method.code()),
        Cell::Count(found.raters),
        Cell::Count(found.targets),
        Cell::number(Some(found.icc)),
        Cell::number(Some(found.sem)),
    ];
    Some(TableRow { kind: RowKind::Row, label: None, cells, marks: Vec::new() })
}
