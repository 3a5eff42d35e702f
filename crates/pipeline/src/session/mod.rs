//! The road of one session: card -> MCAP -> signals -> marks -> sizes -> rows.

mod auto;
mod bench;
mod card_progress;
mod found;
mod fuse;
mod lag;
mod ledger;
mod marks;
mod measurement;
mod naming;
mod prepared;
mod problems;
mod recording;
mod row;
mod shown;
mod surest;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use ingest::{DroppedImage, ImageEntry, IngestError};
use model::{Camera, FrameRow, Problem, ResultRow, SessionStatus, Severity, Stage};
use serde::{Deserialize, Serialize};

use crate::calibrate::BenchSession;
use crate::labelme::AutoRim;
use crate::reporter::Reporter;
use crate::signals::{FrameSignals, Reading};
use crate::stop::Stop;
use crate::study::{SessionDir, SessionSpec, Study};
pub(crate) use auto::{AUTO, AutoMarks, Search, SearchError};
pub(crate) use card_progress::CardProgress;
use ledger::ledger_of_failed;
use marks::SessionMarks;
pub(crate) use marks::stem_of;
pub(crate) use prepared::Prepared;
use problems::no_pose;
pub(crate) use problems::without_host;
pub(crate) use recording::{BAD_MCAP, Recording, read as read_recording};
pub(crate) use shown::{Shown, ShownImage, ShownMark, ShownObject};

/// What one session gives.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct SessionOutput {
    /// How it fared.
    pub status: SessionStatus,
    /// Sizes.
    pub results: Vec<ResultRow>,
    /// Every image.
    pub frames: Vec<FrameRow>,
    /// SHA-256 of what was read, by path relative to the study.
    pub inputs_sha256: BTreeMap<String, String>,
    /// Rims that the program found itself, by image (file on the card).
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub auto: BTreeMap<String, Vec<AutoRim>>,
    /// What they came from, where they may serve again.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub searched: Option<Searched>,
    /// What was measured where, for those who show pictures.
    #[serde(default)]
    pub shown: Shown,
    /// Known sizes, where a calibration asks for them.
    #[serde(skip)]
    pub bench: BenchSession,
}

/// A search for rims that need not be made again.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Searched {
    /// Key of what it was made from.
    pub key: String,
    /// Pictures that could not be searched.
    pub problems: Vec<Problem>,
}

/// How [`run_session`] treats a session.
#[derive(Debug, Clone)]
pub(crate) struct SessionOptions {
    /// Folder for MCAP files.
    pub mcap_dir: PathBuf,
    /// Whether to survey cards only: MCAP files then have no pictures, and belong into a temporary folder.
    pub survey: bool,
    /// Program and version, for provenance.
    pub program: String,
    /// A wish to stop.
    pub stop: Stop,
}

/// An image with its signals, as the later steps see it.
struct Frame {
    image: ImageEntry,
    signals: FrameSignals,
}

/// All of a session that is known once its card and session.toml are read.
struct Session<'a> {
    study: &'a Study,
    dir: &'a SessionDir,
    spec: SessionSpec,
    /// Camera of the pictures that were marked.
    marks_camera: Camera,
    frames: Vec<Frame>,
    dropped: Vec<DroppedImage>,
}

impl Session<'_> {
    /// Where a file of the card is, relative to the study.
    fn place_of(&self, file: &str) -> String {
        format!("cards/{}/{file}", self.dir.name)
    }
}

/// Goes the road of one session without keeping anything but its MCAP file. Whatever goes wrong is in the status; what could be used is
/// in the rows.
pub(crate) fn run_session(
    study: &Study,
    dir: &SessionDir,
    options: &SessionOptions,
    reporter: &dyn Reporter,
) -> SessionOutput {
    let mut output = unkept(study, dir, options, reporter).unwrap_or_else(|problem| failed(study, dir, problem));
    tidy(&mut output, study, &options.mcap_dir);
    output
}

fn unkept(
    study: &Study,
    dir: &SessionDir,
    options: &SessionOptions,
    reporter: &dyn Reporter,
) -> Result<SessionOutput, Problem> {
    let prepared = Prepared::new(study, dir, &options.program)?;
    let mcap = ingest_unkept(&prepared, options, reporter)?;
    reporter.stage(&dir.name, Stage::Signals);
    let recording = read_recording(study, &mcap, &dir.name)?;
    Ok(measure(study, dir, &prepared, recording, AutoMarks::default(), reporter))
}

/// Ingests or surveys a card; gives the MCAP file.
pub(crate) fn ingest_unkept(
    prepared: &Prepared,
    options: &SessionOptions,
    reporter: &dyn Reporter,
) -> Result<PathBuf, Problem> {
    let source = &prepared.source;
    reporter.stage(&source.session, Stage::Ingest);
    let mcap = options.mcap_dir.join(format!("{}.mcap", source.session));
    let progress = CardProgress { session: &source.session, reporter, stop: &options.stop, budget: None };
    let ingested = if options.survey {
        ingest::survey_session(source, &mcap, &progress)
    } else {
        ingest::ingest_session(source, &mcap, &progress)
    };
    ingested.map(|_| mcap).map_err(|error| ingest_problem(&source.session, &error))
}

