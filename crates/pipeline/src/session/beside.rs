//! Marks that lie beside the pictures on the card, where LabelMe puts them unless it is told otherwise.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use ingest::card::Card;
use model::Problem;

use super::frames::Session;
use crate::labelme;
use crate::study::{marks_in, misplaced, move_command, stem_of};

/// A problem for each folder of the card in which files of marks lie beside their pictures and are not among the study's marks.
pub(super) fn marks_beside_pictures(session: &Session<'_>, is_image: impl Fn(&str) -> bool) -> Vec<Problem> {
    let Some(Ok(card)) = session.dir.card.as_deref().map(Card::list) else { return Vec::new() };
    let mut by_folder: BTreeMap<PathBuf, (Vec<PathBuf>, usize)> = BTreeMap::new();
    for file in card.files {
        let is_json = file.name.rsplit_once('.').is_some_and(|(_, extension)| extension.eq_ignore_ascii_case("json"));
        let (true, Some(folder)) = (is_json && !file.name.starts_with('.'), file.path.parent()) else { continue };
        let (marks, others) = by_folder.entry(folder.to_owned()).or_default();
        if is_image(&stem_of(&file.name)) && labelme::is_labelme(&file.path) && !is_among_marks(session, &file.path) {
            marks.push(file.path);
        } else {
            *others += 1;
        }
    }
    by_folder.retain(|_, (marks, _)| !marks.is_empty());
    by_folder.into_iter().map(|(folder, (marks, others))| problem(session, &folder, &marks, others == 0)).collect()
}

/// Whether a rater has the same marks for the picture.
fn is_among_marks(session: &Session<'_>, beside: &Path) -> bool {
    let objects = |path: &Path| {
        let bytes = labelme::read_bytes(path).ok()?;
        labelme::parse(&bytes, path, session.marks_camera.size_px()).ok().map(|marks| marks.objects)
    };
    let Some(own) = objects(beside) else { return false };
    let stem = stem_of(&beside.to_string_lossy());
    let files = session.dir.marks.values().flat_map(|folder| marks_in(folder).unwrap_or_default());
    files.filter(|file| stem_of(&file.to_string_lossy()) == stem).any(|file| objects(&file).as_ref() == Some(&own))
}

fn problem(session: &Session<'_>, folder: &Path, marks: &[PathBuf], is_all: bool) -> Problem {
    let count = if marks.len() == 1 { "1 file".to_owned() } else { format!("{} files", marks.len()) };
    let first = marks.first().map(|path| session.study.relative(path)).unwrap_or_default();
    let fact = format!(
        "{count} of marks beside the pictures, where LabelMe puts them by default and none are read; first {first}"
    );
    let target = format!("marks/RATER/{}", session.dir.name);
    let command = move_command(&session.study.dir, &target, folder, marks, is_all);
    misplaced(session.study.relative(folder), fact, command)
}
