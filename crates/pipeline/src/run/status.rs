//! The state of a study in a work folder: what is done, and what a run would do.

use std::path::Path;

use ingest::SessionReader;
use model::SessionStatus;

use super::Halted;
use super::options::program_and_commit;
use super::plan::{Current, RunContext};
use crate::parallel::in_parallel;
use crate::session::Prepared;
use crate::study::{SessionDir, Study};
use crate::work::{Holder, Kept, State, recording_of, state_file};

/// The state of a study in a work folder.
#[derive(Debug, Clone, PartialEq)]
pub struct StudyState {
    /// The sessions of the study, by name.
    pub sessions: Vec<SessionState>,
    /// The sessions that the work folder holds and the study no longer has.
    pub removed: Vec<String>,
    /// The run that is at work there now.
    pub holder: Option<Holder>,
}

/// The state of a session.
#[derive(Debug, Clone, PartialEq)]
pub struct SessionState {
    /// The name of the session.
    pub session: String,
    /// The stages that a run would not do again.
    pub current: Current,
    /// The number of bytes of its card that a run would read.
    pub bytes_to_read: u64,
    /// Whether the recording holds the calibration of an earlier camera. Sizes do not depend on it, but viewers show it.
    pub has_old_calibration: bool,
    /// How the session fared when it was last measured.
    pub status: Option<SessionStatus>,
    /// The time at which it was last measured, in UTC.
    pub measured_utc: Option<String>,
}

/// Looks at a study and a work folder, also while a run is at work there. Reads no card and changes nothing.
///
/// # Errors
/// [`Halted`] when the state of the work folder cannot be read.
pub fn status(study: &Study, work_dir: &Path, program: &str, commit: Option<&str>) -> Result<StudyState, Halted> {
    let state = State::open_to_look(&state_file(work_dir))?;
    let mut kept = state.as_ref().map(State::kept_by_session).transpose()?.unwrap_or_default();
    let program = program_and_commit(program, commit);
    let context = RunContext::new(study, &program)?;
    let dirs: Vec<_> = study.sessions.iter().map(|dir| (dir, kept.remove(&dir.name).unwrap_or_default())).collect();
    let sessions = in_parallel(&dirs, None, |(dir, kept): &(_, Kept)| {
        let mcap = recording_of(work_dir, &dir.name);
        let plan = context.plan(dir, kept.clone(), state.as_ref(), &mcap);
        SessionState {
            session: dir.name.clone(),
            current: plan.current,
            bytes_to_read: plan.bytes_to_read,
            has_old_calibration: plan.current.ingest && has_old_calibration(&context, dir, &mcap),
            status: plan.kept.status,
            measured_utc: plan.kept.measure.map(|stage| stage.made_utc),
        }
    })?;
    Ok(StudyState { sessions, removed: kept.into_keys().collect(), holder: Holder::current(work_dir) })
}

fn has_old_calibration(context: &RunContext<'_>, dir: &SessionDir, mcap: &Path) -> bool {
    match (Prepared::new(context.study, dir, context.program), SessionReader::open(mcap)) {
        (Ok(prepared), Ok(reader)) => reader.metadata().camera != prepared.source.camera_spec,
        _ => false,
    }
}
