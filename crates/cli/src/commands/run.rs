//! `run`: the main job.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use model::SessionStatus;
use pipeline::study::StudySpec;
use pipeline::{RunOptions, Study};

use super::{PROGRAM, outcome, print, tables_text, tell};
use crate::args::RunArgs;
use crate::exit::{Failure, Outcome};
use crate::progress::Bars;

/// More problems than this are counted, not listed; all are in the results file.
const PROBLEMS_LISTED: usize = 20;

/// Runs the study, prints the tables and what was lost.
pub fn run(args: &RunArgs, bars: &Bars) -> Result<Outcome, Failure> {
    let study = Study::load(&args.study, |spec| apply(args, spec)).map_err(Failure::usage)?;
    let frames = beside(&args.out, "frames.parquet");
    let options = RunOptions {
        jobs: args.jobs,
        work_dir: args.work.clone().unwrap_or_else(|| args.out.with_extension("work")),
        force: args.force,
        program: PROGRAM.to_owned(),
    };
    if let Some(folder) = args.out.parent() {
        std::fs::create_dir_all(folder).with_context(|| format!("cannot make the folder {}", folder.display()))?;
    }
    let mut sink = ::report::ParquetSink::create(&args.out, &frames)?;
    let sessions = pipeline::run(&study, &options, &bars.for_run(), &mut sink)?;

    let results = ::report::Results::read(&args.out)?;
    print(&tables_text(&results))?;
    if let Some(dir) = &args.report {
        ::report::write_dir(&results, dir)?;
    }
    tell(&summary(&sessions, &[&args.out, &frames]))?;
    if let Some(dir) = &args.expect {
        let comparison = ::report::compare(dir, &results, args.tolerance).map_err(Failure::usage)?;
        tell(&format!("{comparison}\n"))?;
        if !comparison.is_ok() {
            return Err(Failure::Failed(anyhow!("the tables differ from those in {}", dir.display())));
        }
    }
    if sessions.iter().all(|session| session.failed) {
        return Err(Failure::Failed(anyhow!("no session could be used")));
    }
    Ok(outcome(sessions.iter().any(|session| session.failed || !session.problems.is_empty())))
}

/// Flags and environment win over study.toml.
fn apply(args: &RunArgs, spec: &mut StudySpec) {
    if !args.method.is_empty() {
        spec.measure.methods.clone_from(&args.method);
    }
    if let Some(pitch_deg) = args.target_pitch {
        spec.select.target_pitch_deg = pitch_deg;
    }
    if let Some(tolerance_deg) = args.pitch_tolerance {
        spec.select.pitch_tolerance_deg = tolerance_deg;
    }
}

/// The second output: `frames.parquet` beside `results.parquet`, `X.frames.parquet` beside `X.parquet`.
fn beside(results: &Path, name: &str) -> PathBuf {
    match results.file_stem().map(|stem| stem.to_string_lossy()) {
        Some(stem) if stem != "results" => results.with_file_name(format!("{stem}.{name}")),
        _ => results.with_file_name(name),
    }
}

fn summary(sessions: &[SessionStatus], files: &[&Path]) -> String {
    let sum = |count: fn(&SessionStatus) -> usize| sessions.iter().map(count).sum::<usize>();
    let mut text = format!(
        "{} sessions ({} failed), {} images, {} with a pose, {} selected, {} sizes\n",
        sessions.len(),
        sum(|s| usize::from(s.failed)),
        sum(|s| s.images),
        sum(|s| s.with_pose),
        sum(|s| s.selected),
        sum(|s| s.sizes),
    );
    let problems: Vec<_> = sessions.iter().flat_map(|s| s.problems.iter().map(move |p| (s, p))).collect();
    for (session, problem) in problems.iter().take(PROBLEMS_LISTED) {
        let _ = writeln!(
            text,
            "{} [{}] {}: {}\n    {}\n    -> {}",
            session.session, problem.stage, problem.code, problem.place, problem.fact, problem.remedy
        );
    }
    if problems.len() > PROBLEMS_LISTED {
        let _ = writeln!(text, "... and {} more problems", problems.len() - PROBLEMS_LISTED);
    }
    for file in files {
        let _ = writeln!(text, "wrote {}", file.display());
    }
    text
}
