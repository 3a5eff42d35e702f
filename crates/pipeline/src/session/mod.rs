//! The road of one session: card -> MCAP -> signals -> marks -> sizes -> rows.

mod bench;
mod fuse;
mod lag;
mod ledger;
mod marks;
mod measurement;
mod problems;
mod read;
mod row;
mod surest;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use ingest::{DroppedImage, ImageEntry, IngestProgress, Ingested, SessionSource};
use model::{Camera, FrameRow, Problem, ResultRow, SessionStatus, Severity, Stage};

use crate::calibrate::BenchSession;
use crate::inputs::sha256_of_file;
use crate::reporter::Reporter;
use crate::signals::FrameSignals;
use crate::study::{SessionDir, SessionSpec, Study};
pub(crate) use ledger::ledger_of_failed;
use marks::SessionMarks;
pub(crate) use problems::without_host;
use problems::{MARKS_CAMERA_FACT, bad_camera, link_out_of_study, missing_card, no_pose};
use read::Read;

/// What one session gives.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SessionOutput {
    /// How it fared.
    pub status: SessionStatus,
    /// Sizes.
    pub results: Vec<ResultRow>,
    /// Every image.
    pub frames: Vec<FrameRow>,
    /// SHA-256 of what was read, by path relative to the study.
    pub inputs_sha256: BTreeMap<String, String>,
    /// Known sizes, for a calibration; only of a survey.
    pub bench: BenchSession,
}

