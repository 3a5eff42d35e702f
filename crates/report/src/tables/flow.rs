//! The table `flow`: the numbers of a session's images that reach each step of the selection.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use model::{Flow, FlowStep, FrameReason, SessionStatus};

use super::footnotes::{NotedRow, mark};
use crate::parquet::Results;
use crate::table::{Cell, Column, ROW, RowKind, Table};

/// Greatest number of sessions that a terminal shows in full.
const SESSIONS_IN_SHORT: usize = 30;
/// Number of sessions that a terminal shows where there are more.
const SESSIONS_SHOWN: usize = 10;

const STATISTIC: &str = "Numbers of images, each a part of the one to its left. Pose: acceleration and range at the \
                         image's time, and an axis that meets the table. Still, and with its pitch in range, an image is \
                         selected: its sizes are fused. With marks, with sizes: of the selected images. Other marks: marked \
                         images that are not selected; where they have a pose they are measured, but not fused.";

/// A session of the study. A lost one has a note, and has no flow where it has no image.
struct Session<'a> {
    name: &'a str,
    flow: Option<Flow>,
    note: Option<String>,
}

/// The flow of every session and of the study; none where the ledger was not read ([`Results::read_flow`]).
#[must_use]
pub fn flow(results: &Results) -> Option<Table> {
    let total = results.flow.as_ref()?.total();
    Some(table(results, &sessions(results), &total))
}

/// The table [`flow`] for a terminal. Of many sessions it has those with the smallest shares of selected images, in that order.
#[must_use]
pub fn flow_in_short(results: &Results) -> Option<Table> {
    let mut sessions = sessions(results);
    let total = results.flow.as_ref()?.total();
    if sessions.len() <= SESSIONS_IN_SHORT {
        return Some(table(results, &sessions, &total));
    }
    sessions.sort_by(|a, b| least_kept_first(a, b));
    let mut table = table(results, &sessions[..SESSIONS_SHOWN], &total);
    table.remarks.push(format!(
        "{SESSIONS_SHOWN} of {} sessions: those with the smallest share of their images selected. flow.csv, which \
         --report and 'aim-batch report -o' write, has all.",
        sessions.len(),
    ));
    Some(table)
}

/// The order of two sessions: lost ones and those without images come first, and then those with the smallest share selected.
fn least_kept_first(a: &Session<'_>, b: &Session<'_>) -> Ordering {
    let [a_pct, b_pct] = [a, b].map(|session| session.flow.as_ref().and_then(Flow::selected_pct).unwrap_or(-1.0));
    a_pct.total_cmp(&b_pct).then_with(|| a.name.cmp(b.name))
}

/// All sessions of the run by name, with images and without.
fn sessions(results: &Results) -> Vec<Session<'_>> {
    let statuses = &results.metadata.sessions;
    let mut sessions: BTreeMap<&str, Session<'_>> =
        statuses.iter().map(|status| (status.session.as_str(), without_images(status))).collect();
    for (name, flow) in results.flow.iter().flat_map(model::StudyFlow::sessions) {
        let note = sessions.remove(name).and_then(|session| session.note);
        sessions.insert(name, Session { name, flow: Some(flow.clone()), note });
    }
    sessions.into_values().collect()
}

fn without_images(status: &SessionStatus) -> Session<'_> {
    let name = &status.session;
    if !status.failed {
        return Session { name, flow: Some(Flow::default()), note: None };
    }
    let code = status.problems.last().map_or("failed", |problem| problem.code.code());
    let note = format!("nothing of this session could be used ({code})");
    Session { name, flow: None, note: Some(note) }
}

fn table(results: &Results, sessions: &[Session<'_>], total: &Flow) -> Table {
    let rows = sessions.iter().map(|session| NotedRow {
        kind: RowKind::Row,
        label: None,
        cells: cells(RowKind::Row, session.name, session.flow.as_ref()),
        notes: session.note.iter().cloned().collect(),
    });
    let whole = NotedRow {
        kind: RowKind::Overall,
        label: Some("whole study".to_owned()),
        cells: cells(RowKind::Overall, "", Some(total)),
        notes: Vec::new(),
    };
    let (rows, footnotes) = mark(rows.chain([whole]).collect());
    Table {
        stem: "flow".to_owned(),
        label: None,
        title: "Flow of images".to_owned(),
        statistic: STATISTIC.to_owned(),
        columns: columns(total),
        rows,
        footnotes,
        remarks: Vec::new(),
        statement: results.metadata.statement.clone(),
    }
}

/// The heading of a step. It is narrow, since eight columns of numbers must stand beside the names of sessions in a terminal.
pub(crate) const fn step_heading(step: FlowStep) -> &'static str {
    match step {
        FlowStep::Found => "found",
        FlowStep::Readable => "can be read",
        FlowStep::WithPose => "with pose",
        FlowStep::Still => "still",
        FlowStep::Selected => "pitch in range",
        FlowStep::Marked => "with marks",
        FlowStep::Measured => "with sizes",
    }
}

/// The columns of the table. CSV also has the selected share and the number of images that each reason leaves out. Where every
/// image can be read, people do not see the column of readable images.
fn columns(total: &Flow) -> Vec<Column> {
    let all_readable = total.images_at(FlowStep::Readable) == total.images_at(FlowStep::Found);
    let mut columns = vec![Column::key(ROW), Column::key("session").headed("session")];
    columns.extend(FlowStep::ALL.iter().map(|step| {
        let is_shown = *step != FlowStep::Readable || !all_readable;
        Column::result(step.code(), "").headed_if(is_shown, step_heading(*step))
    }));
    columns.push(Column::result("other_marked", "").headed("other marks"));
    columns.push(Column::result("other_measured", ""));
    columns.push(Column::result("selected_pct", "%"));
    columns.extend(left_out_by().map(|reason| Column::result(reason.code(), "")));
    columns.push(Column::note());
    columns
}

fn left_out_by() -> impl Iterator<Item = FrameReason> {
    FrameReason::ALL.iter().copied().filter(|reason| reason.ends().is_some())
}

/// The cells of a row without the last one, which has the notes.
fn cells(kind: RowKind, session: &str, flow: Option<&Flow>) -> Vec<Cell> {
    let count = |count: &dyn Fn(&Flow) -> usize| flow.map_or(Cell::Empty, |flow| Cell::Count(count(flow)));
    let mut cells = vec![Cell::text(kind.code()), if session.is_empty() { Cell::Empty } else { Cell::text(session) }];
    cells.extend(FlowStep::ALL.iter().map(|step| count(&|flow| flow.images_at(*step))));
    cells.push(count(&|flow| flow.not_selected().marked));
    cells.push(count(&|flow| flow.not_selected().measured));
    cells.push(Cell::number(flow.and_then(Flow::selected_pct)));
    cells.extend(left_out_by().map(|reason| count(&|flow| flow.with_reason(reason).images)));
    cells
}
