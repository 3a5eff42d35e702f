//! The sizes of all raters together: each rater's fused size is one share, so that a rater with many images has no more votes.

use std::collections::{BTreeMap, BTreeSet};

use model::{Level, Method, Quantity, ResultRow, Share};

use super::{Key, Members, Row, best_row, in_flag};

/// The rater in rows of level consensus.
const ALL_RATERS: &str = "all";

/// For each object and quantity that two or more raters have sizes of: a row of each method that two or more of them have, and one
/// of method 'best', over the sizes that are the best of each rater.
pub(super) fn rows(of_rater: &BTreeMap<Key<'_>, Vec<Row>>) -> Vec<Vec<Row>> {
    let mut by_size: BTreeMap<(&str, Quantity), Vec<&[Row]>> = BTreeMap::new();
    for ((object, _, quantity), rows) in of_rater {
        by_size.entry((object, *quantity)).or_default().push(rows);
    }
    by_size.into_values().map(|raters| of_size(&raters)).collect()
}

fn of_size(raters: &[&[Row]]) -> Vec<Row> {
    let methods: BTreeSet<Method> = raters.iter().flat_map(|rows| rows.iter().map(|row| row.row.method)).collect();
    let of_method = |method: Method| {
        let rows: Vec<&Row> =
            raters.iter().filter_map(|rows| rows.iter().find(|row| row.row.method == method)).collect();
        consensus(&rows)
    };
    let best: Vec<&Row> = raters.iter().filter_map(|rows| best_row(rows)).collect();
    methods.into_iter().filter_map(of_method).chain(consensus(&best).map(|row| as_best(row, &best))).collect()
}

/// The consensus of the rows of two or more raters; `None` for fewer.
fn consensus(rows: &[&Row]) -> Option<Row> {
    if rows.len() < 2 {
        return None;
    }
    let members = Members {
        rows: rows.iter().map(|row| &row.row).collect(),
        shares: rows.iter().filter_map(|row| share(row)).collect(),
        doubts: rows.iter().flat_map(|row| row.doubts.iter().copied()).collect(),
        shared: rows.iter().map(|row| row.shared.clone()).collect(),
    };
    let all = members.fused(Level::Consensus, |row| format!("outlier_rater:{}", in_flag(&row.rater)))?;
    let pictures: BTreeSet<usize> = all.parts.iter().map(|part| part.picture).collect();
    let frames = u32::try_from(pictures.len()).unwrap_or(u32::MAX);
    Some(Row { row: ResultRow { rater: ALL_RATERS.to_owned(), frames, ..all.row }, ..all })
}

fn share(row: &Row) -> Option<Share> {
    Some(Share {
        value_mm: row.row.predicted_mm?,
        parts: row.parts.clone(),
        disagreement_mm: row.sigma.disagreement_mm,
        penalty: 1.0,
    })
}

/// The consensus of the raters' best sizes. Where these are by different methods, the method that has most of the weight is named,
/// and a flag tells of it.
fn as_best(all: Row, raters: &[&Row]) -> Row {
    let mut by_method: BTreeMap<Method, f64> = BTreeMap::new();
    for (row, weight) in raters.iter().zip(&all.weights) {
        *by_method.entry(row.row.method).or_default() += weight;
    }
    let used = by_method.iter().max_by(|a, b| a.1.total_cmp(b.1)).map(|(method, _)| *method);
    let mixed = (by_method.len() > 1).then_some("mixed_methods");
    let flags: BTreeSet<&str> = all.row.flags.split(',').filter(|flag| !flag.is_empty()).chain(mixed).collect();
    let flags = flags.into_iter().collect::<Vec<_>>().join(",");
    Row { row: ResultRow { method: Method::Best, method_used: used, flags, ..all.row }, ..all }
}
