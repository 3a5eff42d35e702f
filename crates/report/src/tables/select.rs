//! The rows of the results that a table is made from, and the order of its objects.

use std::collections::{BTreeMap, BTreeSet};

use model::{Level, Quantity, ResultRow, Selection, TableSpec};

/// The rows of one object and quantity: a block of the table.
pub(super) struct Group<'a> {
    pub(super) object: &'a str,
    /// None for an object that was asked for or printed, and has no rows at all.
    pub(super) quantity: Option<Quantity>,
    pub(super) rows: Vec<&'a ResultRow>,
    /// Whether it is the object's first group. The numbers that were printed for an object stand beside its first quantity.
    pub(super) is_first: bool,
}

/// The rows of `level` that `spec` asks for.
fn rows_of<'a>(spec: &TableSpec, rows: &'a [ResultRow], level: Level) -> Vec<&'a ResultRow> {
    rows.iter()
        .filter(|row| row.level == level && row.method == spec.method)
        .filter(|row| spec.quantities.is_empty() || spec.quantities.contains(&row.quantity))
        .filter(|row| spec.kinds.is_empty() || spec.kinds.contains(&row.kind))
        .filter(|row| spec.objects.is_empty() || spec.objects.contains(&row.object))
        .filter(|row| spec.selection == Selection::All || row.selected)
        .collect()
}

/// The objects in the order of the table, which is that of the study's list, or else by name. Objects that were printed but
/// have no rows are kept, so that a lost session leaves a visible hole.
fn objects<'a>(spec: &'a TableSpec, rows: &[&'a ResultRow]) -> Vec<&'a str> {
    if spec.objects.is_empty() {
        let printed = spec.printed.iter().flat_map(|printed| &printed.rows).map(|row| row.object.as_str());
        let names: BTreeSet<&str> = rows.iter().map(|row| row.object.as_str()).chain(printed).collect();
        return names.into_iter().collect();
    }
    let mut seen = BTreeSet::new();
    spec.objects.iter().map(String::as_str).filter(|object| seen.insert(*object)).collect()
}

/// The blocks of a table, in order.
pub(super) fn groups<'a>(spec: &'a TableSpec, rows: &'a [ResultRow], level: Level) -> Vec<Group<'a>> {
    let rows = rows_of(spec, rows, level);
    let place = |quantity: Quantity| {
        let listed = spec.quantities.iter().position(|listed| *listed == quantity);
        (listed.unwrap_or(usize::MAX), quantity)
    };
    let mut groups = Vec::new();
    for object in objects(spec, &rows) {
        let mut by_quantity: BTreeMap<(usize, Quantity), Vec<&ResultRow>> = BTreeMap::new();
        for row in rows.iter().filter(|row| row.object == object) {
            by_quantity.entry(place(row.quantity)).or_default().push(row);
        }
        if by_quantity.is_empty() {
            groups.push(Group { object, quantity: None, rows: Vec::new(), is_first: true });
        }
        groups.extend(by_quantity.into_iter().enumerate().map(|(index, ((_, quantity), rows))| Group {
            object,
            quantity: Some(quantity),
            rows,
            is_first: index == 0,
        }));
    }
    groups
}

/// Whether an object has more than one quantity, so that people need to see the column of quantities.
pub(super) fn has_several_quantities(groups: &[Group<'_>]) -> bool {
    groups.iter().any(|group| !group.is_first)
}

/// The raters of a table, by name.
pub(super) fn raters<'a>(groups: &[Group<'a>]) -> Vec<&'a str> {
    let names: BTreeSet<&str> = groups.iter().flat_map(|group| &group.rows).map(|row| row.rater.as_str()).collect();
    names.into_iter().collect()
}
