//! `run`: the main job, from cards and marks to results, tables and report.

mod args;
mod messages;

use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use model::SessionStatus;
use pipeline::{Annotated, Halted, Holder, MarksWritten, Ran, RunError, RunOptions, Study, WriteMarksError};
use report::{FileError, ParquetSink, Results, SinkError, frames_file, run_file};

pub use args::RunArgs;
use messages::{print_annotated, print_marks};

use super::summary::{Finished, print_summary};
use super::{COMMIT, PROGRAM, outcome, page, place, print, print_message, settings, stop_on_signals, tables_text};
use crate::exit::{Failure, Outcome};
use crate::logging::LogFormat;
use crate::progress::Bars;

/// Runs the study, prints the tables, and writes the summary with all losses to stderr. Fails where the study or the output
/// cannot be used, no session could be used, or (with `--expect`) the tables differ from the expected ones.
pub fn run(args: &RunArgs, format: LogFormat, bars: &Bars) -> Result<Outcome, Failure> {
    check(args)?;
    let study = settings::load(&args.study, &args.settings)?;
    place::check_apart(&args.place, &study)?;
    if let Some(folder) = &args.write_marks {
        place::check_marks(folder, &study)?;
    }
    let out = &args.place.out;
    if let Some(folder) = out.parent() {
        std::fs::create_dir_all(folder).with_context(|| format!("cannot make the folder {}", folder.display()))?;
    }
    let options = options(args)?;
    let work = work(args, &study, &options, bars)?;
    let mut results = Results::read(out)?;
    results.read_flow(&frames_file(out))?;
    print(&tables_text(&results))?;
    let report = args.report.as_ref().map(|dir| page::write(&results, source(out, &options), dir, bars)).transpose()?;
    let (page, lost_pictures) = report.map_or((None, false), |report| (Some(report.page), report.lost));
    let files: Vec<PathBuf> = [out.clone(), frames_file(out), run_file(out)].into_iter().chain(page).collect();
    print_summary(&Finished { ran: &work.ran, files: &files, work_dir: &options.work_dir }, format);
    if let Some((folder, written)) = work.marks {
        print_marks(written, folder, format);
    }
    if let Some(annotated) = &work.annotated {
        print_annotated(annotated, format);
    }
    if let Some(dir) = &args.expect {
        compare(dir, &results, args.tolerance)?;
    }
    if work.ran.sessions.iter().all(|session| session.failed) {
        return Err(Failure::Failed(anyhow!("no session could be used")));
    }
    Ok(outcome(lost_pictures || work.has_losses()))
}

/// The work of a run: its results are written, and so are the marks and recordings that were asked for.
struct Work<'a> {
    ran: Ran,
    /// The folder of the marks of found rims, and the number of their files.
    marks: Option<(&'a Path, MarksWritten)>,
    annotated: Option<Annotated>,
}

impl Work<'_> {
    fn has_losses(&self) -> bool {
        let lacks_annotated = self.annotated.as_ref().is_some_and(|annotated| !annotated.failed.is_empty());
        lacks_annotated || self.ran.sessions.iter().any(SessionStatus::has_losses)
    }
}

/// Runs the study, and writes its results, and then the recordings for viewers and the marks of found rims where they are asked
/// for. The marks are written even where a signal stopped the recordings.
fn work<'a>(args: &'a RunArgs, study: &Study, options: &RunOptions, bars: &Bars) -> Result<Work<'a>, Failure> {
    let out = &args.place.out;
    let sink = ParquetSink::create(out, &frames_file(out));
    let mut sink = sink.map_err(|error| with_holder(error, &options.work_dir))?;
    let progress = bars.for_run();
    let ran = pipeline::run(study, options, &progress, &mut sink).map_err(failure)?;
    drop(sink);
    let annotated = args.annotate.then(|| pipeline::annotate(study, options, &progress)).transpose();
    drop(progress);
    let marks = args.write_marks.as_deref();
    let marks = marks.map(|folder| Ok((folder, pipeline::write_marks(study, &options.work_dir, PROGRAM, folder)?)));
    let marks = marks.transpose().map_err(|error: WriteMarksError| Failure::Failed(error.into()))?;
    let annotated = annotated.map_err(|halted| failure(halted.into()))?;
    Ok(Work { ran, marks, annotated })
}

/// The files that the report is made from, with the limits of the run.
fn source<'a>(out: &'a Path, options: &'a RunOptions) -> page::Source<'a> {
    page::Source {
        out,
        work_dir: &options.work_dir,
        jobs: options.jobs,
        image_memory_bytes: options.image_memory_bytes,
        stop: options.stop.clone(),
    }
}

/// Compares the tables with the expected ones in `dir`, and writes the comparison to stderr. Fails where they differ, or where
/// the expected ones cannot be used.
fn compare(dir: &Path, results: &Results, tolerance_pct: f64) -> Result<(), Failure> {
    let comparison = ::report::compare(dir, results, tolerance_pct).map_err(Failure::usage)?;
    print_message(&format!("{comparison}\n"));
    if comparison.is_ok() {
        return Ok(());
    }
    Err(Failure::Failed(anyhow!("the tables differ from those in {}", dir.display())))
}

fn options(args: &RunArgs) -> Result<RunOptions, Failure> {
    Ok(RunOptions {
        jobs: args.jobs,
        image_memory_bytes: args.memory,
        work_dir: args.place.work_dir(),
        force: args.force,
        fail_fast: args.fail_fast,
        prune: args.prune,
        program: PROGRAM.to_owned(),
        commit: COMMIT.map(str::to_owned),
        stop: stop_on_signals()?,
    })
}

/// The failure of the output's files; where another run in the same work folder is writing them, it names that run.
fn with_holder(error: SinkError, work_dir: &Path) -> Failure {
    match (&error, Holder::current(work_dir)) {
        (SinkError::File(FileError::Busy { .. }), Some(Holder(holder))) => {
            Failure::Failed(anyhow!(error).context(format!("another run is at work on this output: {holder}")))
        }
        _ => error.into(),
    }
}

fn failure(error: RunError<SinkError>) -> Failure {
    match error {
        RunError::Halted(Halted::Stopped { signal, .. }) => Failure::Stopped(signal, error.into()),
        other => other.into(),
    }
}

/// Refuses arguments that would otherwise fail only at the end of a night.
fn check(args: &RunArgs) -> Result<(), Failure> {
    let refuse = |fact: String| Err(Failure::Usage(anyhow!(fact)));
    place::check_name(&args.place.out)?;
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
