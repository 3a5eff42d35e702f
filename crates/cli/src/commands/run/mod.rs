//! `run`: the main job.

mod args;

use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use model::SessionStatus;
use pipeline::{Annotated, Halted, Holder, MarksWritten, NotAnnotated, RunError, RunOptions, WriteMarksError};
use report::{FileError, Results, SinkError};

pub use args::RunArgs;

use super::summary::{Finished, print_summary};
use super::{COMMIT, PROGRAM, outcome, page, place, print, print_message, settings, stop_on_signals, tables_text};
use crate::exit::{Failure, Outcome};
use crate::logging::LogFormat;
use crate::progress::Bars;

/// Runs the study, prints the tables and what was lost.
pub fn run(args: &RunArgs, format: LogFormat, bars: &Bars) -> Result<Outcome, Failure> {
    check(args)?;
    let study = settings::load(&args.study, &args.settings)?;
    place::check_apart(&args.place, &study)?;
    if let Some(folder) = &args.write_marks {
        place::check_marks(folder, &study)?;
    }
    let out = &args.place.out;
    let frames = ::report::frames_file(out);
    if let Some(folder) = out.parent() {
        std::fs::create_dir_all(folder).with_context(|| format!("cannot make the folder {}", folder.display()))?;
    }
    let options = options(args)?;
    let sink = ::report::ParquetSink::create(out, &frames);
    let mut sink = sink.map_err(|error| named(error, &options.work_dir))?;
    let progress = bars.for_run();
    let ran = pipeline::run(&study, &options, &progress, &mut sink).map_err(failure)?;
    drop(sink);
    let annotated = args.annotate.then(|| pipeline::annotate(&study, &options, &progress)).transpose();
    drop(progress);
    let marks = args.write_marks.as_deref();
    let marks = marks.map(|folder| Ok((folder, pipeline::write_marks(&study, &options.work_dir, PROGRAM, folder)?)));
    let marks = marks.transpose().map_err(|error: WriteMarksError| Failure::Failed(error.into()))?;

    let annotated = annotated.map_err(|halted| failure(halted.into()))?;

    let mut results = Results::read(out)?;
    results.read_flow(&frames)?;
    print(&tables_text(&results))?;
    let source = || page::Source {
        out,
        work_dir: &options.work_dir,
        jobs: options.jobs,
        image_memory_bytes: options.image_memory_bytes,
        stop: options.stop.clone(),
    };
    let report = args.report.as_ref().map(|dir| page::write(&results, source(), dir, bars)).transpose()?;
    let (page, shown) = report.map_or((None, true), |report| (Some(report.page), !report.lost));
    let files = [out.clone(), frames, ::report::run_file(out)];
    let files: Vec<PathBuf> = files.into_iter().chain(page).collect();
    print_summary(&Finished { ran: &ran, files: &files, work_dir: &options.work_dir }, format);
    if let Some((folder, written)) = marks {
        print_marks(written, folder, format);
    }
    if let Some(annotated) = &annotated {
        print_annotated(annotated, format);
    }
    if let Some(dir) = &args.expect {
        let comparison = ::report::compare(dir, &results, args.tolerance).map_err(Failure::usage)?;
        print_message(&format!("{comparison}\n"));
        if !comparison.is_ok() {
            return Err(Failure::Failed(anyhow!("the tables differ from those in {}", dir.display())));
        }
    }
    if ran.sessions.iter().all(|session| session.failed) {
        return Err(Failure::Failed(anyhow!("no session could be used")));
    }
    let lost = annotated.is_some_and(|annotated| !annotated.failed.is_empty());
    Ok(outcome(lost || !shown || ran.sessions.iter().any(SessionStatus::has_losses)))
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

/// How many files of marks there are now, and how many somebody has changed.
fn print_marks(written: MarksWritten, folder: &Path, format: LogFormat) {
    let MarksWritten { files, left } = written;
    let place = folder.join("auto");
    if format == LogFormat::Json {
        tracing::info!(files, left, "marks of rims that were found, in {}", place.display());
        return;
    }
    print_message(&format!("marks of rims that were found: {files} files for LabelMe in {}\n", place.display()));
    if left > 0 {
        print_message(&format!(
            "{left} more differ from what would be written, and were left as they are\n  -> remove those that are to be written anew\n"
        ));
    }
}

/// How many recordings are there for viewers, and which are not.
fn print_annotated(annotated: &Annotated, format: LogFormat) {
    let Annotated { folder, made, kept, failed } = annotated;
    if format == LogFormat::Json {
        for NotAnnotated { session, fact } in failed {
            tracing::warn!(session, "no annotated recording: {fact}");
        }
        tracing::info!(made, kept, failed = failed.len(), "annotated recordings, in {}", folder.display());
        return;
    }
    print_message(&format!("annotated recordings: {made} written, {kept} unchanged in {}\n", folder.display()));
    for NotAnnotated { session, fact } in failed {
        print_message(&format!("session '{session}' has none: {fact}\n"));
    }
}

/// Who writes the same files, if it is a run in the same work folder.
fn named(error: SinkError, work_dir: &Path) -> Failure {
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

/// What would otherwise fail at the end of a night.
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
