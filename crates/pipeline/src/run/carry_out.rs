//! Makes the plans of sessions and carries them out, several at a time.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use ingest::ByteBudget;

use super::plan::{RunContext, SessionPlan};
use super::tally::Tally;
use super::worker::{SessionDone, Worker};
use super::{Halted, RunOptions};
use crate::parallel::in_parallel;
use crate::reporter::Reporter;
use crate::study::SessionDir;
use crate::work::WorkFolder;

/// A batch of sessions that are run together, and what they share.
pub(super) struct Batch<'a> {
    pub context: &'a RunContext<'a>,
    pub work: &'a WorkFolder,
    pub options: &'a RunOptions,
    pub reporter: &'a dyn Reporter,
}

impl<'a> Batch<'a> {
    /// The plans for the sessions. What an earlier run has kept does not count when everything is to be done again.
    pub fn plan(&self, dirs: &[&'a SessionDir]) -> Result<Vec<SessionPlan<'a>>, Halted> {
        let kept = if self.options.force { BTreeMap::new() } else { self.work.state.kept_by_session()? };
        let plans = in_parallel(dirs, self.options.jobs, |dir| {
            let kept = kept.get(&dir.name).cloned().unwrap_or_default();
            self.context.plan(dir, kept, Some(&self.work.state), &self.work.mcap(&dir.name))
        })?;
        Ok(plans)
    }

    /// Carries the plans out. What is done is kept, whatever comes after.
    pub fn carry_out(&self, plans: &[SessionPlan<'a>]) -> Result<Tally, Halted> {
        let (current, to_do): (Vec<_>, Vec<_>) = plans.iter().partition(|plan| plan.current.all());
        let stop = &self.options.stop;
        let budget = ByteBudget::new(self.options.image_memory_bytes);
        let worker = Worker {
            context: self.context,
            work: self.work,
            force: self.options.force,
            stop,
            budget: &budget,
            reporter: self.reporter,
        };
        let halted: Mutex<Option<Halted>> = Mutex::new(None);
        let done = in_parallel(&to_do, self.options.jobs, |plan| {
            if stop.is_set() {
                return None;
            }
            let done = worker.run(plan).and_then(|done| self.unless_failed(done));
            done.unwrap_or_else(|reason| {
                stop.set();
                halted.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(reason);
                None
            })
        })?;
        let done: Vec<SessionDone> = done.into_iter().flatten().collect();
        if let Some(halted) = halted.into_inner().unwrap_or_else(PoisonError::into_inner) {
            return Err(halted);
        }
        match stop.signal() {
            Some(signal) => {
                let (done, sessions) = (current.len() + done.len(), plans.len());
                Err(Halted::Stopped { signal, done, sessions })
            }
            None => Ok(Tally::new(&current, done)),
        }
    }

    /// Reports that a session is done; an error where it failed and the run is to stop then.
    fn unless_failed(&self, done: Option<SessionDone>) -> Result<Option<SessionDone>, Halted> {
        let Some(done) = done else { return Ok(None) };
        self.reporter.done(&done.status);
        match done.status.problems.first() {
            Some(problem) if done.status.failed && self.options.fail_fast => {
                let session = done.status.session.clone();
                Err(Halted::FailFast { session, problem: Box::new(problem.clone()) })
            }
            _ => Ok(Some(done)),
        }
    }
}
