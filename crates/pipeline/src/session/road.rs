//! The road of one session: calls the steps in their order, and collects rows, problems and counts.

use std::path::{Path, PathBuf};

use ingest::IngestError;
use model::{FrameReason, Problem, ProblemCode, ResultRow, SessionStatus, Severity, Stage};

use super::auto::AutoMarks;
use super::bench::bench_session;
use super::card_progress::CardProgress;
use super::frames::Session;
use super::fuse::{disagreements, fuse};
use super::ledger::{ledger, ledger_of_failed};
use super::marked::marked;
use super::measurement::measure_all;
use super::output::SessionOutput;
use super::plausible;
use super::prepared::Prepared;
use super::problems::without_host;
use super::recording::{Recording, read as read_recording};
use super::session_marks::{Reading, SessionMarks};
use super::shown::Shown;
use crate::inputs::card_sketch;
use crate::reporter::Reporter;
use crate::stop::Stop;
use crate::study::{SessionDir, Study};

/// Settings of [`run_session`].
#[derive(Debug, Clone)]
pub(crate) struct SessionOptions {
    /// The folder for MCAP files.
    pub mcap_dir: PathBuf,
    /// Whether to survey cards only: their MCAP files have no pictures, and belong in a temporary folder.
    pub survey: bool,
    /// Whether the sessions are those of a bench: people's marks are then read whatever `[marks]` says, and the output holds
    /// the known sizes.
    pub is_bench: bool,
    /// The program and its version, for provenance.
    pub program: String,
    /// The wish to stop, from a signal or from inside.
    pub stop: Stop,
}

/// Takes one session from its card to rows without keeping anything but its MCAP file. Whatever goes wrong is in the status;
/// the rows hold what could be used.
pub(crate) fn run_session(
    study: &Study,
    dir: &SessionDir,
    options: &SessionOptions,
    reporter: &dyn Reporter,
) -> SessionOutput {
    let mut output =
        run_without_state(study, dir, options, reporter).unwrap_or_else(|problem| failed(study, dir, problem));
    finish_status(&mut output, study, &options.mcap_dir);
    output
}

fn run_without_state(
    study: &Study,
    dir: &SessionDir,
    options: &SessionOptions,
    reporter: &dyn Reporter,
) -> Result<SessionOutput, Problem> {
    let prepared = Prepared::new(study, dir, &options.program)?;
    let mcap = ingest_without_state(&prepared, options, reporter)?;
    reporter.stage(&dir.name, Stage::Signals);
    let recording = read_recording(study, &mcap, &dir.name)?;
    let measuring = Measuring { study, dir, prepared: &prepared, is_bench: options.is_bench, reporter };
    Ok(measuring.measure(recording, AutoMarks::default()))
}

/// Ingests or surveys a card, and returns the path of the MCAP file.
pub(crate) fn ingest_without_state(
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

/// The output of a session of which nothing could be used: its problem, and its images in the ledger.
pub(crate) fn failed(study: &Study, dir: &SessionDir, problem: Problem) -> SessionOutput {
    let frames = ledger_of_failed(study, dir);
    let (session, images) = (dir.name.clone(), frames.len());
    let problems = dir.problems.iter().cloned().chain([problem]).collect();
    let status = SessionStatus { session, failed: true, images, problems, ..SessionStatus::default() };
    SessionOutput { status, frames, ..SessionOutput::default() }
}

/// Removes paths of this machine from the problems of an output, and logs them.
pub(crate) fn finish_status(output: &mut SessionOutput, study: &Study, mcap_dir: &Path) {
    for problem in &mut output.status.problems {
        problem.fact = without_host(&problem.fact, study, mcap_dir);
    }
    log_problems(&output.status);
}

/// Logs losses as warnings. Notes are in the report, and are logged for those who ask for more.
pub(crate) fn log_problems(status: &SessionStatus) {
    let session = &status.session;
    for Problem { severity, stage, code, place, fact, remedy } in &status.problems {
        match severity {
            Severity::Loss => tracing::warn!(session, %stage, code = code.code(), place, remedy, "{fact}"),
            Severity::Note => tracing::info!(session, %stage, code = code.code(), place, remedy, "{fact}"),
        }
    }
}

/// The steps from a recording and the rims found in its pictures to rows.
pub(crate) struct Measuring<'a> {
    pub study: &'a Study,
    pub dir: &'a SessionDir,
    pub prepared: &'a Prepared,
    /// See [`SessionOptions::is_bench`].
    pub is_bench: bool,
    pub reporter: &'a dyn Reporter,
}

