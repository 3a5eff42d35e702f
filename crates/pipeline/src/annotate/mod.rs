//! Writes recordings with their marks and sizes, for viewers: `WORK/annotated/SESSION.annotated.mcap` (docs/viewers.md).

mod drawn;
mod log;
mod notes;

use std::cell::Cell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use ingest::{AnnotateError, Annotating, ByteBudget, ImageEntry, SessionReader};
use model::{Camera, SessionStatus, Stage};

use crate::inputs::sha256_of_bytes;
use crate::parallel::{in_parallel, unless_panicking};
use crate::reporter::{Reporter, Totals};
use crate::run::{Halted, RunOptions, program_and_commit};
use crate::session::{SessionOutput, without_host};
use crate::study::{SessionDir, Study};
use crate::work::{Kept, WorkError, WorkFolder, annotated_of};
use notes::Notes;

/// The version of the files. A change of meaning gets another number, and the files are then made anew.
const ANNOTATE_VERSION: u32 = 1;
/// A picture takes this many bytes per pixel while marks are drawn on it.
const BYTES_PER_PIXEL: u64 = 4;

/// The result of annotating a study.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Annotated {
    /// The folder of the files.
    pub folder: PathBuf,
    /// The number of files that were made.
    pub made: usize,
    /// The number of files that are as they would be made.
    pub kept: usize,
    /// The sessions without a file, and why; those that failed in the run are left out.
    pub failed: Vec<NotAnnotated>,
}

/// A session without an annotated recording.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NotAnnotated {
    /// The name of the session.
    pub session: String,
    /// The reason.
    pub fact: String,
}

/// The outcome for one session.
enum Outcome {
    Made,
    Kept,
    Nothing,
    Failed(NotAnnotated),
    Stopped,
}

/// Writes an annotated recording of each session of `study`, from what the last run in the work folder has kept. A file that was
/// made from the same is left as it is. What goes wrong with one session does not stop the others.
///
/// # Errors
/// [`Halted`] for what concerns all of them: the work folder, threads, a signal.
pub fn annotate(study: &Study, options: &RunOptions, reporter: &dyn Reporter) -> Result<Annotated, Halted> {
    let work = WorkFolder::open(&options.work_dir, &options.program)?;
    let folder = work.annotated_dir()?;
    let annotator = Annotator {
        study,
        work: &work,
        kept: work.state.kept_by_session()?,
        program: program_and_commit(&options.program, options.commit.as_deref()),
        budget: ByteBudget::new(options.image_memory_bytes),
        options,
        reporter,
    };
    reporter.begin(&Totals { sessions: study.sessions.len(), ..Totals::default() });
    let outcomes = in_parallel(&study.sessions, options.jobs, |dir| annotator.session(dir))?;
    let mut annotated = Annotated { folder, ..Annotated::default() };
    for outcome in outcomes {
        match outcome {
            Outcome::Made => annotated.made += 1,
            Outcome::Kept => annotated.kept += 1,
            Outcome::Failed(failed) => annotated.failed.push(failed),
            Outcome::Nothing | Outcome::Stopped => {}
        }
    }
    match options.stop.signal() {
        Some(signal) => {
            let (done, sessions) = (annotated.made + annotated.kept, study.sessions.len());
            Err(Halted::Stopped { signal, done, sessions })
        }
        None => Ok(annotated),
    }
}

/// Everything that the sessions at work share.
struct Annotator<'a> {
    study: &'a Study,
    work: &'a WorkFolder,
    kept: BTreeMap<String, Kept>,
    program: String,
    budget: ByteBudget,
    options: &'a RunOptions,
    reporter: &'a dyn Reporter,
}

