//! The sessions of a study, by its folders.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::StudyError;

/// session.toml: the settings of one session. Unknown keys are refused.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SessionSpec {
    /// The participant who wore the camera.
    pub participant: Option<String>,
    /// The nominal height of the camera above the table, on a bench.
    pub setup_height_mm: Option<f64>,
    /// The nominal pitch, on a bench.
    pub setup_pitch_deg: Option<f64>,
    /// The session's camera, if it is not the study's.
    pub camera: Option<String>,
    /// The camera of the session's marked pictures, if those are not the raw ones.
    pub marks_camera: Option<String>,
    /// The time at which a clock that counts from the device's start was zero.
    pub clock_zero_utc: Option<jiff::Timestamp>,
}

/// The folders of one session.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SessionDir {
    /// The name of the session.
    pub name: String,
    /// The folder of the card; none when there are only marks.
    pub card: Option<PathBuf>,
    /// The folders of marks, by rater.
    pub marks: BTreeMap<String, PathBuf>,
}

impl SessionDir {
    /// The files of marks of all raters by name, in a defined order. A folder that cannot be listed stands for its files.
    #[must_use]
    pub fn marks_files(&self) -> Vec<(String, PathBuf)> {
        let of_rater = |(rater, dir): (&String, &PathBuf)| {
            let files = marks_in(dir).unwrap_or_else(|_| vec![dir.clone()]);
            let name = |path: &PathBuf| ingest::card::name_text(path.file_name().unwrap_or_default());
            files.into_iter().map(|path| (format!("{rater}/{}", name(&path)), path)).collect::<Vec<_>>()
        };
        self.marks.iter().flat_map(of_rater).collect()
    }
}

/// The files of marks in one rater's folder of a session, by name.
pub(crate) fn marks_in(dir: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut paths = std::fs::read_dir(dir)?.map(|entry| Ok(entry?.path())).collect::<std::io::Result<Vec<_>>>()?;
    paths.retain(|path| path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("json")));
    paths.sort();
    Ok(paths)
}

/// The name of a file without its folders and its extension. Marks and their image have the same one.
pub(crate) fn stem_of(file: &str) -> String {
    Path::new(file).file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default()
}

/// The sessions of a study, in the order of their names.
pub(super) fn find(study_dir: &Path) -> Result<Vec<SessionDir>, StudyError> {
    let mut sessions: BTreeMap<String, SessionDir> = BTreeMap::new();
    let mut session = |name: &str, fill: &dyn Fn(&mut SessionDir)| {
        let empty = || SessionDir { name: name.to_owned(), card: None, marks: BTreeMap::new() };
        fill(sessions.entry(name.to_owned()).or_insert_with(empty));
    };
    let cards = study_dir.join("cards");
    for (name, path) in folders(&cards)? {
        session(&name, &|s| s.card = Some(path.clone()));
    }
    let marks = study_dir.join("marks");
    if marks.is_dir() {
        for (rater, rater_dir) in folders(&marks)? {
            for (name, path) in folders(&rater_dir)? {
                session(&name, &|s| {
                    s.marks.insert(rater.clone(), path.clone());
                });
            }
        }
    }
    if sessions.is_empty() { Err(StudyError::NoSessions(cards)) } else { Ok(sessions.into_values().collect()) }
}

/// The folders inside `dir`, without hidden ones. Odd bytes of names are written as those of files on cards are, so that no
/// two sessions get the same name.
fn folders(dir: &Path) -> Result<Vec<(String, PathBuf)>, StudyError> {
    let refuse = |source| StudyError::List { path: dir.to_owned(), source };
    let mut named = Vec::new();
    for entry in std::fs::read_dir(dir).map_err(refuse)? {
        let entry = entry.map_err(refuse)?;
        let name = ingest::card::name_text(&entry.file_name());
        // Links are followed here, so that a linked card is not passed over, but becomes a problem, when it lies outside the
        // study, or leads nowhere because a disk is not connected.
        if std::fs::metadata(entry.path()).map_or(true, |metadata| metadata.is_dir()) && !name.starts_with('.') {
            named.push((name, entry.path()));
        }
    }
    named.sort();
    Ok(named)
}
