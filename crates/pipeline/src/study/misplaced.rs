//! Files of marks that lie where none are read: without a folder of a rater or of a session, or in a folder too deep.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use ingest::card::{Card, name_text};
use model::{Problem, ProblemCode, Severity, Stage};

use super::{SessionDir, marks_in, stem_of};
use crate::labelme::is_labelme;

/// A name in commands, for a person to replace.
const RATER: &str = "RATER";
const SESSION: &str = "SESSION";

/// Files of marks that lie together in a folder where none are read.
struct Loose {
    /// The folder.
    folder: PathBuf,
    /// The rater and session that the folder's names give.
    rater: Option<String>,
    session: Option<String>,
}

/// Adds to each session the problems of marks that lie in a wrong place. Marks of no session become one, without a card, so that
/// they are told.
pub(super) fn report(study_dir: &Path, sessions: &mut BTreeMap<String, SessionDir>) {
    let cards: BTreeMap<String, PathBuf> =
        sessions.values().filter_map(|dir| Some((dir.name.clone(), dir.card.clone()?))).collect();
    let mut images = None;
    for loose in loose_folders(&study_dir.join("marks"), &cards) {
        let files = marks_in(&loose.folder).unwrap_or_default();
        let mut by_session: BTreeMap<Option<String>, Vec<PathBuf>> = BTreeMap::new();
        for file in &files {
            let session = if is_labelme(file) {
                let images = images.get_or_insert_with(|| sessions_by_image(&cards));
                loose.session.clone().or_else(|| only_session(images, file))
            } else {
                None
            };
            by_session.entry(session).or_default().push(file.clone());
        }
        for (session, of_session) in by_session {
            let is_all = of_session.len() == files.len();
            let problem = problem(study_dir, &loose, session.as_deref(), &of_session, is_all);
            let name = session.or_else(|| loose.rater.clone()).unwrap_or_else(|| "marks".to_owned());
            sessions.entry(name.clone()).or_insert_with(|| SessionDir::new(&name)).problems.push(problem);
        }
    }
}

/// The folders in and below `marks` that hold files where none are read.
fn loose_folders(marks: &Path, cards: &BTreeMap<String, PathBuf>) -> Vec<Loose> {
    let mut loose = vec![Loose { folder: marks.to_owned(), rater: None, session: None }];
    for (name, folder) in subfolders(marks) {
        let is_session = cards.contains_key(&name);
        let (rater, session) = if is_session { (None, Some(name.clone())) } else { (Some(name.clone()), None) };
        for (inner, inner_folder) in subfolders(&folder) {
            // `marks/SESSION/RATER`, the wrong way round, is a folder of no session.
            let is_inner_session = cards.contains_key(&inner);
            if is_session && !is_inner_session {
                let (rater, session) = (Some(inner.clone()), session.clone());
                loose.push(Loose { folder: inner_folder.clone(), rater, session });
            }
            for (deep, deep_folder) in subfolders(&inner_folder) {
                let named = [&deep, &inner].into_iter().find(|name| cards.contains_key(*name)).or(session.as_ref());
                let rater = if is_session && !is_inner_session { &inner } else { &name };
                loose.push(Loose { folder: deep_folder, rater: Some(rater.clone()), session: named.cloned() });
            }
        }
        loose.push(Loose { folder, rater, session });
    }
    loose
}

/// Whether `marks/OUTER/INNER` are a session and a rater, the wrong way round.
pub(super) fn is_wrong_way_round(outer: &str, inner: &str, is_card: impl Fn(&str) -> bool) -> bool {
    is_card(outer) && !is_card(inner)
}

fn subfolders(folder: &Path) -> Vec<(String, PathBuf)> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().filter_map(Result::ok);
    let named = entries.filter(|entry| entry.file_type().is_ok_and(|kind| kind.is_dir())).map(|entry| entry.path());
    let mut named: Vec<(String, PathBuf)> =
        named.map(|path| (name_text(path.file_name().unwrap_or_default()), path)).collect();
    named.retain(|(name, _)| !name.starts_with('.'));
    named.sort();
    named
}

