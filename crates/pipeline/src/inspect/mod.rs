//! Shows the content of a recording as numbers: channels, rates, gaps, clocks, pitch, range and images.
//!
//! Each sensor is streamed once. What is kept does not grow with the recording, apart from its list of images.

mod acceleration;
mod channels;
mod clock;
mod facts;
mod histogram;
mod images;
mod local_time;
mod range;

use std::cell::Cell;
use std::path::Path;

use ingest::{ReadError, SessionReader};
use model::{Problem, ProblemCode, SessionStatus, Severity, Stage};

use crate::parallel::unless_panicking;
use crate::reporter::Reporter;
use crate::session::{Prepared, ingest_without_state, without_host};
use crate::study::{SessionDir, Study};
use crate::survey::{Survey, SurveyError, SurveyOptions};

pub use acceleration::AccelerationFacts;
pub use channels::ExtraFacts;
pub use clock::{Ambiguous, ClockFacts, Gaps, Jump, Jumps, LISTED, Stretches};
pub use facts::{CameraFacts, FileFacts, ProfileFacts, SessionFacts};
pub use histogram::Histogram;
pub use images::{DroppedImages, ImageFacts};
pub use local_time::{LocalSpan, LocalTimeChange, Moment};
pub use range::RangeFacts;

/// The content of the MCAP file of a session. `mount_pitch_deg`: camera pitch minus sensor pitch, if it is not the
/// profile's.
///
/// # Errors
/// [`ReadError`] when the file cannot be read, is damaged, or is not of this program.
pub fn inspect_file(path: &Path, mount_pitch_deg: Option<f64>) -> Result<SessionFacts, ReadError> {
    facts::read(&mut SessionReader::open(path)?, mount_pitch_deg)
}

/// One session of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct Inspected {
    /// The name of the session.
    pub session: String,
    /// The content of its recording, or the problem by which nothing of it can be used.
    pub facts: Result<SessionFacts, Problem>,
}

/// The content of the cards of a study, in the order of the sessions' names. Cards are read whole; what is written goes into
/// a temporary folder.
///
/// # Errors
/// [`SurveyError`] for what concerns all sessions.
pub fn inspect_study(
    study: &Study,
    options: &SurveyOptions,
    reporter: &dyn Reporter,
) -> Result<Vec<Inspected>, SurveyError> {
    let survey = Survey::new(options)?;
    let inspected = survey.for_each_session(study, options.jobs, reporter, |dir| {
        let stage = Cell::new(Stage::Ingest);
        let facts = unless_panicking(dir, &stage, || inspect_session(study, dir, &survey, reporter));
        let facts = facts.and_then(|facts| facts);
        let failed = facts.is_err();
        reporter.done(&SessionStatus { session: dir.name.clone(), failed, ..SessionStatus::default() });
        Inspected { session: dir.name.clone(), facts }
    })?;
    Ok(inspected)
}

fn inspect_session(
    study: &Study,
    dir: &SessionDir,
    survey: &Survey,
    reporter: &dyn Reporter,
) -> Result<SessionFacts, Problem> {
    let without_host = |problem: Problem| {
        let fact = without_host(&problem.fact, study, &survey.options.mcap_dir);
        Problem { fact, ..problem }
    };
    let prepared = Prepared::new(study, dir, &survey.options.program);
    let mcap = prepared.and_then(|prepared| ingest_without_state(&prepared, &survey.options, reporter));
    reporter.stage(&dir.name, Stage::Signals);
    let facts = mcap.and_then(|mcap| {
        inspect_file(&mcap, study.spec.mount.pitch_offset_deg).map_err(|error| unreadable(dir, &error))
    });
    let mut facts = facts.map_err(without_host)?;
    facts.problems = facts.problems.into_iter().map(without_host).collect();
    Ok(facts)
}

fn unreadable(dir: &SessionDir, error: &ReadError) -> Problem {
    Problem {
        severity: Severity::Loss,
        stage: Stage::Signals,
        code: ProblemCode::BadMcap,
        place: format!("mcap/{}.mcap", dir.name),
        fact: error.to_string(),
        remedy: "check free space and permissions of the temporary folder (TMPDIR)".to_owned(),
    }
}
