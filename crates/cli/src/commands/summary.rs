//! The summary at the end of a run: its work, its losses and its files.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use model::{ProblemCode, SessionStatus, StageLog};
use pipeline::Ran;

use super::print_message;
use super::problems::{Kind, describe, kinds};
use crate::logging::LogFormat;

/// Number of kinds of problems that are listed, so that the summary fits on a screen. The results file has all of them.
const KINDS_LISTED: usize = 5;

/// A run that has finished.
pub struct Finished<'a> {
    pub ran: &'a Ran,
    pub files: &'a [PathBuf],
    pub work_dir: &'a Path,
}

/// Writes the summary to stderr, or as one event of the log where the log is JSON (each problem has been an event already).
pub fn print_summary(finished: &Finished<'_>, format: LogFormat) {
    let Ran { sessions, done, wrote, stages, seconds } = finished.ran;
    let count = |count: fn(&SessionStatus) -> usize| sessions.iter().map(count).sum::<usize>();
    let (failed, images) = (count(|s| usize::from(s.failed)), count(|s| s.images));
    let (with_pose, selected, sizes) = (count(|s| s.with_pose), count(|s| s.selected), count(|s| s.sizes));
    if format == LogFormat::Json {
        let files: Vec<_> = finished.files.iter().map(|file| file.display().to_string()).collect();
        let sessions = sessions.len();
        tracing::info!(
            sessions,
            done,
            failed,
            images,
            with_pose,
            selected,
            sizes,
            wrote,
            seconds,
            ?stages,
            ?files,
            "finished"
        );
        return;
    }
    let mut text = format!(
        "{} sessions ({failed} failed), {images} images, {with_pose} with a pose, {selected} selected, {sizes} sizes\n",
        sessions.len(),
    );
    text.push_str(&problems(sessions));
    text.push_str(&work(finished.ran));
    let verb = if *wrote { "wrote" } else { "nothing to do: unchanged" };
    for file in finished.files {
        let _ = writeln!(text, "{verb} {}", file.display());
    }
    let _ = writeln!(text, "work folder {}", finished.work_dir.display());
    print_message(&text);
}

/// A line with the seconds of the run and of each stage.
fn work(ran: &Ran) -> String {
    let of_stage = |stage: &StageLog| {
        let StageLog { stage, done, kept, failed, seconds } = stage;
        let failed = if *failed > 0 { format!(", {failed} failed") } else { String::new() };
        match done {
            0 => format!("{stage} kept{failed}"),
            done => format!("{stage} {seconds:.1} s ({done} done, {kept} kept{failed})"),
        }
    };
    let stages: Vec<String> = ran.stages.iter().map(of_stage).collect();
    format!("{:.1} s in all; {}\n", ran.seconds, stages.join(", "))
}

/// The problems as text, those of one kind together and those of failed sessions first.
fn problems(sessions: &[SessionStatus]) -> String {
    let in_order = |failed: bool| sessions.iter().filter(move |session| session.failed == failed);
    let labelled = |session: &'_ SessionStatus| {
        let label = format!("{}{}", session.session, if session.failed { " (session lost)" } else { "" });
        move |problem| (label.clone(), problem)
    };
    let all = in_order(true).chain(in_order(false));
    let kinds = kinds(all.flat_map(|session| session.problems.iter().map(labelled(session))));
    let mut text = String::new();
    // Sizes that disagree are always listed: they are answers, and others would be taken for as good.
    let is_listed = |(i, kind): &(usize, &Kind<'_>)| *i < KINDS_LISTED || kind[0].1.code == ProblemCode::SizesDisagree;
    let listed: Vec<&Kind<'_>> = kinds.iter().enumerate().filter(is_listed).map(|(_, kind)| kind).collect();
    listed.iter().for_each(|kind| describe(&mut text, "", kind));
    let listed = listed.len();
    if kinds.len() > listed || kinds.iter().any(|kind| kind.len() > 1) {
        text.push_str("all of them: -v, or the metadata aim_batch.run of the results (docs/results.md)\n");
    }
    text
}
