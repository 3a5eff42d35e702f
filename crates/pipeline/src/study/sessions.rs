//! The sessions of a study, by its folders.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use ingest::card::{exact_name_text, name_text};
use ingest::{nfc, spelled_out};
use model::{Problem, ProblemCode, Severity, Stage};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};

use super::StudyError;
use super::misplaced::{self, is_wrong_way_round};

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
    #[serde(deserialize_with = "time_of_toml")]
    pub clock_zero_utc: Option<jiff::Timestamp>,
}

/// A time as text, or as TOML's own date-time. It must have its offset, as in `2025-06-01T12:00:00Z`.
fn time_of_toml<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<jiff::Timestamp>, D::Error> {
    #[derive(Deserialize)]
    #[serde(untagged, expecting = "expected a time with its offset, such as 2025-06-01T12:00:00Z")]
    enum Written {
        Text(String),
        Toml(toml::value::Datetime),
    }
    let text = match Written::deserialize(deserializer)? {
        Written::Text(text) => text,
        Written::Toml(time) => time.to_string(),
    };
    let wrong = |error| format!("'{text}' is no time with its offset, such as 2025-06-01T12:00:00Z: {error}");
    text.parse().map(Some).map_err(|error: jiff::Error| D::Error::custom(wrong(error)))
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
    /// The problems of how its folders and files are laid out in the study.
    pub problems: Vec<Problem>,
}

impl SessionDir {
    /// A session of which nothing is known but its name.
    #[must_use]
    pub fn new(name: &str) -> Self {
        Self { name: name.to_owned(), card: None, marks: BTreeMap::new(), problems: Vec::new() }
    }