impl Measuring<'_> {
    /// The rows of the session, and how it fared.
    pub fn measure(&self, mut recording: Recording, auto: AutoMarks) -> SessionOutput {
        let Self { study, dir, prepared, .. } = *self;
        let mut output = SessionOutput::default();
        output.status.session.clone_from(&dir.name);
        output.status.problems.clone_from(&dir.problems);
        output.status.problems.append(&mut recording.problems);
        output.inputs_sha256.extend(prepared.session_toml_sha256.clone());
        let inputs = std::mem::take(&mut recording.inputs_sha256);
        output.status.card_sketch = card_sketch(inputs.values().map(String::as_str));
        output.inputs_sha256.extend(inputs.into_iter().map(|(file, sha)| (format!("cards/{}/{file}", dir.name), sha)));
        let mount_pitch_deg = study.spec.mount.pitch_offset_deg.unwrap_or(recording.mount_pitch_deg);
        let session = Session::new(study, dir, prepared, recording);
        output.status.problems.extend(plausible::problems(&session, prepared, mount_pitch_deg));
        self.reporter.stage(&dir.name, Stage::Marks);
        let marks = self.marks(&session, auto, &mut output);
        self.reporter.stage(&dir.name, Stage::Measure);
        let marked = marked(&session, &marks, &mut output.status.problems);
        if self.is_bench {
            output.bench = bench_session(&session, &marked);
        }
        output.shown = Shown::from_marked(&prepared.camera, &marked);
        let mut measurements = measure_all(&marked, &mut output.status.problems);
        let fused = fuse(study, &marked, &mut measurements);
        output.status.problems.extend(disagreements(&dir.name, &fused));
        let asked = |row: &ResultRow| study.spec.measure.methods.contains(&row.method);
        let measured = measurements.into_iter().map(|measurement| measurement.row);
        output.results = measured.filter(asked).chain(fused).collect();
        output.frames = ledger(&session, &marks, &output.results);
        count(&mut output, &session);
        output
    }

    /// The marks of people and of the program, as the study asks for them. A bench is measured by the marks of people.
    fn marks(&self, session: &Session<'_>, auto: AutoMarks, output: &mut SessionOutput) -> SessionMarks {
        let problems = &mut output.status.problems;
        let mut marks = SessionMarks::new(self.study, self.dir);
        let which =
            if self.study.spec.marks.source.reads_all() || self.is_bench { Reading::All } else { Reading::Corrections };
        marks.read(session, which, problems, &mut output.inputs_sha256);
        problems.extend(auto.problems);
        marks.add_found(session, &auto.by_image, problems);
        problems.extend(marks.unused_names(session, auto.searched));
        output.auto = auto.by_image;
        marks
    }
}

/// Sets the counts of the status, and adds the problem of a session without any pose.
fn count(output: &mut SessionOutput, session: &Session<'_>) {
    let status = &mut output.status;
    status.images = output.frames.len();
    status.with_pose = session.frames.iter().filter(|frame| frame.signals.pose.is_some()).count();
    let no_pose = no_pose(session, &status.problems);
    status.problems.extend(no_pose);
    status.selected = output.frames.iter().filter(|frame| frame.reason == FrameReason::Selected).count();
    status.sizes = output.results.iter().filter(|row| row.predicted_mm.is_some()).count();
}

/// The problem of a session whose ingest failed.
pub(crate) fn ingest_problem(session: &str, error: &IngestError) -> Problem {
    Problem {
        severity: Severity::Loss,
        stage: Stage::Ingest,
        code: error.code(),
        place: format!("cards/{session}"),
        fact: error.to_string(),
        remedy: error.remedy().to_owned(),
    }
}

/// The problem of a card none of whose images has a pose: times that do not fit, a dead sensor, or a profile that does not fit.
fn no_pose(session: &Session<'_>, known: &[Problem]) -> Option<Problem> {
    let reason = session.frames.first()?.signals.reason;
    let has_other_times = known.iter().any(|problem| problem.code == ProblemCode::NoCommonTime);
    let remedy = if has_other_times {
        "correct the times first, as the problem no_common_time says: zone, epoch or the clock's zero"
    } else if session.frames.iter().all(|frame| frame.signals.reason == FrameReason::NoRange) {
        "check the range sensor's files and its unit: readings below [signals] range_min_mm (30) do not count, which all are where metres or \
         centimetres are read as millimetres (mm_per_count of the device profile: 1000 or 10)"
    } else {
        "check the sensors' files, and axes, scales and mount offset of the device profile"
    };
    session.frames.iter().all(|frame| frame.signals.pose.is_none()).then(|| Problem {
        severity: Severity::Loss,
        stage: Stage::Signals,
        code: ProblemCode::NoImageWithPose,
        place: format!("cards/{}", session.dir.name),
        fact: format!("none of its {} images has a pose; of the first: {}", session.frames.len(), reason.meaning()),
        remedy: remedy.to_owned(),
    })
}
