//! Runs all sessions of a study in parallel and hands their rows to a sink. What an earlier run has done is not done again.

mod carry_out;
mod error;
mod keys;
mod measure;
mod options;
mod plan;
mod same_cards;
mod search;
mod status;
mod tally;
mod worker;
mod write;

use std::time::Instant;

use jiff::Timestamp;
use model::{ResultSink, RunLog, SessionStatus, StageLog};

use crate::reporter::{Reporter, Totals};
use crate::study::Study;
use crate::work::WorkFolder;
use carry_out::Batch;
pub use error::{Halted, RunError};
pub use options::RunOptions;
pub(crate) use options::program_and_commit;
pub use plan::Current;
use plan::RunContext;
use same_cards::note_same_cards;
pub use status::{SessionState, StudyState, status};
use write::Writing;

/// The result of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Ran {
    /// How each session fared, in the order of their names, including those that an earlier run did.
    pub sessions: Vec<SessionStatus>,
    /// The number of sessions for which something was done in this run.
    pub done: usize,
    /// Whether results were written. They are not when the files are what would be written.
    pub wrote: bool,
    /// Sessions and seconds by stage.
    pub stages: Vec<StageLog>,
    /// The duration of the run.
    pub seconds: f64,
}

/// Runs every session of a study as far as that is needed, `jobs` at a time, and hands the rows to `sink` in the order of
/// the sessions' names. The rows are the same whether they were made now or kept from an earlier run.
///
/// # Errors
/// [`RunError`] for what concerns the run as a whole; what was done until then is kept. A session that fails is in the
/// statuses returned.
pub fn run<S: ResultSink>(
    study: &Study,
    options: &RunOptions,
    reporter: &dyn Reporter,
    sink: &mut S,
) -> Result<Ran, RunError<S::Error>> {
    let (started_utc, start) = (Timestamp::now().to_string(), Instant::now());
    let work = WorkFolder::open(&options.work_dir, &options.program).map_err(Halted::from)?;
    if options.prune {
        let names: Vec<&str> = study.sessions.iter().map(|dir| dir.name.as_str()).collect();
        work.prune(&names).map_err(Halted::from)?;
    }
    let study_inputs = write::study_inputs(study)?;
    let program = options.program_and_commit();
    let context = RunContext::new(study, &program)?;
    let batch = Batch { context: &context, work: &work, options, reporter };

    let plans = batch.plan(&study.sessions.iter().collect::<Vec<_>>())?;
    reporter.begin(&Totals {
        sessions: plans.len(),
        kept: plans.iter().filter(|plan| plan.current.all()).count(),
        bytes: Some(plans.iter().map(|plan| plan.bytes_to_read).sum()),
    });
    let mut tally = batch.carry_out(&plans)?;
    let writing = Writing { study, options, work: &work, study_inputs };
    let mut wrote = false;
    if !writing.is_done(&sink.files())? {
        let damaged = writing.damaged(&plans)?;
        if !damaged.is_empty() {
            tally.add(batch.carry_out(&batch.plan(&damaged)?)?);
        }
        let log = RunLog { started_utc, ..tally.log(options) };
        note_same_cards(&mut tally.statuses);
        writing.write(&tally.statuses, log, start, sink)?;
        wrote = true;
    } else {
        note_same_cards(&mut tally.statuses);
    }
    Ok(Ran {
        done: tally.logs.len(),
        wrote,
        stages: tally.stages(),
        sessions: tally.statuses.into_values().collect(),
        seconds: start.elapsed().as_secs_f64(),
    })
}
