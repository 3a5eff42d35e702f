//! `run`: the main job.

use anyhow::{Context, anyhow};
use model::SessionStatus;
use pipeline::calibrate::CalibrationFile;
use pipeline::{RunOptions, Study};

use super::summary::tell_summary;
use super::{PROGRAM, outcome, print, settings, tables_text, tell};
use crate::args::RunArgs;
use crate::exit::{Failure, Outcome};
use crate::logging::LogFormat;
use crate::progress::Bars;

/// Runs the study, prints the tables and what was lost.
pub fn run(args: &RunArgs, format: LogFormat, bars: &Bars) -> Result<Outcome, Failure> {
    check(args)?;
    let study = Study::load(&args.study, |spec| settings::apply(&args.settings, spec)).map_err(Failure::usage)?;
    let study = match &args.calibration {
        Some(path) => study.calibrated(CalibrationFile::read(path).map_err(Failure::usage)?),
        None => study,
    };
    let frames = ::report::frames_file(&args.out);
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

    let mut results = ::report::Results::read(&args.out)?;
    results.read_flow(&frames)?;
    print(&tables_text(&results))?;
    if let Some(dir) = &args.report {
        ::report::write_dir(&results, dir)?;
    }
    tell_summary(&sessions, &[&args.out, &frames], format)?;
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
    Ok(outcome(sessions.iter().any(SessionStatus::has_losses)))
}

/// What would otherwise fail at the end of a night.
fn check(args: &RunArgs) -> Result<(), Failure> {
    let refuse = |fact: String| Err(Failure::Usage(anyhow!(fact)));
    if args.out.extension().is_none_or(|extension| extension != "parquet") {
        return refuse(format!("--out {}: expected a name that ends in .parquet", args.out.display()));
    }
    if !(args.tolerance.is_finite() && args.tolerance >= 0.0) {
        return refuse(format!("--tolerance {}: expected zero or a positive number", args.tolerance));
    }
    if let Some(dir) = args.expect.as_deref().filter(|dir| !dir.is_dir()) {
        return refuse(format!("--expect {}: no such folder", dir.display()));
    }
    if let Some(dir) = args.report.as_deref().filter(|dir| dir.exists() && !dir.is_dir()) {
        return refuse(format!("--report {}: there is a file of this name; expected a folder", dir.display()));
    }
    Ok(())
}