/// What a session gives of which nothing could be used.
pub(crate) fn failed(study: &Study, dir: &SessionDir, problem: Problem) -> SessionOutput {
    let frames = ledger_of_failed(study, dir);
    let (session, images, problems) = (dir.name.clone(), frames.len(), vec![problem]);
    let status = SessionStatus { session, failed: true, images, problems, ..SessionStatus::default() };
    SessionOutput { status, frames, ..SessionOutput::default() }
}

/// Takes out what depends on where things lie, and logs the problems.
pub(crate) fn tidy(output: &mut SessionOutput, study: &Study, mcap_dir: &Path) {
    for problem in &mut output.status.problems {
        problem.fact = without_host(&problem.fact, study, mcap_dir);
    }
    log_problems(&output.status);
}

/// Losses as warnings; notes are told in the report, and logged for those who ask for more.
pub(crate) fn log_problems(status: &SessionStatus) {
    let session = &status.session;
    for Problem { severity, stage, code, place, fact, remedy } in &status.problems {
        match severity {
            Severity::Loss => tracing::warn!(session, %stage, code, place, remedy, "{fact}"),
            Severity::Note => tracing::info!(session, %stage, code, place, remedy, "{fact}"),
        }
    }
}

/// The images of a recording with their signals.
fn frames(study: &Study, prepared: &Prepared, recording: &Recording) -> Vec<Frame> {
    let settings = prepared.pose_settings(study, recording.mount_pitch_deg);
    let of_image =
        |(image, reading): (&ImageEntry, &Reading)| Frame { image: image.clone(), signals: reading.judge(&settings) };
    recording.images.iter().zip(&recording.readings).map(of_image).collect()
}

/// From a recording, and what was found in its pictures, to rows.
pub(crate) fn measure(
    study: &Study,
    dir: &SessionDir,
    prepared: &Prepared,
    recording: Recording,
    auto: AutoMarks,
    reporter: &dyn Reporter,
) -> SessionOutput {
    let mut output = SessionOutput::default();
    output.status.session.clone_from(&dir.name);
    let frames = frames(study, prepared, &recording);
    output.status.problems = recording.problems;
    output.inputs_sha256.extend(prepared.session_toml_sha256.clone());
    let on_card = recording.inputs_sha256.into_iter().map(|(file, sha)| (format!("cards/{}/{file}", dir.name), sha));
    output.inputs_sha256.extend(on_card);
    let session = Session {
        study,
        dir,
        spec: prepared.spec.clone(),
        marks_camera: prepared.marks_camera.1,
        frames,
        dropped: recording.dropped,
    };
    reporter.stage(&dir.name, Stage::Marks);
    let mut marks = SessionMarks::read(&session, &mut output);
    output.status.problems.extend(auto.problems);
    marks.add_found(&session, &auto.by_image, &mut output.status.problems);
    output.status.problems.extend(marks.unused_names(&session, auto.searched));
    output.auto = auto.by_image;
    reporter.stage(&dir.name, Stage::Measure);
    let marked = measurement::marked(&session, &marks, &mut output.status.problems);
    if study.is_bench {
        output.bench = bench::of(&session, &marked);
    }
    output.shown = Shown::of(&prepared.camera, &marked);
    let mut measurements = measurement::measure_all(&marked, &mut output.status.problems);
    let fused = fuse::fuse(study, &marked, &mut measurements);
    let asked = |row: &ResultRow| study.spec.measure.methods.contains(&row.method);
    output.results = measurements.into_iter().map(|measurement| measurement.row).filter(asked).chain(fused).collect();
    output.frames = ledger::ledger(&session, &marks, &output.results);
    output.status.images = output.frames.len();
    output.status.with_pose = session.frames.iter().filter(|f| f.signals.pose.is_some()).count();
    output.status.problems.extend(no_pose(&session));
    output.status.selected = output.frames.iter().filter(|f| f.reason == model::FrameReason::Selected).count();
    output.status.sizes = output.results.iter().filter(|row| row.predicted_mm.is_some()).count();
    output
}

/// An ingest that failed, as a session's problem.
pub(crate) fn ingest_problem(session: &str, error: &IngestError) -> Problem {
    Problem {
        severity: Severity::Loss,
        stage: Stage::Ingest,
        code: error.code().to_owned(),
        place: format!("cards/{session}"),
        fact: error.to_string(),
        remedy: error.remedy().to_owned(),
    }
}

fn relative(study: &Study, path: &Path) -> String {
    path.strip_prefix(&study.dir).unwrap_or(path).to_string_lossy().replace('\\', "/")
}
