//! Works on all sessions of a study in parallel, on each by itself: a fault of one never stops the others.

use std::any::Any;
use std::cell::Cell;
use std::num::NonZeroUsize;
use std::panic::{AssertUnwindSafe, catch_unwind};

use model::{Problem, ProblemCode, Severity, Stage};
use rayon::prelude::*;

use crate::study::SessionDir;

/// The number of sessions at a time where none is given: as many as cores that this process may use (by its affinity, its
/// control group's quota, and Slurm's allocation).
#[must_use]
pub fn default_jobs() -> NonZeroUsize {
    let cores = std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
    let of_slurm = std::env::var("SLURM_CPUS_PER_TASK").ok().and_then(|text| text.parse().ok());
    of_slurm.map_or(cores, |given: NonZeroUsize| given.min(cores))
}

pub(crate) fn jobs_or_default(jobs: Option<NonZeroUsize>) -> NonZeroUsize {
    jobs.unwrap_or_else(default_jobs)
}

/// The results of `one` for all items, in their order; `jobs` items are worked on at a time (none: [`default_jobs`]).
pub(crate) fn in_parallel<T: Sync, R: Send>(
    items: &[T],
    jobs: Option<NonZeroUsize>,
    one: impl Fn(&T) -> R + Sync + Send,
) -> Result<Vec<R>, rayon::ThreadPoolBuildError> {
    let threads = jobs_or_default(jobs).get().min(items.len()); // a thread without a session is of no use
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.max(1)).build()?;
    Ok(pool.install(|| items.par_iter().with_max_len(1).map(one).collect()))
}

/// The result of `work` on a session. A panic becomes a problem of the stage in which it came.
pub(crate) fn unless_panicking<R>(
    dir: &SessionDir,
    stage: &Cell<Stage>,
    work: impl FnOnce() -> R,
) -> Result<R, Problem> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|panic| internal_error(dir, stage.get(), &*panic))
}

fn internal_error(dir: &SessionDir, stage: Stage, panic: &(dyn Any + Send)) -> Problem {
    let said = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
    Problem {
        severity: Severity::Loss,
        stage,
        code: ProblemCode::InternalError,
        place: format!("cards/{}", dir.name),
        fact: format!("the program failed on this session: {}", said.unwrap_or("no message")),
        remedy: "report it with this message; the other sessions are not affected".to_owned(),
    }
}
