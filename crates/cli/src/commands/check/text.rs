//! The result of a check, for people.

use std::fmt::Write as _;

use model::{Problem, SessionStatus, Severity};
use pipeline::Checked;

use super::Verdict;
use crate::commands::problems::{describe, kinds};
use crate::commands::{as_wide_as_the_terminal, flow_tables};

/// The result of a check as text: a block for each session that has problems, a block for the study as a whole, the flow of
/// images, and the verdict.
pub fn text(checked: &Checked, results: &::report::Results, with_notes: bool) -> String {
    let mut text = String::new();
    for session in &checked.sessions {
        push_session(&mut text, session, with_notes);
    }
    if !checked.study.is_empty() {
        text.push_str("the study as a whole\n");
        push_problems(&mut text, checked.study.iter());
        text.push('\n');
    }
    text.push_str(&as_wide_as_the_terminal(&flow_tables(results).collect::<Vec<_>>()));
    text.push('\n');
    text.push_str(&verdict(checked, with_notes));
    text
}

fn push_session(text: &mut String, session: &SessionStatus, with_notes: bool) {
    let of_severity = |severity: Severity| session.problems.iter().filter(move |problem| problem.severity == severity);
    let notes = of_severity(Severity::Note).count();
    if of_severity(Severity::Loss).count() == 0 && !(with_notes && notes > 0) {
        return;
    }
    let hidden = match notes {
        0 => String::new(),
        _ if with_notes => String::new(),
        notes => format!(" (and {})", count(notes, "note")),
    };
    let _ = writeln!(text, "{}: {}{hidden}", session.session, Verdict::from_status(session).words());
    push_problems(text, of_severity(Severity::Loss).chain(of_severity(Severity::Note).filter(|_| with_notes)));
    text.push('\n');
}

fn push_problems<'a>(text: &mut String, problems: impl Iterator<Item = &'a Problem>) {
    for kind in kinds(problems.map(|problem| (problem.severity.code().to_owned(), problem))) {
        describe(text, "  ", &kind);
    }
}

fn verdict(checked: &Checked, with_notes: bool) -> String {
    let sessions = &checked.sessions;
    let sum = |number: fn(&SessionStatus) -> usize| sessions.iter().map(number).sum::<usize>();
    let (images, with_pose) = (sum(|session| session.images), sum(|session| session.with_pose));
    let (selected, sizes) = (sum(|session| session.selected), sum(|session| session.sizes));
    let mut text = format!("{images} images, {with_pose} with a pose, {selected} selected, {sizes} sizes\n");
    let verdicts: Vec<String> = [Verdict::Whole, Verdict::LosesData, Verdict::Fails]
        .into_iter()
        .map(|verdict| (verdict, verdict.count(sessions)))
        .filter(|(_, count)| *count > 0)
        .map(|(verdict, count)| format!("{count} {}", verdict.words()))
        .collect();
    let _ = writeln!(text, "{}: {}", count(sessions.len(), "session"), verdicts.join(", "));
    let notes = sum(|session| session.problems.iter().filter(|problem| problem.severity == Severity::Note).count());
    if notes > 0 && !with_notes {
        let _ = writeln!(text, "{} not shown: --notes", count(notes, "note"));
    }
    text
}

fn count(n: usize, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}
