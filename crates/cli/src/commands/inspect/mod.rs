//! `inspect`: shows the content of a recording, or of those of a study.

mod clock;
mod sparkline;
mod text;
mod words;

use std::fs::File;
use std::io::Read;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use model::Problem;
use pipeline::inspect::{Inspected, SessionFacts};
use pipeline::{Study, SurveyOptions, inspect_file, inspect_study};
use serde::Serialize;

use super::{PROGRAM, outcome, print, stop_on_signals, survey_failure};
use crate::exit::{Failure, Outcome};
use crate::progress::Bars;

/// The arguments of `inspect`.
#[derive(Debug, clap::Args)]
pub struct InspectArgs {
    /// MCAP file that ingest or run wrote, or folder of a study; nothing is written there
    #[arg(value_name = "FILE|STUDY")]
    pub path: PathBuf,
    /// Sessions of a study at a time; default: the cores that this process may use
    #[arg(short, long, env = "AIM_BATCH_JOBS")]
    pub jobs: Option<NonZeroUsize>,
    /// JSON on stdout (docs/inspect.md)
    #[arg(long)]
    pub json: bool,
}

/// Version of the JSON. It rises when a key is removed, renamed, or changes its meaning.
const SCHEMA_VERSION: u32 = 1;
/// The bytes that every MCAP file begins with.
const MCAP_MAGIC: &[u8] = b"\x89MCAP0\r\n";

/// Inspects a recording, or all of a study, and prints the facts, as text or as JSON. Fails where no session could be used.
pub fn run(args: &InspectArgs, bars: &Bars) -> Result<Outcome, Failure> {
    let inspected = if args.path.is_dir() {
        let study = study(&args.path)?;
        let options = SurveyOptions { jobs: args.jobs, program: PROGRAM.to_owned(), stop: stop_on_signals()? };
        inspect_study(&study, &options, &bars.for_run()).map_err(survey_failure)?
    } else {
        require_mcap(&args.path)?;
        let facts = inspect_file(&args.path, None)?;
        vec![Inspected { session: facts.session.clone(), facts: Ok(facts) }]
    };
    if args.json {
        print(&(json(&inspected)? + "\n"))?;
    } else {
        print(&text::text(&inspected))?;
    }
    if inspected.iter().all(|session| session.facts.is_err()) {
        return Err(Failure::Failed(anyhow!("no session could be used")));
    }
    Ok(outcome(inspected.iter().any(|session| session.facts.is_err())))
}

fn study(folder: &Path) -> Result<Study, Failure> {
    if !folder.join("study.toml").exists() {
        return Err(Failure::Usage(anyhow!(
            "expected a study, but there is no study.toml in it; for a card alone: aim-batch ingest CARD -o X.mcap, then \
             aim-batch inspect X.mcap: {}",
            folder.display()
        )));
    }
    Study::load(folder, |_| {}).map_err(Failure::usage)
}

/// Refuses a file that is no MCAP file at all, which would otherwise be called a damaged one.
fn require_mcap(path: &Path) -> Result<(), Failure> {
    let mut start = Vec::new();
    let file = File::open(path).with_context(|| format!("cannot open {}", path.display())).map_err(Failure::Usage)?;
    file.take(MCAP_MAGIC.len() as u64).read_to_end(&mut start)?;
    if start == MCAP_MAGIC {
        return Ok(());
    }
    Err(Failure::Usage(anyhow!("expected an MCAP file or the folder of a study, got neither: {}", path.display())))
}

#[derive(Serialize)]
struct Document<'a> {
    schema_version: u32,
    program: &'a str,
    sessions: Vec<Session<'a>>,
}

#[derive(Serialize)]
struct Session<'a> {
    session: &'a str,
    facts: Option<&'a SessionFacts>,
    problem: Option<&'a Problem>,
}

impl<'a> From<&'a Inspected> for Session<'a> {
    fn from(inspected: &'a Inspected) -> Self {
        let Inspected { session, facts } = inspected;
        Self { session, facts: facts.as_ref().ok(), problem: facts.as_ref().err() }
    }
}

fn json(inspected: &[Inspected]) -> serde_json::Result<String> {
    let sessions = inspected.iter().map(Session::from).collect();
    serde_json::to_string_pretty(&Document { schema_version: SCHEMA_VERSION, program: PROGRAM, sessions })
}
