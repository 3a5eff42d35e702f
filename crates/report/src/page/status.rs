//! Tables of the sessions and of their problems.

use model::{Problem, RunMetadata, SessionStatus};

use crate::table::{Align, Cell, Column, Role, RowKind, Table, TableRow};

/// The table of sessions, and the table of problems.
pub(super) fn tables(metadata: &RunMetadata) -> Vec<Table> {
    vec![sessions(metadata), problems(metadata)]
}

fn table(stem: &str, title: &str, statistic: &str, columns: Vec<Column>, rows: Vec<Vec<Cell>>) -> Table {
    let row = |cells| TableRow { kind: RowKind::Row, label: None, cells, marks: Vec::new() };
    Table {
        stem: stem.to_owned(),
        label: None,
        title: title.to_owned(),
        statistic: statistic.to_owned(),
        columns,
        rows: rows.into_iter().map(row).collect(),
        footnotes: Vec::new(),
        remarks: Vec::new(),
        statement: None,
    }
}

fn words(heading: &str) -> Column {
    Column { role: Role::Note, align: Align::Left, ..Column::key(heading).headed(heading) }
}

fn sessions(metadata: &RunMetadata) -> Table {
    let count = |heading: &str| Column::key(heading).headed(heading).numbers("");
    let mut columns = vec![Column::key("session").headed("session"), words("state")];
    columns.extend(["images", "with a pose", "selected", "sizes", "problems"].map(count));
    let row = |status: &SessionStatus| {
        let counts = [status.images, status.with_pose, status.selected, status.sizes, status.problems.len()];
        [Cell::text(&status.session), Cell::text(state(status))].into_iter().chain(counts.map(Cell::Count)).collect()
    };
    let statistic = "Sizes: those of single images and fused ones, by all methods. Failed: nothing of the session could \
                     be used.";
    table("sessions", "Status of every session", statistic, columns, metadata.sessions.iter().map(row).collect())
}

/// The state of a session in words, with a sign that can be told apart without colour.
fn state(status: &SessionStatus) -> &'static str {
    match (status.failed, status.has_losses()) {
        (true, _) => "\u{2715} failed",
        (false, true) => "\u{25b2} lost data",
        (false, false) => "\u{25cf} well",
    }
}

fn problems(metadata: &RunMetadata) -> Table {
    let columns = ["session", "cost", "stage", "code", "place", "fact", "remedy"].map(words).into();
    let row = |session: &str, problem: &Problem| {
        let Problem { severity, stage, code, place, fact, remedy } = problem;
        [session, severity.code(), stage.code(), code.code(), place, fact, remedy].map(Cell::text).into()
    };
    let rows = metadata.sessions.iter().flat_map(|status| status.problems.iter().map(|one| row(&status.session, one)));
    let mut table = table(
        "problems",
        "Problems, each with what to do about it",
        "Cost: a loss is data that could not be used; a note is worth knowing, and nothing was lost by it.",
        columns,
        rows.collect(),
    );
    if table.rows.is_empty() {
        table.remarks.push("No session had a problem.".to_owned());
    }
    table
}
