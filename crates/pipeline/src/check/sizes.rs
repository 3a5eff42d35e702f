//! The sizes that a study would measure, and those that it would not.

use std::collections::BTreeSet;

use model::{
    Kind, Level, Method, Problem, ProblemCode, Quantity, ResultRow, Selection, Severity, Stage, TableLayout, TableSpec,
};

use crate::study::Study;

/// The sort of a size that would be measured.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Measured {
    object: String,
    kind: Kind,
    quantity: Quantity,
    method: Method,
    level: Level,
    selected: bool,
}

impl Measured {
    /// The sort of a row's size; none for a row without a size.
    pub fn from_row(row: &ResultRow) -> Option<Self> {
        row.predicted_mm.map(|_| Self {
            object: row.object.clone(),
            kind: row.kind,
            quantity: row.quantity,
            method: row.method,
            level: row.level,
            selected: row.selected,
        })
    }

    /// Whether a table has a place for it.
    fn fits(&self, table: &TableSpec) -> bool {
        let level = match table.layout {
            TableLayout::Setups => Level::Frame,
            TableLayout::Raters => Level::Fused,
        };
        self.level == level
            && self.method == table.method
            && (table.quantities.is_empty() || table.quantities.contains(&self.quantity))
            && (table.kinds.is_empty() || table.kinds.contains(&self.kind))
            && (table.objects.is_empty() || table.objects.contains(&self.object))
            && (table.selection == Selection::All || self.selected)
    }
}

/// The problems of objects that would get no size, and of tables that would stay empty. They are worth knowing, and no loss
/// of data.
pub(super) fn problems(study: &Study, measured: &BTreeSet<Measured>) -> Vec<Problem> {
    let measured_objects: BTreeSet<&str> = measured.iter().map(|size| size.object.as_str()).collect();
    let objects = study.objects.keys().filter(|object| !measured_objects.contains(object.as_str()));
    let tables = study.tables.iter().filter(|table| !measured.iter().any(|size| size.fits(table)));
    objects.map(|object| never_measured(object)).chain(tables.map(empty_table)).collect()
}

fn never_measured(object: &str) -> Problem {
    note(
        ProblemCode::ObjectNeverMeasured,
        "objects.csv",
        format!("'{object}' has no mark in the study from which a size could be measured"),
        "mark it in at least one picture with a pose, or take it out of objects.csv",
    )
}

fn empty_table(table: &TableSpec) -> Problem {
    let list = |names: Vec<&str>| if names.is_empty() { "any".to_owned() } else { names.join(", ") };
    note(
        ProblemCode::TableStaysEmpty,
        "study.toml",
        format!(
            "no size fits table '{}': kinds {}; objects {}; quantities {}; method {}; selection {}",
            table.id,
            list(table.kinds.iter().map(|kind| kind.code()).collect()),
            list(table.objects.iter().map(String::as_str).collect()),
            list(table.quantities.iter().map(|quantity| quantity.code()).collect()),
            table.method,
            table.selection,
        ),
        "mark what it asks for, or change or remove the table",
    )
}

fn note(code: ProblemCode, place: &str, fact: String, remedy: &str) -> Problem {
    Problem {
        severity: Severity::Note,
        stage: Stage::Study,
        code,
        place: place.to_owned(),
        fact,
        remedy: remedy.to_owned(),
    }
}
