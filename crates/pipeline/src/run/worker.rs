//! Takes one session through its stages. What is kept is used, and what is done is kept at once.

use std::cell::Cell;
use std::path::PathBuf;
use std::time::Instant;

use ingest::{ByteBudget, IngestError, Ingested, SessionSource};
use model::{Problem, ProblemCode, SessionLog, SessionStatus, Severity, Stage};

use super::measure::MeasureKeys;
use super::plan::{RunContext, SessionPlan, recording_fingerprint};
use super::{Halted, keys};
use crate::inputs::sha256_of_bytes;
use crate::parallel::unless_panicking;
use crate::reporter::Reporter;
use crate::session::{
    CardProgress, Prepared, Recording, SearchError, failed, finish_status, ingest_problem, read_recording,
};
use crate::stop::Stop;
use crate::work::{KeptStage, StageOutput, WorkError, WorkFolder};

/// The work folder, the budget and the context that all sessions at work share.
pub(super) struct Worker<'a> {
    pub context: &'a RunContext<'a>,
    pub work: &'a WorkFolder,
    pub force: bool,
    pub stop: &'a Stop,
    pub budget: &'a ByteBudget,
    pub reporter: &'a dyn Reporter,
}

/// A session that is done: how it fared, and how long its stages took.
pub(super) struct SessionDone {
    pub status: SessionStatus,
    pub log: SessionLog,
}

/// The reason why a session does not go on.
pub(super) enum Interruption {
    Session(Box<Problem>),
    Halt(Halted),
    Stopped,
}

impl From<Problem> for Interruption {
    fn from(problem: Problem) -> Self {
        Self::Session(Box::new(problem))
    }
}

impl From<SearchError> for Interruption {
    fn from(error: SearchError) -> Self {
        match error {
            SearchError::Stopped => Self::Stopped,
            SearchError::Recording(problem) => Self::Session(problem),
        }
    }
}

impl From<WorkError> for Interruption {
    fn from(error: WorkError) -> Self {
        Self::Halt(error.into())
    }
}

impl From<serde_json::Error> for Interruption {
    fn from(error: serde_json::Error) -> Self {
        Self::Halt(WorkError::from(error).into())
    }
}

