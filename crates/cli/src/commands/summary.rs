//! What a run did and what it lost, at its end.

use std::fmt::Write as _;
use std::io;
use std::path::Path;

use model::{Problem, SessionStatus};

use super::tell;
use crate::logging::LogFormat;

/// More kinds of problems than this are counted, not listed; all are in the results file.
const KINDS_LISTED: usize = 20;

/// Tells on stderr, or as an event of the log where that is JSON (each problem has been one already).
pub fn tell_summary(sessions: &[SessionStatus], files: &[&Path], format: LogFormat) -> io::Result<()> {
    let count = |count: fn(&SessionStatus) -> usize| sessions.iter().map(count).sum::<usize>();
    let (failed, images) = (count(|s| usize::from(s.failed)), count(|s| s.images));
    let (with_pose, selected, sizes) = (count(|s| s.with_pose), count(|s| s.selected), count(|s| s.sizes));
    if format == LogFormat::Json {
        let files: Vec<_> = files.iter().map(|file| file.display().to_string()).collect();
        tracing::info!(sessions = sessions.len(), failed, images, with_pose, selected, sizes, ?files, "finished");
        return Ok(());
    }
    let mut text = format!(
        "{} sessions ({failed} failed), {images} images, {with_pose} with a pose, {selected} selected, {sizes} sizes\n",
        sessions.len(),
    );
    text.push_str(&problems(sessions));
    for file in files {
        let _ = writeln!(text, "wrote {}", file.display());
    }
    tell(&text)
}

/// Problems of one kind together, those of failed sessions first.
fn problems(sessions: &[SessionStatus]) -> String {
    let mut kinds: Vec<Vec<(&SessionStatus, &Problem)>> = Vec::new();
    let in_order = |failed: bool| sessions.iter().filter(move |session| session.failed == failed);
    for session in in_order(true).chain(in_order(false)) {
        for problem in &session.problems {
            match kinds.iter_mut().find(|kind| (kind[0].1.stage, &kind[0].1.code) == (problem.stage, &problem.code)) {
                Some(kind) => kind.push((session, problem)),
                None => kinds.push(vec![(session, problem)]),
            }
        }
    }
    let mut text = String::new();
    for kind in kinds.iter().take(KINDS_LISTED) {
        let (session, problem) = kind[0];
        let lost = if session.failed { " (session lost)" } else { "" };
        let _ = writeln!(
            text,
            "{}{lost} [{}] {}: {}\n    {}",
            session.session, problem.stage, problem.code, problem.place, problem.fact
        );
        if kind.len() > 1 {
            let _ = writeln!(text, "    and {} more of this kind", kind.len() - 1);
        }
        let _ = writeln!(text, "    -> {}", problem.remedy);
    }
    let listed = kinds.len().min(KINDS_LISTED);
    if kinds.len() > listed || kinds.iter().any(|kind| kind.len() > 1) {
        text.push_str("all of them: -v, or the metadata aim_batch.run of the results (docs/results.md)\n");
    }
    text
}
