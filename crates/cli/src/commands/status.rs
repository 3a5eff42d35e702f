//! `status`: shows what a run has done, and what another would do.

use std::fmt::Write as _;
use std::path::PathBuf;

use indicatif::{HumanBytes, HumanCount};
use model::SessionStatus;
use pipeline::{SessionState, StudyState};
use serde::Serialize;

use super::place::PlaceArgs;
use super::settings::SettingsArgs;
use super::{COMMIT, PROGRAM, print, settings};
use crate::exit::{Failure, Outcome};

/// The arguments of `status`.
#[derive(Debug, clap::Args)]
pub struct StatusArgs {
    /// Folder of the study (docs/study.md)
    pub study: PathBuf,
    /// Where results go, and what is kept between runs
    #[command(flatten)]
    pub place: PlaceArgs,
    /// List every session, also those of which nothing is to be done and nothing was lost
    #[arg(long)]
    pub all: bool,
    /// JSON on stdout (docs/runs.md)
    #[arg(long)]
    pub json: bool,
    /// Settings in place of study.toml's
    #[command(flatten)]
    pub settings: SettingsArgs,
}

/// Version of the JSON. It rises when a key is removed, renamed, or changes its meaning.
const SCHEMA_VERSION: u32 = 1;

/// Prints the state of the study's sessions, as text or as JSON.
pub fn run(args: &StatusArgs) -> Result<Outcome, Failure> {
    let study = settings::load(&args.study, &args.settings)?;
    let work_dir = args.place.work_dir();
    let state = pipeline::status(&study, &work_dir, PROGRAM, COMMIT)?;
    if args.json {
        print(&(json(&state)? + "\n"))?;
    } else {
        let place =
            format!("work folder {}{}\n", work_dir.display(), if work_dir.is_dir() { "" } else { " (none yet)" });
        print(&(place + &text(&state, args.all)))?;
    }
    Ok(Outcome::Well)
}

fn text(state: &StudyState, all: bool) -> String {
    let count = |is: fn(&SessionState) -> bool| state.sessions.iter().filter(|session| is(session)).count();
    let to_read: u64 = state.sessions.iter().map(|session| session.bytes_to_read).sum();
    let mut text = match &state.holder {
        Some(holder) => format!("a run is at work: {}\n", holder.0),
        None => String::new(),
    };
    let _ = writeln!(
        text,
        "{} sessions: {} up to date, {} to do ({} to ingest, {} of cards to read); {} failed, {} lost data",
        state.sessions.len(),
        count(|session| session.current.all()),
        count(|session| !session.current.all()),
        count(|session| !session.current.ingest),
        HumanBytes(to_read),
        count(|session| session.status.as_ref().is_some_and(|status| status.failed)),
        count(|session| session.status.as_ref().is_some_and(|status| !status.failed && status.has_losses())),
    );
    let listed: Vec<&SessionState> = state.sessions.iter().filter(|session| all || is_notable(session)).collect();
    let width = listed.iter().map(|session| session.session.chars().count()).max().unwrap_or(0);
    for session in listed {
        let _ = writeln!(text, "  {:width$}  {}", session.session, describe(session));
    }
    let old = count(|session| session.has_old_calibration);
    if old > 0 {
        let _ = writeln!(
            text,
            "{old} recordings have the calibration of an earlier camera, which viewers show; sizes do not depend on it\n  -> \
             aim-batch run --force ingests them anew"
        );
    }
    if !state.removed.is_empty() {
        let names = state.removed.join(", ");
        let _ = writeln!(
            text,
            "no longer in the study: {names}\n  -> aim-batch run --prune deletes them from the work folder"
        );
    }
    text
}

fn is_notable(session: &SessionState) -> bool {
    !session.current.all() || session.status.as_ref().is_none_or(SessionStatus::has_losses)
}

fn describe(session: &SessionState) -> String {
    let current = session.current;
    let mut to_do = Vec::new();
    if !current.ingest {
        to_do.push(format!("ingest ({})", HumanBytes(session.bytes_to_read)));
    }
    to_do.extend((!current.signals).then(|| "signals".to_owned()));
    to_do.extend((!current.measure).then(|| "measure".to_owned()));
    let work = if to_do.is_empty() { "up to date".to_owned() } else { format!("to do: {}", to_do.join(", ")) };
    let fared = match (&session.status, &session.measured_utc) {
        (Some(status), Some(time)) => format!("; {} at {}", fared(status), time.get(..19).unwrap_or(time)),
        _ => String::new(),
    };
    format!("{work}{fared}")
}

fn fared(status: &SessionStatus) -> String {
    let first = status.problems.iter().find(|problem| problem.severity == model::Severity::Loss);
    let why = first.map(|problem| format!(" ({}: {})", problem.code, problem.place)).unwrap_or_default();
    match (status.failed, status.has_losses()) {
        (true, _) => format!("failed{why}"),
        (false, true) => format!("lost data{why}"),
        (false, false) => format!("{} images, {} sizes", HumanCount(status.images as u64), status.sizes),
    }
}

#[derive(Serialize)]
struct Document<'a> {
    schema_version: u32,
    program: &'a str,
    at_work: Option<&'a str>,
    removed: &'a [String],
    sessions: Vec<Session<'a>>,
}

#[derive(Serialize)]
struct Session<'a> {
    session: &'a str,
    ingest_is_current: bool,
    signals_is_current: bool,
    measure_is_current: bool,
    bytes_to_read: u64,
    has_old_calibration: bool,
    measured_utc: Option<&'a str>,
    status: Option<&'a SessionStatus>,
}

impl<'a> From<&'a SessionState> for Session<'a> {
    fn from(session: &'a SessionState) -> Self {
        Self {
            session: &session.session,
            ingest_is_current: session.current.ingest,
            signals_is_current: session.current.signals,
            measure_is_current: session.current.measure,
            bytes_to_read: session.bytes_to_read,
            has_old_calibration: session.has_old_calibration,
            measured_utc: session.measured_utc.as_deref(),
            status: session.status.as_ref(),
        }
    }
}

fn json(state: &StudyState) -> serde_json::Result<String> {
    serde_json::to_string_pretty(&Document {
        schema_version: SCHEMA_VERSION,
        program: PROGRAM,
        at_work: state.holder.as_ref().map(|holder| holder.0.as_str()),
        removed: &state.removed,
        sessions: state.sessions.iter().map(Session::from).collect(),
    })
}
