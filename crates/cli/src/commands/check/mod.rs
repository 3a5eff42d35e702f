//! `check`: shows, before a run, everything that the run would lose.

mod json;
mod text;

use anyhow::anyhow;
use model::{RunMetadata, SessionStatus};
use pipeline::{Checked, Study, SurveyOptions};
use std::num::NonZeroUsize;
use std::path::PathBuf;

use super::settings::SettingsArgs;
use super::{PROGRAM, outcome, print, settings, stop_on_signals, survey_failure};
use crate::exit::{Failure, Outcome};
use crate::progress::Bars;

/// The arguments of `check`.
#[derive(Debug, clap::Args)]
pub struct CheckArgs {
    /// Folder of the study (docs/study.md); nothing is written into it
    pub study: PathBuf,
    /// Sessions at a time; default: the cores that this process may use
    #[arg(short, long, env = "AIM_BATCH_JOBS")]
    pub jobs: Option<NonZeroUsize>,
    /// Also show what is worth knowing and costs nothing
    #[arg(long)]
    pub notes: bool,
    /// JSON on stdout (docs/inspect.md)
    #[arg(long)]
    pub json: bool,
    /// Settings in place of study.toml's
    #[command(flatten)]
    pub settings: SettingsArgs,
}

/// Checks the study, and prints what would be lost, as text or as JSON. Fails where no session could be used.
pub fn run(args: &CheckArgs, bars: &Bars) -> Result<Outcome, Failure> {
    let study = settings::load(&args.study, &args.settings)?;
    let options = SurveyOptions { jobs: args.jobs, program: PROGRAM.to_owned(), stop: stop_on_signals()? };
    let checked = pipeline::check(&study, &options, &bars.for_run()).map_err(survey_failure)?;
    if args.json {
        print(&(json::text(&study, &checked)? + "\n"))?;
    } else {
        print(&text::text(&checked, &results(&study, &checked), args.notes))?;
    }
    if checked.sessions.iter().all(|session| session.failed) {
        return Err(Failure::Failed(anyhow!("no session could be used")));
    }
    Ok(outcome(checked.sessions.iter().any(SessionStatus::has_losses)))
}

/// Results without sizes, as a run would give them, for the tables of images.
fn results(study: &Study, checked: &Checked) -> ::report::Results {
    let metadata = RunMetadata {
        program: PROGRAM.to_owned(),
        commit: None,
        study: study.spec.name.clone(),
        statement: None,
        settings: serde_json::Value::Null,
        tables: Vec::new(),
        sessions: checked.sessions.clone(),
        inputs_sha256: std::collections::BTreeMap::new(),
    };
    ::report::Results { rows: Vec::new(), metadata, flow: Some(checked.flow.clone()) }
}

/// How a session would fare in a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
enum Verdict {
    Whole,
    LosesData,
    Fails,
}

impl Verdict {
    fn from_status(session: &SessionStatus) -> Self {
        match (session.failed, session.has_losses()) {
            (true, _) => Self::Fails,
            (false, true) => Self::LosesData,
            (false, false) => Self::Whole,
        }
    }

    const fn words(self) -> &'static str {
        match self {
            Self::Whole => "would run whole",
            Self::LosesData => "would lose data",
            Self::Fails => "would fail",
        }
    }

    /// Number of sessions with this verdict.
    fn count(self, sessions: &[SessionStatus]) -> usize {
        sessions.iter().filter(|session| Self::from_status(session) == self).count()
    }
}
