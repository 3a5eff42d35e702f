//! Gives found containers the names of the objects that they are, by names.csv.

use std::collections::{BTreeMap, BTreeSet};

use model::{ObjectMarks, Problem, ProblemCode, Severity, Stage};

use crate::study::{NAMES_FILE, Named, SessionDir, Study, number_of_found};
use rims::Found;

/// The marks on one image by object; with the found rim where the program made them.
pub(super) type Marks = Vec<(ObjectMarks, Option<Found>)>;

/// The names of one session, and which of them have been used.
#[derive(Debug, Default)]
pub(super) struct Naming {
    names: BTreeMap<String, Named>,
    used: BTreeSet<String>,
    /// Whether any container that names.csv could name was met.
    met: bool,
}

impl Naming {
    pub fn for_session(study: &Study, dir: &SessionDir) -> Self {
        Self { names: study.names.get(&dir.name).cloned().unwrap_or_default(), ..Self::default() }
    }

    /// The marks of one image, each under the name of its object. Where two get the same name, marks that a person gave that
    /// name come first, then the likelier rim; the other one is left out, with a problem at `place`.
    pub fn rename(&mut self, marks: Marks, place: &str, problems: &mut Vec<Problem>) -> Marks {
        let mut by_object: BTreeMap<String, (String, ObjectMarks, Option<Found>)> = BTreeMap::new();
        for (marks, found) in marks {
            self.met |= number_of_found(&marks.object).is_some();
            let was = marks.object.clone();
            let named = self.names.get(&was);
            self.used.extend(named.map(|_| was.clone()));
            let object = named.map_or_else(|| was.clone(), |named| named.object.clone());
            let this = (was, ObjectMarks { object: object.clone(), ..marks }, found);
            match by_object.remove(&object) {
                None => by_object.insert(object, this),
                Some(other) => {
                    let (kept, left) = if surety(&this) > surety(&other) { (this, other) } else { (other, this) };
                    problems.push(twice(&kept.0, &left.0, &object, place));
                    by_object.insert(object, kept)
                }
            };
        }
        by_object.into_values().map(|(_, marks, found)| (marks, found)).collect()
    }

    /// A problem for each name that no container of the session has, where one was looked for.
    pub fn unused(&self, session: &str, searched: bool) -> Vec<Problem> {
        let is_unused = |(found, _): &(&String, &Named)| (searched || self.met) && !self.used.contains(*found);
        self.names.iter().filter(is_unused).map(|(found, named)| not_found(found, named, session)).collect()
    }
}

/// The rank among marks of one name: those that a person gave it come first, then those that a person made, then the
/// likelier rim.
fn surety((was, marks, found): &(String, ObjectMarks, Option<Found>)) -> (bool, f64) {
    (*was == marks.object, found.map_or(f64::INFINITY, |found| found.confidence))
}

fn twice(kept: &str, left: &str, object: &str, place: &str) -> Problem {
    problem(
        ProblemCode::NamedTwice,
        place.to_owned(),
        format!("'{kept}' and '{left}' are both '{object}' and both in this image; '{left}' is left out"),
        "take the wrong one out of names.csv, or name it as another object",
    )
}

fn not_found(found: &str, Named { object, line }: &Named, session: &str) -> Problem {
    problem(
        ProblemCode::NameNotFound,
        format!("{NAMES_FILE} line {line}"),
        format!("nothing in session '{session}' is named '{found}', so '{object}' has no size from it"),
        "look up the names in the results, which change with the settings, or take the line out",
    )
}

fn problem(code: ProblemCode, place: String, fact: String, remedy: &str) -> Problem {
    let remedy = remedy.to_owned();
    Problem { severity: Severity::Loss, stage: Stage::Marks, code, place, fact, remedy }
}

#[cfg(test)]
mod tests {
    use model::{Kind, Shape};

    use super::*;
    use rims::{HeightSource, RimHeight};

    fn naming() -> Naming {
        let named = |line| Named { object: "dinner plate".to_owned(), line };
        let names = [("auto-1", 2), ("auto-3", 3)].map(|(found, line)| (found.to_owned(), named(line)));
        Naming { names: BTreeMap::from(names), ..Naming::default() }
    }

    fn rim(object: &str, confidence: Option<f64>) -> (ObjectMarks, Option<Found>) {
        let height = RimHeight { mm: 20.0, sigma_mm: 5.0, source: HeightSource::Common };
        let found = |confidence| Found {
            kind: Kind::Plate,
            shape: Shape::Circle,
            confidence,
            perimeter_px: 500.0,
            height,
            plate_height: Some(height),
        };
        (ObjectMarks { object: object.to_owned(), marks: Vec::new() }, confidence.map(found))
    }

    fn named(naming: &mut Naming, marks: Marks) -> (Vec<(String, Option<f64>)>, Vec<Problem>) {
        let mut problems = Vec::new();
        let named = naming.rename(marks, "cards/S1/a.jpg", &mut problems);
        let short = |(marks, found): (ObjectMarks, Option<Found>)| (marks.object, found.map(|found| found.confidence));
        (named.into_iter().map(short).collect(), problems)
    }

    #[test]
    fn a_found_container_gets_the_name_of_its_object() {
        let mut naming = naming();
        let (marks, problems) = named(&mut naming, vec![rim("auto-2", Some(0.7)), rim("auto-3", Some(0.9))]);
        assert_eq!(marks, [("auto-2".to_owned(), Some(0.7)), ("dinner plate".to_owned(), Some(0.9))]);
        assert_eq!(problems, []);
        let unused = naming.unused("S1", true);
        assert!(matches!(unused.as_slice(), [one] if one.place == "names.csv line 2"), "{unused:?}");
    }

    #[test]
    fn of_two_of_one_name_in_one_image_the_surer_counts() {
        let (marks, problems) = named(&mut naming(), vec![rim("auto-1", Some(0.6)), rim("auto-3", Some(0.9))]);
        assert_eq!(marks, [("dinner plate".to_owned(), Some(0.9))]);
        assert!(
            matches!(problems.as_slice(), [one] if one.code.code() == "named_twice" && one.fact.contains("'auto-1' is left out"))
        );
        let by_hand = vec![rim("auto-1", Some(0.99)), rim("dinner plate", Some(0.5)), rim("auto-3", None)];
        let (marks, problems) = named(&mut naming(), by_hand);
        assert_eq!((marks, problems.len()), (vec![("dinner plate".to_owned(), Some(0.5))], 2), "a person named it");
    }

    #[test]
    fn nothing_is_missed_where_nobody_looked() {
        assert_eq!(naming().unused("S1", false), []);
        let mut met = naming();
        named(&mut met, vec![rim("auto-1", None)]);
        assert_eq!(met.unused("S1", false).len(), 1, "files of marks have found containers");
    }
}
