//! All sessions of a study in parallel, each by itself: what goes wrong in one never stops the others.

use std::any::Any;
use std::num::NonZeroUsize;
use std::panic::{AssertUnwindSafe, catch_unwind};

use model::{Problem, SessionStatus, Severity, Stage};
use rayon::prelude::*;

use crate::reporter::Reporter;
use crate::session::{SessionOptions, SessionOutput, ledger_of_failed, run_session};
use crate::study::{SessionDir, Study};

/// What `one` makes of each session, `jobs` at a time (none: one per core that this process may use), in the order of the
/// sessions' names.
pub(crate) fn in_parallel<R: Send>(
    study: &Study,
    jobs: Option<NonZeroUsize>,
    reporter: &dyn Reporter,
    one: impl Fn(&SessionDir) -> R + Sync + Send,
) -> Result<Vec<R>, rayon::ThreadPoolBuildError> {
    let jobs = jobs.or_else(|| std::thread::available_parallelism().ok()).map_or(1, NonZeroUsize::get);
    let threads = jobs.min(study.sessions.len()); // a thread without a session is of no use
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.max(1)).build()?;
    reporter.begin(study.sessions.len());
    Ok(pool.install(|| study.sessions.par_iter().map(one).collect()))
}

/// Runs a session; a panic becomes its status, and the other sessions go on.
pub(crate) fn guarded(
    study: &Study,
    dir: &SessionDir,
    options: &SessionOptions,
    reporter: &dyn Reporter,
) -> SessionOutput {
    unless_panicking(dir, || run_session(study, dir, options, reporter)).unwrap_or_else(|problem| {
        let problems = vec![problem];
        let frames = ledger_of_failed(study, dir);
        let (session, images) = (dir.name.clone(), frames.len());
        let status = SessionStatus { session, failed: true, images, problems, ..SessionStatus::default() };
        SessionOutput { status, frames, ..SessionOutput::default() }
    })
}

/// What `work` on a session gives; a panic becomes a problem.
pub(crate) fn unless_panicking<R>(dir: &SessionDir, work: impl FnOnce() -> R) -> Result<R, Problem> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|panic| internal_error(dir, &*panic))
}

fn internal_error(dir: &SessionDir, panic: &(dyn Any + Send)) -> Problem {
    let said = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
    Problem {
        severity: Severity::Loss,
        stage: Stage::Measure,
        code: "internal_error".to_owned(),
        place: format!("cards/{}", dir.name),
        fact: format!("the program failed on this session: {}", said.unwrap_or("no message")),
        remedy: "report it with this message; the other sessions are not affected".to_owned(),
    }
}
