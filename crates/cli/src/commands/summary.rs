//! What a run did and what it lost, at its end.

use std::fmt::Write as _;
use std::io;
use std::path::Path;

use model::SessionStatus;

use super::problems::{describe, kinds};
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
    let in_order = |failed: bool| sessions.iter().filter(move |session| session.failed == failed);
    let labelled = |session: &'_ SessionStatus| {
        let label = format!("{}{}", session.session, if session.failed { " (session lost)" } else { "" });
        move |problem| (label.clone(), problem)
    };
    let all = in_order(true).chain(in_order(false));
    let kinds = kinds(all.flat_map(|session| session.problems.iter().map(labelled(session))));
    let mut text = String::new();
    kinds.iter().take(KINDS_LISTED).for_each(|kind| describe(&mut text, "", kind));
    let listed = kinds.len().min(KINDS_LISTED);
    if kinds.len() > listed || kinds.iter().any(|kind| kind.len() > 1) {
        text.push_str("all of them: -v, or the metadata aim_batch.run of the results (docs/results.md)\n");
    }
    text
}