/// The sessions that have an image, by the name that its marks would have.
fn sessions_by_image(cards: &BTreeMap<String, PathBuf>) -> BTreeMap<String, BTreeSet<String>> {
    let mut by_image: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (session, card) in cards {
        let files = Card::list(card).map(|card| card.files).unwrap_or_default();
        for file in files {
            by_image.entry(stem_of(&file.name)).or_default().insert(session.clone());
        }
    }
    by_image
}

fn only_session(by_image: &BTreeMap<String, BTreeSet<String>>, file: &Path) -> Option<String> {
    let sessions = by_image.get(&stem_of(&file.to_string_lossy()))?;
    sessions.first().filter(|_| sessions.len() == 1).cloned()
}

fn problem(study_dir: &Path, loose: &Loose, session: Option<&str>, files: &[PathBuf], is_all: bool) -> Problem {
    let folder = relative(study_dir, &loose.folder);
    let names: Vec<String> = files.iter().take(3).map(|file| name_text(file.file_name().unwrap_or_default())).collect();
    let more = if files.len() > names.len() { ", ..." } else { "" };
    let count = if files.len() == 1 { "1 file".to_owned() } else { format!("{} files", files.len()) };
    let fact = format!(
        "{count} of marks in a folder where none are read, but in marks/RATER/SESSION: {}{more}",
        names.join(", ")
    );
    let (rater, target) = (loose.rater.as_deref().unwrap_or(RATER), session.unwrap_or(SESSION));
    let remedy = if files.iter().all(|file| is_labelme(file)) {
        move_command(study_dir, &format!("marks/{rater}/{target}"), &loose.folder, files, is_all)
    } else {
        "if they are marks of another tool: aim-batch marks import STUDY FILE --rater RATER (docs/marks.md); else move them out \
         of marks"
            .to_owned()
    };
    misplaced(folder, fact, remedy)
}

/// The problem of marks in a wrong place.
pub(crate) fn misplaced(place: String, fact: String, remedy: String) -> Problem {
    Problem { severity: Severity::Loss, stage: Stage::Marks, code: ProblemCode::MarksMisplaced, place, fact, remedy }
}

/// The command that moves files of `folder` to `target`, for the study's folder. `is_all` says whether they are all JSON files there.
pub(crate) fn move_command(study_dir: &Path, target: &str, folder: &Path, files: &[PathBuf], is_all: bool) -> String {
    let is_plain = |file: &PathBuf| file.extension().is_some_and(|extension| extension == "json");
    let what = if is_all && files.len() > 1 && files.iter().all(is_plain) {
        format!("{}/*.json", quoted(&relative(study_dir, folder)))
    } else {
        files.iter().map(|file| quoted(&relative(study_dir, file))).collect::<Vec<_>>().join(" ")
    };
    let replace = [RATER, SESSION].into_iter().filter(|name| target.split('/').any(|part| part == *name));
    let replace = replace.map(|name| format!("{name} is the {}'s name", name.to_lowercase())).collect::<Vec<_>>();
    let replace = if replace.is_empty() { String::new() } else { format!(" ({})", replace.join(", ")) };
    let target = quoted(target);
    format!("in the study's folder: mkdir -p {target} && mv -n {what} {target}/{replace}")
}

fn relative(study_dir: &Path, path: &Path) -> String {
    path.strip_prefix(study_dir).unwrap_or(path).to_string_lossy().into_owned()
}

/// A word of a shell's command.
fn quoted(text: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "/._-".contains(c);
    if text.chars().all(is_plain) { text.to_owned() } else { format!("'{}'", text.replace('\'', r"'\''")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_quoted_for_a_shell() {
        assert_eq!(quoted("marks/A/S1.x"), "marks/A/S1.x");
        assert_eq!(quoted("it's 1"), r"'it'\''s 1'");
    }
}
