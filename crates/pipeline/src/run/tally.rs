//! Counts what a run did.

use std::collections::BTreeMap;

use model::{RunLog, SessionLog, SessionStatus, Stage, StageLog};

use super::RunOptions;
use super::plan::{SessionPlan, statuses};
use super::worker::SessionDone;
use crate::parallel::jobs_or_default;

/// The statuses and times of the sessions of a run.
pub(super) struct Tally {
    /// How each session fared, including those that an earlier run did.
    pub statuses: BTreeMap<String, SessionStatus>,
    /// The stages that were done, and how long they took, by session.
    pub logs: Vec<SessionLog>,
}

impl Tally {
    /// The tally of a batch; `current` holds the sessions for which nothing was done.
    pub fn new(current: &[&SessionPlan<'_>], done: Vec<SessionDone>) -> Self {
        let mut tally = Self { statuses: statuses(current), logs: Vec::new() };
        for SessionDone { status, log } in done {
            tally.statuses.insert(status.session.clone(), status);
            tally.logs.extend(Some(log).filter(|log| log.ingest_s.or(log.signals_s).or(log.measure_s).is_some()));
        }
        tally
    }

    /// Adds a later batch, whose statuses count.
    pub fn add(&mut self, later: Self) {
        self.statuses.extend(later.statuses);
        self.logs.extend(later.logs);
    }

    /// The number of sessions and the seconds by stage.
    pub fn stages(&self) -> Vec<StageLog> {
        let stage_log = |stage, seconds: fn(&SessionLog) -> Option<f64>| {
            let all: Vec<f64> = self.logs.iter().filter_map(seconds).collect();
            let did = |session: &str| self.logs.iter().any(|log| log.session == session && seconds(log).is_some());
            let failed = self.statuses.values().filter(|status| status.failed && !did(&status.session)).count();
            let kept = self.statuses.len() - all.len() - failed;
            StageLog { stage, done: all.len(), kept, failed, seconds: all.iter().sum() }
        };
        vec![
            stage_log(Stage::Ingest, |log| log.ingest_s),
            stage_log(Stage::Signals, |log| log.signals_s),
            stage_log(Stage::Measure, |log| log.measure_s),
        ]
    }

    /// The log that is written beside the results, in run.json.
    pub fn log(&self, options: &RunOptions) -> RunLog {
        let mut sessions = self.logs.clone();
        sessions.sort_by(|a, b| a.session.cmp(&b.session));
        RunLog {
            jobs: jobs_or_default(options.jobs).get(),
            image_memory_bytes: options.image_memory_bytes,
            stages: self.stages(),
            sessions,
            ..RunLog::default()
        }
    }
}
