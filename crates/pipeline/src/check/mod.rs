//! Tells before a run what it would lose: goes through every stage that needs no pictures, and stores nothing.

mod sizes;

use std::cell::Cell;
use std::collections::BTreeSet;

use model::{Problem, SessionStatus, Stage, StudyFlow};

use crate::parallel::unless_panicking;
use crate::reporter::Reporter;
use crate::session::{SessionOutput, failed, run_session};
use crate::study::Study;
use crate::survey::{Survey, SurveyError, SurveyOptions};
use sizes::Measured;

/// The result of a check.
#[derive(Debug, Clone, PartialEq)]
pub struct Checked {
    /// How each session would fare, in the order of the names.
    pub sessions: Vec<SessionStatus>,
    /// The numbers of images at each step, kept and dropped.
    pub flow: StudyFlow,
    /// Problems of the study as a whole: objects without a size, tables that would stay empty.
    pub study: Vec<Problem>,
}

/// Does for every session what [`run()`](crate::run()) does, with the same problems, but without pictures and without
/// results. Cards are read whole, since damage shows nowhere else; what is written goes into a temporary folder. Only counts
/// are kept of the rows.
///
/// # Errors
/// [`SurveyError`] for what concerns the check as a whole.
pub fn check(study: &Study, options: &SurveyOptions, reporter: &dyn Reporter) -> Result<Checked, SurveyError> {
    let survey = Survey::new(options)?;
    let parts = survey.for_each_session(study, options.jobs, reporter, |dir| {
        let road = || run_session(study, dir, &survey.options, reporter);
        let output = unless_panicking(dir, &Cell::new(Stage::Study), road);
        let output = output.unwrap_or_else(|problem| failed(study, dir, problem));
        reporter.done(&output.status);
        Part::from_output(output)
    })?;
    let mut checked = Checked { sessions: Vec::new(), flow: StudyFlow::default(), study: Vec::new() };
    let mut measured = BTreeSet::new();
    for part in parts {
        checked.flow.merge(part.flow);
        checked.sessions.push(part.status);
        measured.extend(part.measured);
    }
    checked.study = sizes::problems(study, &measured);
    Ok(checked)
}

/// The part of a session's output that is kept.
struct Part {
    status: SessionStatus,
    flow: StudyFlow,
    measured: BTreeSet<Measured>,
}

impl Part {
    fn from_output(output: SessionOutput) -> Self {
        let mut flow = StudyFlow::default();
        output.frames.iter().for_each(|frame| flow.add(frame));
        let measured = output.results.iter().filter_map(Measured::from_row).collect();
        Self { status: output.status, flow, measured }
    }
}
