//! The marks of a session: LabelMe files of every rater, matched with its images and the study's objects.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use model::{ObjectMarks, Problem, Stage};

use super::{Session, SessionOutput, relative};
use crate::inputs::sha256_of_bytes;
use crate::labelme::{self, MarksError};

/// Marks by image (file on the card), then rater.
#[derive(Debug, Default)]
pub(super) struct SessionMarks {
    by_image: BTreeMap<String, BTreeMap<String, Vec<ObjectMarks>>>,
}

impl SessionMarks {
    /// Reads the marks of all raters. What cannot be used becomes a problem; the rest is kept.
    pub(super) fn read(session: &Session<'_>, output: &mut SessionOutput) -> Self {
        let mut marks = Self::default();
        for (rater, dir) in &session.dir.marks {
            for file in files_of(session, dir, &mut output.status.problems) {
                match read_file(session, &file, output) {
                    Ok(Some((image, objects))) => {
                        marks.by_image.entry(image).or_default().insert(rater.clone(), objects);
                    }
                    Ok(None) => {}
                    Err(problem) => output.status.problems.push(problem),
                }
            }
        }
        marks
    }

    /// Marks on one image, by rater.
    pub(super) fn of_image(&self, file: &str) -> impl Iterator<Item = (&String, &Vec<ObjectMarks>)> {
        self.by_image.get(file).into_iter().flatten()
    }
}

fn files_of(session: &Session<'_>, dir: &Path, problems: &mut Vec<Problem>) -> Vec<PathBuf> {
    match std::fs::read_dir(dir).and_then(|entries| entries.map(|e| Ok(e?.path())).collect::<Result<Vec<_>, _>>()) {
        Ok(mut paths) => {
            paths.retain(|path| path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("json")));
            paths.sort();
            paths
        }
        Err(error) => {
            let fact = format!("cannot list the folder: {error}");
            problems.push(problem("marks_unreadable", relative(session.study, dir), fact, "check its permissions"));
            Vec::new()
        }
    }
}

/// The image that a file belongs to, and its marks by object; none for an image that was dropped (which is a problem of
/// its own).
fn read_file(
    session: &Session<'_>,
    path: &Path,
    output: &mut SessionOutput,
) -> Result<Option<(String, Vec<ObjectMarks>)>, Problem> {
    let place = relative(session.study, path);
    let camera = session.study.marks_camera.as_ref().unwrap_or(&session.camera);
    let refuse = |error: MarksError| {
        problem(error.code(), place.clone(), error.to_string(), "correct the marks in LabelMe and run again")
    };
    let bytes = labelme::read_bytes(path).map_err(refuse)?;
    output.inputs_sha256.insert(place.clone(), sha256_of_bytes(&bytes));
    let marks = labelme::parse(&bytes, path, camera.size_px()).map_err(refuse)?;
    output.status.problems.extend(marks.refused.into_iter().map(refuse));
    let stem = path.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
    if let Some(image) = session.dropped.iter().find(|image| stem_of(&image.file) == stem) {
        let fact = format!("its image was dropped: {}", image.reason.meaning());
        output.status.problems.push(problem(
            "marked_image_dropped",
            place,
            fact,
            "see the problem of the image itself",
        ));
        return Ok(None);
    }
    let images: BTreeSet<&str> =
        session.frames.iter().map(|f| f.image.file.as_str()).filter(|file| stem_of(file) == stem).collect();
    let mut images = images.into_iter();
    match (images.next(), images.next()) {
        (Some(image), None) => Ok(Some((image.to_owned(), known_objects(session, marks.objects, &place, output)))),
        (Some(one), Some(other)) => Err(problem(
            "ambiguous_marks",
            place,
            format!("two images have this name: {one} and {other}"),
            "rename one of them on the card's copy, and its marks",
        )),
        (None, _) => Err(problem(
            "marks_without_image",
            place,
            format!("the card has no image named {stem}"),
            "give the file the image's name, or remove it",
        )),
    }
}

fn known_objects(
    session: &Session<'_>,
    marks: Vec<ObjectMarks>,
    place: &str,
    output: &mut SessionOutput,
) -> Vec<ObjectMarks> {
    let (known, unknown): (Vec<_>, Vec<_>) =
        marks.into_iter().partition(|marks| session.study.objects.contains_key(&marks.object));
    for marks in unknown {
        let names: Vec<_> = session.study.objects.keys().map(String::as_str).collect();
        let fact = format!("object '{}' is not in objects.csv, which has: {}", marks.object, names.join(", "));
        let remedy = "add it to objects.csv, or correct the label in LabelMe";
        output.status.problems.push(problem("unknown_object", place.to_owned(), fact, remedy));
    }
    known
}

fn stem_of(file: &str) -> String {
    Path::new(file).file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default()
}

fn problem(code: &str, place: String, fact: String, remedy: &str) -> Problem {
    Problem { stage: Stage::Marks, code: code.to_owned(), place, fact, remedy: remedy.to_owned() }
}
