//! names.csv, which says which objects the containers are that the program found.

use std::collections::BTreeMap;
use std::path::Path;

use ingest::nfc;
use serde::{Deserialize, Serialize};

use super::csv_file::read_rows;
use super::{Object, SessionDir, StudyError};

/// The rater of found rims.
pub(crate) const AUTO: &str = "auto";
/// The name of the file in a study.
pub(crate) const NAMES_FILE: &str = "names.csv";
/// The beginning of the names of found containers; a number follows.
pub(crate) const FOUND: &str = "auto-";

/// The object that a found container is said to be.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Named {
    /// The object of objects.csv.
    pub object: String,
    /// The line of names.csv that says so, from 1.
    pub line: u64,
}

/// The objects of found containers, by session and by the container's name there (`auto-1`).
pub type Names = BTreeMap<String, BTreeMap<String, Named>>;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Line {
    session: String,
    found: String,
    object: String,
}

/// The number in the name of a found container: 3 of `auto-3`.
pub(crate) fn number_of_found(name: &str) -> Option<u32> {
    let digits = name.strip_prefix(FOUND)?;
    digits.parse().ok().filter(|number: &u32| number.to_string() == digits && *number > 0)
}

/// The names of names.csv; none where there is no such file.
pub(super) fn read_names(
    path: &Path,
    objects: &BTreeMap<String, Object>,
    sessions: &[SessionDir],
) -> Result<Names, StudyError> {
    let mut names = Names::new();
    if !path.try_exists().map_err(|source| StudyError::Unreadable { path: path.to_owned(), source })? {
        return Ok(names);
    }
    for (line, Line { session, found, object }) in read_rows::<Line>(path)? {
        let (session, object) = (nfc(session), nfc(object));
        let refuse = |fact: String| Err(StudyError::Line { path: path.to_owned(), line, fact });
        if !sessions.iter().any(|dir| dir.name == session) {
            return refuse(format!("session '{session}' is not in the study (a folder of cards/)"));
        }
        if number_of_found(&found).is_none() {
            return refuse(format!("found '{found}': expected a name as in the results, such as {FOUND}1"));
        }
        if !objects.contains_key(&object) {
            let known: Vec<&str> = objects.keys().map(String::as_str).collect();
            return refuse(format!("object '{object}' is not in objects.csv, which has: {}", known.join(", ")));
        }
        let before = names.entry(session.clone()).or_default().insert(found.clone(), Named { object, line });
        if let Some(before) = before {
            return refuse(format!("'{found}' of session '{session}' has a name already, on line {}", before.line));
        }
    }
    Ok(names)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use model::{Container, Kind, Shape};

    use super::*;

    fn read(text: &str) -> Result<Names, StudyError> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(NAMES_FILE);
        std::fs::write(&path, text).unwrap();
        let container = Container { kind: Kind::Plate, shape: Shape::Circle, rim_height_mm: None, wall: None };
        let object = Object { container, truth_mm: BTreeMap::new() };
        let objects = BTreeMap::from([("dinner plate".to_owned(), object)]);
        let session = SessionDir::new;
        read_names(&path, &objects, &[session("S1"), session("S2")])
    }

    #[test]
    fn containers_are_named_by_session() {
        let text = "session,found,object\nS1,auto-1,dinner plate\n# both pieces of one\nS1,auto-12,dinner plate\nS2,auto-1,dinner plate\n";
        let names = read(text).unwrap();
        assert_eq!(names["S1"].keys().collect::<Vec<_>>(), ["auto-1", "auto-12"]);
        assert_eq!(names["S2"]["auto-1"], Named { object: "dinner plate".to_owned(), line: 5 });
    }

    #[test]
    fn what_is_wrong_is_said_with_file_and_line() {
        for (line, expected) in [
            ("S3,auto-1,dinner plate", "session 'S3' is not in the study"),
            ("S1,auto-1,soup plate", "'soup plate' is not in objects.csv, which has: dinner plate"),
            ("S1,auto-01,dinner plate", "found 'auto-01': expected"),
            ("S1,auto-0,dinner plate", "found 'auto-0': expected"),
            ("S1,plate,dinner plate", "such as auto-1"),
            ("S1,auto-2,dinner plate", "has a name already, on line 2"),
            ("S1,auto-3", "expected 3 columns"),
        ] {
            let error =
                read(&format!("session,found,object\nS1,auto-2,dinner plate\n{line}\n")).unwrap_err().to_string();
            assert!(error.starts_with("line 3:") && error.contains(expected), "{error}");
            assert!(error.ends_with(NAMES_FILE), "{error}");
        }
    }

    #[test]
    fn a_session_is_named_in_either_unicode_form() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(NAMES_FILE);
        std::fs::write(&path, "session,found,object\nmu\u{308}ller,auto-1,gru\u{308}n\n").unwrap();
        let container = Container { kind: Kind::Plate, shape: Shape::Circle, rim_height_mm: None, wall: None };
        let object = Object { container, truth_mm: BTreeMap::new() };
        let objects = BTreeMap::from([("gr\u{fc}n".to_owned(), object)]);
        let names = read_names(&path, &objects, &[SessionDir::new("m\u{fc}ller")]).unwrap();
        assert_eq!(names["m\u{fc}ller"]["auto-1"].object, "gr\u{fc}n");
    }

    #[test]
    fn no_file_names_nothing() {
        assert_eq!(read_names(Path::new("no such folder/names.csv"), &BTreeMap::new(), &[]).unwrap(), Names::new());
    }
}