/// The reason why a session has no file.
#[derive(Debug, thiserror::Error)]
enum AnnotateFailure {
    #[error(transparent)]
    Work(#[from] WorkError),
    #[error("what was kept of the session cannot be read: {0}; run with --force")]
    Kept(#[from] serde_json::Error),
    #[error("{0}; run with --force to ingest the card anew")]
    Recording(#[from] ingest::ReadError),
    #[error(transparent)]
    Annotate(#[from] AnnotateError),
    #[error("the recording's camera: {0}; run with --force to ingest the card anew")]
    Camera(#[from] model::CameraSpecError),
    #[error("cannot remove the file of an earlier run: {0}")]
    Remove(#[from] std::io::Error),
}

impl Annotator<'_> {
    fn session(&self, dir: &SessionDir) -> Outcome {
        if self.options.stop.is_set() {
            return Outcome::Stopped;
        }
        let stage = Cell::new(Stage::Measure);
        let done = unless_panicking(dir, &stage, || self.annotated(dir));
        let failed = |fact: String| {
            let fact = without_host(&fact, self.study, &self.work.mcap_dir);
            Outcome::Failed(NotAnnotated { session: dir.name.clone(), fact })
        };
        let outcome = match done {
            Ok(Ok(outcome)) => outcome,
            Ok(Err(AnnotateFailure::Annotate(AnnotateError::Stopped))) => Outcome::Stopped,
            Ok(Err(failure)) => failed(failure.to_string()),
            Err(problem) => failed(problem.fact),
        };
        if !matches!(outcome, Outcome::Stopped) {
            self.reporter.done(&self.status(dir, &outcome));
        }
        outcome
    }

    /// The status of the session for the progress: a session whose file is kept, or cannot be made, is done as well.
    fn status(&self, dir: &SessionDir, outcome: &Outcome) -> SessionStatus {
        let of_run = self.kept.get(&dir.name).and_then(|kept| kept.status.clone());
        let status = of_run.unwrap_or_else(|| SessionStatus { session: dir.name.clone(), ..SessionStatus::default() });
        SessionStatus { failed: status.failed || matches!(outcome, Outcome::Failed(_)), ..status }
    }

    fn annotated(&self, dir: &SessionDir) -> Result<Outcome, AnnotateFailure> {
        let out = annotated_of(&self.options.work_dir, &dir.name);
        let Some(key) = self.key(dir)? else {
            return remove(&out).map(|()| Outcome::Nothing);
        };
        if !self.options.force && ingest::annotated_key(&out).as_ref() == Some(&key) {
            return Ok(Outcome::Kept);
        }
        let Some(text) = self.work.state.output(&dir.name, Stage::Measure)? else {
            return remove(&out).map(|()| Outcome::Nothing);
        };
        let output: SessionOutput = serde_json::from_str(&text)?;
        drop(text);
        self.write(dir, &output, &key, &out)?;
        Ok(Outcome::Made)
    }

    /// The key of everything that the file is made from; none where the session has failed, or was never measured.
    fn key(&self, dir: &SessionDir) -> Result<Option<String>, AnnotateFailure> {
        let Some(kept) = self.kept.get(&dir.name) else { return Ok(None) };
        let failed = kept.status.as_ref().is_none_or(|status| status.failed);
        let (Some(ingest), Some(measure), false) = (&kept.ingest, &kept.measure, failed) else { return Ok(None) };
        let parts = (ANNOTATE_VERSION, &self.program, &ingest.key, &measure.output_sha256);
        Ok(Some(sha256_of_bytes(&serde_json::to_vec(&parts)?)))
    }

    fn write(&self, dir: &SessionDir, output: &SessionOutput, key: &str, out: &Path) -> Result<(), AnnotateFailure> {
        let recording = self.work.mcap(&dir.name);
        let camera = self.camera(output, &recording)?;
        let notes = Notes::from_output(output);
        let what = Annotating {
            recording: &recording,
            out,
            key,
            camera: &camera,
            raters: &notes.raters,
            log: &log::of_session(output),
        };
        let bytes: u64 = output.frames.iter().map(|frame| u64::from(frame.bytes)).sum();
        self.reporter.bytes_to_read(&dir.name, bytes);
        ingest::annotate_session(&what, |image, jpeg| {
            if self.options.stop.is_set() {
                return None;
            }
            let mut noted = notes.of_image(image);
            if noted.view.is_some() && !noted.marks.is_empty() {
                let _taken = self.budget.take(bytes_in_memory(image));
                match drawn::drawn(&noted, jpeg) {
                    Ok(drawn) => noted.drawn_jpeg = Some(drawn),
                    Err(fact) => tracing::warn!(session = dir.name, "nothing is drawn on {}: {fact}", image.file),
                }
            }
            self.reporter.bytes_read(&dir.name, image.bytes);
            Some(noted)
        })?;
        Ok(())
    }

    /// The camera that sizes were measured with, or that of the recording where there are no sizes.
    fn camera(&self, output: &SessionOutput, recording: &Path) -> Result<Camera, AnnotateFailure> {
        match &output.shown.camera {
            Some(spec) => Ok(spec.camera()?),
            None => Ok(SessionReader::open(recording)?.metadata().camera.camera()?),
        }
    }
}

fn bytes_in_memory(image: &ImageEntry) -> u64 {
    image.bytes + BYTES_PER_PIXEL * u64::from(image.width_px) * u64::from(image.height_px)
}

/// Removes a file of an earlier run, whose content no longer holds.
fn remove(file: &Path) -> Result<(), AnnotateFailure> {
    match std::fs::remove_file(file) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(error.into()),
        _ => Ok(()),
    }
}