impl Worker<'_> {
    /// Runs a session as far as that is needed; none when it was stopped. A session that fails or panics gets a status and a
    /// ledger, and is tried again the next time.
    pub fn run(&self, plan: &SessionPlan<'_>) -> Result<Option<SessionDone>, Halted> {
        let stage = Cell::new(Stage::Study);
        let mut log = SessionLog { session: plan.dir.name.clone(), ..SessionLog::default() };
        let outcome = unless_panicking(plan.dir, &stage, || self.stages(plan, &stage, &mut log));
        let outcome = outcome.unwrap_or_else(|problem| Err(problem.into()));
        match outcome {
            Ok(status) => Ok(Some(SessionDone { status, log })),
            Err(Interruption::Session(problem)) => {
                Ok(Some(SessionDone { status: self.keep_failed(plan, *problem)?, log }))
            }
            Err(Interruption::Halt(halted)) => Err(halted),
            Err(Interruption::Stopped) => Ok(None),
        }
    }

    fn stages(
        &self,
        plan: &SessionPlan<'_>,
        stage: &Cell<Stage>,
        log: &mut SessionLog,
    ) -> Result<SessionStatus, Interruption> {
        // The card is looked at again, since hours may have gone by since the plan was made.
        let prepared = Prepared::new(self.context.study, plan.dir, self.context.program)?;
        self.begin(plan, stage, Stage::Ingest);
        let (ingest_key, changed) = self.ingest(plan, &prepared, log)?;
        let signals_key = keys::signals_key(self.context.study, self.context.program, &ingest_key)?;
        let parts = self.context.measure_parts(plan.dir, &prepared, &signals_key);
        let keys = MeasureKeys {
            fingerprint: parts.fingerprint(plan.dir)?.settled(),
            measure: parts.key(plan.dir)?,
            search: parts.search_key(plan.dir)?,
        };
        let is_kept = |kept: &Option<_>, key: &str| {
            kept.as_ref().is_some_and(|stage: &KeptStage| stage.key == key) && !self.force
        };
        let signals_kept = is_kept(&plan.kept.signals, &signals_key);
        if changed.is_none()
            && signals_kept
            && is_kept(&plan.kept.measure, &keys.measure)
            && let Some(status) = plan.kept.status.clone()
        {
            self.work.state.touch(&plan.dir.name, Stage::Measure, keys.fingerprint.as_deref())?;
            return Ok(status);
        }
        self.begin(plan, stage, Stage::Signals);
        let recording = self.signals(plan, &prepared, &signals_key, signals_kept, log)?;
        self.begin(plan, stage, Stage::Measure);
        self.measure(plan, &prepared, recording, keys, changed, log)
    }

    fn begin(&self, plan: &SessionPlan<'_>, stage: &Cell<Stage>, begun: Stage) {
        stage.set(begun);
        self.reporter.stage(&plan.dir.name, begun);
        #[cfg(debug_assertions)]
        crate::fault::inject(&plan.dir.name, begun);
    }

    /// The key of the recording, and a problem if the card changed while it was read.
    fn ingest(
        &self,
        plan: &SessionPlan<'_>,
        prepared: &Prepared,
        log: &mut SessionLog,
    ) -> Result<(String, Option<Problem>), Interruption> {
        if let (true, Some(kept)) = (plan.current.ingest, &plan.kept.ingest) {
            return Ok((kept.key.clone(), None));
        }
        let source = &prepared.source;
        let refuse = |error: IngestError| ingest_interruption(&plan.dir.name, error);
        let start = Instant::now();
        let before = self.context.fingerprinter.fingerprint(source).map_err(refuse)?;
        let is_mixture = plan.kept.ingest.as_ref().is_some_and(|kept| kept.key.is_empty());
        let ingested = self.ingest_card(source, self.force || is_mixture)?;
        let after = self.context.fingerprinter.fingerprint(source).map_err(refuse)?;
        let seconds = start.elapsed().as_secs_f64();
        // A card that was only hashed, and has not changed, was not ingested.
        log.ingest_s = matches!(ingested, Ingested::Fresh(_)).then_some(seconds);
        let changed = (before.hex() != after.hex()).then(|| changed_while_read(&plan.dir.name));
        match &changed {
            None => self.keep_recording(plan, ingested.key(), before.settled(), seconds)?,
            Some(_) => self.keep_recording(plan, "", None, seconds)?,
        }
        Ok((ingested.key().to_owned(), changed))
    }

    fn keep_recording(
        &self,
        plan: &SessionPlan<'_>,
        key: &str,
        fingerprint: Option<String>,
        seconds: f64,
    ) -> Result<(), WorkError> {
        let output = recording_fingerprint(&self.mcap(plan)).hex();
        let kept = StageOutput { key, fingerprint, seconds, output: &output, status: None };
        self.work.state.keep(&plan.dir.name, Stage::Ingest, &kept).map(|_| ())
    }

    fn ingest_card(&self, source: &SessionSource, anew: bool) -> Result<Ingested, Interruption> {
        let mcap = self.work.mcap(&source.session);
        let progress = CardProgress {
            session: &source.session,
            reporter: self.reporter,
            stop: self.stop,
            budget: Some(self.budget),
        };
        let ingested = if anew {
            ingest::ingest_session(source, &mcap, &progress).map(|summary| Ingested::Fresh(Box::new(summary)))
        } else {
            ingest::ingest_if_changed(source, &mcap, &progress)
        };
        ingested.map_err(|error| ingest_interruption(&source.session, error))
    }

    /// The readings, either kept ones or made from the recording. A damaged recording is made again, once.
    fn signals(
        &self,
        plan: &SessionPlan<'_>,
        prepared: &Prepared,
        key: &str,
        is_kept: bool,
        log: &mut SessionLog,
    ) -> Result<Recording, Interruption> {
        let session = &plan.dir.name;
        if is_kept
            && let Some(text) = self.work.state.output(session, Stage::Signals)?
            && let Ok(recording) = serde_json::from_str(&text)
        {
            return Ok(recording);
        }
        let start = Instant::now();
        let read = || read_recording(self.context.study, &self.mcap(plan), session);
        let recording = match read() {
            Err(problem) if problem.code == ProblemCode::BadMcap => {
                self.ingest_again(plan, prepared, &problem)?;
                read()?
            }
            other => other?,
        };
        let seconds = start.elapsed().as_secs_f64();
        log.signals_s = Some(seconds);
        let output = serde_json::to_string(&recording)?;
        let kept = StageOutput { key, fingerprint: None, seconds, output: &output, status: None };
        self.work.state.keep(session, Stage::Signals, &kept)?;
        Ok(recording)
    }

    /// Makes a damaged recording again from its card.
    pub(super) fn ingest_again(
        &self,
        plan: &SessionPlan<'_>,
        prepared: &Prepared,
        problem: &Problem,
    ) -> Result<(), Interruption> {
        let start = Instant::now();
        tracing::warn!(session = plan.dir.name, "{}; its card is ingested again", problem.fact);
        let ingested = self.ingest_card(&prepared.source, true)?;
        Ok(self.keep_recording(plan, ingested.key(), None, start.elapsed().as_secs_f64())?)
    }

    fn keep_failed(&self, plan: &SessionPlan<'_>, problem: Problem) -> Result<SessionStatus, Halted> {
        let mut output = failed(self.context.study, plan.dir, problem);
        finish_status(&mut output, self.context.study, &self.work.mcap_dir);
        let text = serde_json::to_string(&output).map_err(WorkError::from)?;
        let failed_likewise =
            |kept: &KeptStage| kept.key.is_empty() && kept.output_sha256 == sha256_of_bytes(text.as_bytes());
        if plan.kept.measure.as_ref().is_some_and(failed_likewise) {
            return Ok(output.status); // nothing new to be made durable
        }
        let kept =
            StageOutput { key: "", fingerprint: None, seconds: 0.0, output: &text, status: Some(&output.status) };
        self.work.state.keep(&plan.dir.name, Stage::Measure, &kept)?;
        Ok(output.status)
    }

    pub(super) fn mcap(&self, plan: &SessionPlan<'_>) -> PathBuf {
        self.work.mcap(&plan.dir.name)
    }
}

fn ingest_interruption(session: &str, error: IngestError) -> Interruption {
    match error {
        IngestError::Stopped => Interruption::Stopped,
        error if error.is_of_all_sessions() => Interruption::Halt(Halted::Ingest { error: Box::new(error) }),
        error => ingest_problem(session, &error).into(),
    }
}

fn changed_while_read(session: &str) -> Problem {
    Problem {
        severity: Severity::Loss,
        stage: Stage::Ingest,
        code: ProblemCode::CardChanged,
        place: format!("cards/{session}"),
        fact: "the card's files changed while they were read; what was read may be a mixture".to_owned(),
        remedy: "wait until the card is copied whole, and run again; the session is then read anew".to_owned(),
    }
}
