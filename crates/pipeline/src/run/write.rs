//! Hands the rows of all sessions from the state to the sink. They are the same whether they were made now or in an earlier
//! run.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::time::Instant;

use ingest::Fingerprint;
use jiff::Timestamp;
use model::{ResultSink, RunLog, RunMetadata, SessionStatus, Stage};

use super::plan::SessionPlan;
use super::{Halted, RunError, RunOptions, keys};
use crate::inputs::{sha256_of_bytes, sha256_of_file};
use crate::session::{SessionOutput, log_problems};
use crate::study::{NAMES_FILE, SessionDir, Study};
use crate::work::{WorkFolder, Written};

/// Everything that the results are written from.
pub(super) struct Writing<'a> {
    pub study: &'a Study,
    pub options: &'a RunOptions,
    pub work: &'a WorkFolder,
    pub study_inputs: BTreeMap<String, String>,
}

impl<'a> Writing<'a> {
    /// Whether the files of results are there, and are what would be written now.
    pub fn is_done(&self, files: &[PathBuf]) -> Result<bool, Halted> {
        Ok(self.work.state.written()? == Some(self.written(files)?))
    }

    /// The sessions whose kept rows are damaged, as by a bad disk. They are forgotten, so that they are made again.
    pub fn damaged(&self, plans: &[SessionPlan<'a>]) -> Result<Vec<&'a SessionDir>, Halted> {
        let mut damaged = Vec::new();
        for plan in plans {
            if self.work.state.output(&plan.dir.name, Stage::Measure)?.is_none() {
                tracing::warn!(session = plan.dir.name, "what was kept of this session is damaged; it is made again");
                self.work.state.forget(&plan.dir.name)?;
                damaged.push(plan.dir);
            }
        }
        Ok(damaged)
    }

    /// Hands all rows and the metadata to the sink, and remembers in the state that it did.
    pub fn write<S: ResultSink>(
        &self,
        statuses: &BTreeMap<String, SessionStatus>,
        mut log: RunLog,
        start: Instant,
        sink: &mut S,
    ) -> Result<(), RunError<S::Error>> {
        let mut inputs_sha256 = self.study_inputs.clone();
        let made_now: BTreeSet<&str> = log.sessions.iter().map(|log| log.session.as_str()).collect();
        for (session, status) in statuses {
            if !made_now.contains(session.as_str()) {
                log_problems(status); // those of the others have been logged
            }
            let rows = self.rows_of(session)?;
            inputs_sha256.extend(in_short(session, rows.inputs_sha256));
            sink.session(rows.results, rows.frames).map_err(RunError::Sink)?;
        }
        let metadata = RunMetadata {
            program: self.options.program.clone(),
            commit: self.options.commit.clone(),
            study: self.study.spec.name.clone(),
            statement: self.study.spec.statement.clone(),
            settings: settings(self.study).map_err(Halted::from)?,
            tables: self.study.tables.clone(),
            sessions: statuses.values().cloned().collect(),
            inputs_sha256,
        };
        (log.finished_utc, log.seconds) = (Timestamp::now().to_string(), start.elapsed().as_secs_f64());
        sink.finish(&metadata, &log).map_err(RunError::Sink)?;
        self.work.state.set_written(&self.written(&sink.files())?).map_err(Halted::from)?;
        Ok(())
    }

    fn rows_of(&self, session: &str) -> Result<SessionOutput, Halted> {
        let text = self.work.state.output(session, Stage::Measure)?;
        let rows = text.and_then(|text| serde_json::from_str(&text).ok());
        rows.ok_or_else(|| Halted::NotKept(session.to_owned()))
    }

    /// The key and fingerprint of files of results that were written now.
    fn written(&self, files: &[PathBuf]) -> Result<Written, Halted> {
        let kept = self.work.state.kept_by_session()?;
        let rows_of =
            |dir: &SessionDir| Some((dir.name.clone(), kept.get(&dir.name)?.measure.as_ref()?.output_sha256.clone()));
        let rows: BTreeMap<String, String> = self.study.sessions.iter().filter_map(rows_of).collect();
        let key = keys::hash(&(self.options.program_and_commit(), &self.study_inputs, settings(self.study)?, rows))?;
        let mut fingerprint = Fingerprint::default();
        for file in files {
            fingerprint.add_file(&file.to_string_lossy(), file);
        }
        Ok(Written { key, files: fingerprint.hex() })
    }
}

/// The hashes with one line for all files of the card, since a year of cards would not fit into the metadata. Each recording
/// lists its own files.
fn in_short(session: &str, inputs_sha256: BTreeMap<String, String>) -> BTreeMap<String, String> {
    let card = format!("cards/{session}");
    let is_of_card = |file: &str| file.strip_prefix(&card).is_some_and(|rest| rest.starts_with('/'));
    let (of_card, mut others): (BTreeMap<_, _>, BTreeMap<_, _>) =
        inputs_sha256.into_iter().partition(|(file, _)| is_of_card(file));
    if !of_card.is_empty() {
        let line = |(file, sha256): (&String, &String)| format!("{sha256}  {}\n", &file[card.len() + 1..]);
        others.insert(card.clone(), sha256_of_bytes(of_card.iter().map(line).collect::<String>().as_bytes()));
    }
    others
}

fn settings(study: &Study) -> Result<serde_json::Value, serde_json::Error> {
    Ok(serde_json::json!({
        "study": study.spec,
        "camera": study.camera_spec,
        "marks_camera": study.marks_camera.as_ref().map(|(spec, _)| spec),
        "device_profile": study.profile,
        "calibration": study.calibration,
    }))
}

/// SHA-256 of each file that concerns the whole study.
pub(super) fn study_inputs(study: &Study) -> Result<BTreeMap<String, String>, Halted> {
    let mut files = vec!["study.toml".to_owned(), "objects.csv".to_owned()];
    files.extend(study.dir.join(NAMES_FILE).exists().then(|| NAMES_FILE.to_owned()));
    for printed in study.spec.tables.iter().filter_map(|table| table.printed.as_ref()) {
        files.push(printed.rows.clone());
        files.extend(printed.summaries.clone());
    }
    files.extend(device_files(&study.dir.join("devices")).into_iter().map(|name| format!("devices/{name}")));
    let hash = |file: String| {
        let path = study.dir.join(&file);
        sha256_of_file(&path).map(|sha| (file, sha)).map_err(|source| Halted::Input { path, source })
    };
    files.into_iter().map(hash).collect()
}

/// The names of the study's own profiles and cameras.
fn device_files(devices: &Path) -> Vec<String> {
    let names =
        std::fs::read_dir(devices).into_iter().flatten().filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    names.filter(|name| name.ends_with(".toml")).collect()
}