/// Settings of a run that are not the study's.
#[derive(Debug, Clone)]
pub struct SessionOptions {
    /// Folder for MCAP files.
    pub mcap_dir: PathBuf,
    /// Whether to ingest cards again that have not changed.
    pub force: bool,
    /// Whether to survey cards only: MCAP files then have no pictures, and belong into a temporary folder.
    pub survey: bool,
    /// Program and version, for provenance.
    pub program: String,
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

/// Runs one session. Whatever goes wrong is in the status; what could be used is in the rows.
pub fn run_session(
    study: &Study,
    dir: &SessionDir,
    options: &SessionOptions,
    reporter: &dyn Reporter,
) -> SessionOutput {
    let mut output = SessionOutput::default();
    output.status.session.clone_from(&dir.name);
    if let Err(problem) = fill(study, dir, options, reporter, &mut output) {
        output.status.failed = true;
        output.status.problems.push(problem);
        output.frames = ledger_of_failed(study, dir);
        output.status.images = output.frames.len();
    }
    for problem in &mut output.status.problems {
        problem.fact = without_host(&problem.fact, study, &options.mcap_dir);
    }
    output.status.problems.iter().for_each(|problem| log(&dir.name, problem));
    output
}

/// Losses as warnings; notes are told in the report, and logged for those who ask for more.
fn log(session: &str, problem: &Problem) {
    let Problem { severity, stage, code, place, fact, remedy } = problem;
    match severity {
        Severity::Loss => tracing::warn!(session, %stage, code, place, remedy, "{fact}"),
        Severity::Note => tracing::info!(session, %stage, code, place, remedy, "{fact}"),
    }
}

fn fill(
    study: &Study,
    dir: &SessionDir,
    options: &SessionOptions,
    reporter: &dyn Reporter,
    output: &mut SessionOutput,
) -> Result<(), Problem> {
    let (spec, source, marks_camera) = source_of(study, dir, &options.program, output)?;
    reporter.stage(&dir.name, Stage::Ingest);
    let mcap = ingest_card(&source, options, reporter)?;
    reporter.stage(&dir.name, Stage::Signals);
    let Read { metadata, frames, notes } = read::read(study, &mcap, &dir.name)?;
    output.status.problems.extend(metadata.problems.iter().cloned().chain(notes));
    let on_card = metadata.inputs_sha256.iter().map(|(file, sha)| (format!("cards/{}/{file}", dir.name), sha.clone()));
    output.inputs_sha256.extend(on_card);
    let session = Session { study, dir, spec, marks_camera, frames, dropped: metadata.dropped_images };
    reporter.stage(&dir.name, Stage::Marks);
    let marks = SessionMarks::read(&session, output);
    reporter.stage(&dir.name, Stage::Measure);
    let marked = measurement::marked(&session, &marks, &mut output.status.problems);
    if options.survey {
        output.bench = bench::of(&session, &marked);
    }
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
    Ok(())
}

/// What a session is ingested from, and the camera of its marked pictures.
pub(crate) fn source_of(
    study: &Study,
    dir: &SessionDir,
    program: &str,
    output: &mut SessionOutput,
) -> Result<(SessionSpec, SessionSource, Camera), Problem> {
    let card = dir.card.as_deref().ok_or_else(|| missing_card(dir))?;
    if !study.holds(card) {
        return Err(link_out_of_study(dir));
    }
    let spec = session_spec(study, card, output)?;
    let (camera_spec, camera) = study.camera_of_session(&spec).map_err(|error| bad_camera(dir, error.to_string()))?;
    let marks_camera = study.marks_camera_of_session(&spec, camera);
    let marks_camera = marks_camera.map_err(|error| bad_camera(dir, error.to_string()))?;
    let marks_camera = marks_camera.ok_or_else(|| bad_camera(dir, MARKS_CAMERA_FACT.to_owned()))?;
    let source = SessionSource {
        session: dir.name.clone(),
        card_dir: card.to_owned(),
        profile: study.profile.clone(),
        camera_spec,
        time_zone: study.time_zone.clone(),
        clock_zero_utc: spec.clock_zero_utc,
        program: program.to_owned(),
    };
    Ok((spec, source, marks_camera))
}

fn session_spec(study: &Study, card: &Path, output: &mut SessionOutput) -> Result<SessionSpec, Problem> {
    let path = card.join("session.toml");
    if !path.is_file() {
        return Ok(SessionSpec::default());
    }
    let refuse = |fact: String| Problem {
        severity: Severity::Loss,
        stage: Stage::Study,
        code: "bad_session_toml".to_owned(),
        place: relative(study, &path),
        fact,
        remedy: "correct the file (docs/study.md)".to_owned(),
    };
    output.inputs_sha256.insert(relative(study, &path), sha256_of_file(&path).map_err(|e| refuse(e.to_string()))?);
    ingest::config::read_toml(&path).map_err(|error| refuse(error.to_string()))
}

/// Ingests a card, or surveys it; gives the MCAP file.
pub(crate) fn ingest_card(
    source: &SessionSource,
    options: &SessionOptions,
    reporter: &dyn Reporter,
) -> Result<PathBuf, Problem> {
    let mcap = options.mcap_dir.join(format!("{}.mcap", source.session));
    let progress = Progress { session: &source.session, reporter };
    let outcome = if options.survey {
        ingest::survey_session(source, &mcap, &progress).map(|summary| Ingested::Fresh(Box::new(summary)))
    } else if options.force {
        ingest::ingest_session(source, &mcap, &progress).map(|summary| Ingested::Fresh(Box::new(summary)))
    } else {
        ingest::ingest_if_changed(source, &mcap, &progress)
    };
    if let Ok(ingested) = &outcome {
        let what = if matches!(ingested, Ingested::Current) { "unchanged, MCAP file kept" } else { "ingested" };
        tracing::info!(session = source.session, "{what}");
    }
    outcome.map(|_| mcap).map_err(|error| Problem {
        severity: Severity::Loss,
        stage: Stage::Ingest,
        code: error.code().to_owned(),
        place: format!("cards/{}", source.session),
        fact: error.to_string(),
        remedy: error.remedy().to_owned(),
    })
}

struct Progress<'a> {
    session: &'a str,
    reporter: &'a dyn Reporter,
}

impl IngestProgress for Progress<'_> {
    fn begin(&self, bytes: u64) {
        self.reporter.bytes_to_read(self.session, bytes);
    }

    fn advance(&self, bytes: u64) {
        self.reporter.bytes_read(self.session, bytes);
    }
}

fn relative(study: &Study, path: &Path) -> String {
    path.strip_prefix(&study.dir).unwrap_or(path).to_string_lossy().replace('\\', "/")
}