    /// The files of marks of all raters by name, in a defined order. A folder that cannot be listed stands for its files.
    #[must_use]
    pub fn marks_files(&self) -> Vec<(String, PathBuf)> {
        let of_rater = |(rater, dir): (&String, &PathBuf)| {
            let files = marks_in(dir).unwrap_or_else(|_| vec![dir.clone()]);
            let name = |path: &PathBuf| exact_name_text(path.file_name().unwrap_or_default());
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

/// The name of a file without its folders and its extension, in the form in which names are compared. Marks and their image have
/// the same one.
pub(crate) fn stem_of(file: &str) -> String {
    Path::new(file).file_stem().map(|stem| nfc(stem.to_string_lossy())).unwrap_or_default()
}

/// The sessions of a study, in the order of their names. `reads_marks` says whether files of marks are read, so that those in a wrong
/// place are told.
pub(super) fn find(study_dir: &Path, reads_marks: bool) -> Result<Vec<SessionDir>, StudyError> {
    let mut sessions: BTreeMap<String, SessionDir> = BTreeMap::new();
    let cards_dir = study_dir.join("cards");
    let cards = folders(&cards_dir)?;
    for card in &cards {
        let alike: Vec<&Folder> = cards.iter().filter(|other| other.name == card.name).collect();
        let name = if alike.len() == 1 { &card.name } else { &card.exact };
        let session = sessions.entry(name.clone()).or_insert_with(|| SessionDir::new(name));
        session.card = Some(card.path.clone());
        if alike.len() > 1 {
            let spelled: Vec<String> = alike.iter().map(|folder| spelled_out(&folder.exact)).collect();
            let fact =
                "names of sessions are the same but for their Unicode form, so marks may be taken for the wrong one";
            session.problems.push(folders_alike(format!("cards/{name}"), format!("{fact}: {}", spelled.join(", "))));
        }
    }
    let marks_dir = study_dir.join("marks");
    if marks_dir.is_dir() {
        for rater in folders(&marks_dir)? {
            for marks in folders(&rater.path)? {
                if is_wrong_way_round(&rater.name, &marks.name, |name| is_card(&sessions, name)) {
                    continue; // it is told below
                }
                // Of sessions that look alike each has its exact name.
                let name = if sessions.contains_key(&marks.exact) { &marks.exact } else { &marks.name };
                if !sessions.contains_key(name) && marks_in(&marks.path).is_ok_and(|files| files.is_empty()) {
                    continue; // neither a card nor marks
                }
                let session = sessions.entry(name.clone()).or_insert_with(|| SessionDir::new(name));
                add_marks(session, &rater.name, marks.path, study_dir);
            }
        }
    }
    if reads_marks {
        misplaced::report(study_dir, &mut sessions);
    }
    if sessions.is_empty() { Err(StudyError::NoSessions(cards_dir)) } else { Ok(sessions.into_values().collect()) }
}

fn is_card(sessions: &BTreeMap<String, SessionDir>, name: &str) -> bool {
    sessions.get(name).is_some_and(|session| session.card.is_some())
}

/// Adds the folder of a rater's marks. Where the rater has one already, whose name is another form of the same, the first counts.
fn add_marks(session: &mut SessionDir, rater: &str, folder: PathBuf, study_dir: &Path) {
    if let Some(first) = session.marks.get(rater) {
        let spelled = |path: &Path| spelled_out(&path.strip_prefix(study_dir).unwrap_or(path).to_string_lossy());
        let fact = format!(
            "two folders of marks have the same name but for its Unicode form; {} is read, {} is not",
            spelled(first),
            spelled(&folder)
        );
        session.problems.push(folders_alike(format!("marks/{rater}/{}", session.name), fact));
        return;
    }
    session.marks.insert(rater.to_owned(), folder);
}

fn folders_alike(place: String, fact: String) -> Problem {
    let remedy = "rename one of them, or move the files of both into one".to_owned();
    Problem { severity: Severity::Loss, stage: Stage::Study, code: ProblemCode::FoldersAlike, place, fact, remedy }
}

/// A folder of a study.
struct Folder {
    /// The name, in the form in which names are compared.
    name: String,
    /// The name in its own form.
    exact: String,
    path: PathBuf,
}

/// The folders inside `dir`, without hidden ones, in the order of their names. Odd bytes of names are written as those of files on
/// cards are.
fn folders(dir: &Path) -> Result<Vec<Folder>, StudyError> {
    let refuse = |source| StudyError::List { path: dir.to_owned(), source };
    let mut folders = Vec::new();
    for entry in std::fs::read_dir(dir).map_err(refuse)? {
        let entry = entry.map_err(refuse)?;
        let (name, exact) = (name_text(&entry.file_name()), exact_name_text(&entry.file_name()));
        // Links are followed here, so that a linked card is not passed over, but becomes a problem, when it lies outside the
        // study, or leads nowhere because a disk is not connected.
        if std::fs::metadata(entry.path()).map_or(true, |metadata| metadata.is_dir()) && !name.starts_with('.') {
            folders.push(Folder { name, exact, path: entry.path() });
        }
    }
    folders.sort_by(|a, b| (&a.name, &a.exact).cmp(&(&b.name, &b.exact)));
    Ok(folders)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clock_zero(value: &str) -> Result<Option<String>, String> {
        let text = format!("clock_zero_utc = {value}\n");
        let spec = ingest::config::parse_toml::<SessionSpec>(&text, Path::new("session.toml"));
        spec.map(|spec| spec.clock_zero_utc.map(|time| time.to_string())).map_err(|error| error.to_string())
    }

    #[test]
    fn the_clock_s_zero_is_text_or_toml_s_own_date_time() {
        let three = Ok(Some("2021-03-01T15:00:00Z".to_owned()));
        for value in [
            "\"2021-03-01T15:00:00Z\"",
            "2021-03-01T15:00:00Z",
            "2021-03-01 15:00:00Z",
            "2021-03-01T09:00:00-06:00",
            "2021-03-01T15:00:00.000z",
        ] {
            assert_eq!(clock_zero(value), three, "{value}");
        }
        let fraction = clock_zero("2021-03-01T15:00:00.250+00:00");
        assert_eq!(fraction, Ok(Some("2021-03-01T15:00:00.25Z".to_owned())));
    }

    #[test]
    fn a_time_without_its_offset_or_without_its_day_is_refused() {
        for value in ["2021-03-01T15:00:00", "2021-03-01", "15:00:00", "1614610800", "\"yesterday\""] {
            let error = clock_zero(value).unwrap_err();
            assert!(
                error.contains("time with its offset") && error.contains("2025-06-01T12:00:00Z"),
                "{value}: {error}"
            );
        }
    }

    #[test]
    fn a_date_where_text_is_expected_says_that_quotes_are_missing() {
        let spec = ingest::config::parse_toml::<SessionSpec>("participant = 2021-03-01\n", Path::new("session.toml"));
        let error = spec.unwrap_err().to_string();
        assert!(error.contains("in quotes"), "{error}");
    }
}
