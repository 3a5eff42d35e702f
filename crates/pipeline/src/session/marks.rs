//! The marks of a session: LabelMe files of every rater, matched with its images and the study's objects.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use model::{FrameReason, ObjectMarks, Problem, Severity, Stage};

use super::auto::{AUTO, container_of};
use super::naming::Naming;
use super::problems::LINK_FACT;
use super::{Session, SessionOutput, relative};
use crate::inputs::sha256_of_bytes;
use crate::labelme::{self, AutoRim, MarksError};
use rims::Found;
use crate::study::{Object, Study, marks_in};

/// Marks by image (file on the card), then rater.
#[derive(Debug, Default)]
pub(super) struct SessionMarks {
    by_image: BTreeMap<String, BTreeMap<String, Vec<MarkedObject>>>,
    naming: Naming,
}

/// The marks of one object on one image, and what is known of it.
#[derive(Debug)]
pub(super) struct MarkedObject {
    pub marks: ObjectMarks,
    pub object: Object,
    /// Where the program found it itself.
    pub found: Option<Found>,
}

impl MarkedObject {
    /// An object of objects.csv, or one that was found; else none.
    fn new(study: &Study, marks: ObjectMarks, found: Option<Found>) -> Result<Self, ObjectMarks> {
        let unlisted = || Some(Object { container: container_of(found.as_ref()?), truth_mm: BTreeMap::new() });
        match study.objects.get(&marks.object).cloned().or_else(unlisted) {
            Some(object) => Ok(Self { marks, object, found }),
            None => Err(marks),
        }
    }
}

impl SessionMarks {
    /// Reads the marks of all raters. What cannot be used becomes a problem; the rest is kept.
    pub(super) fn read(session: &Session<'_>, output: &mut SessionOutput) -> Self {
        let mut marks = Self { naming: Naming::of(session.study, session.dir), ..Self::default() };
        // A bench is measured by what people marked.
        if !(session.study.spec.marks.source.reads() || session.study.is_bench) {
            return marks;
        }
        let images = images_by_stem(session);
        for (rater, dir) in &session.dir.marks {
            for file in files_of(session, dir, &mut output.status.problems) {
                match marks.read_file(session, &images, &file, output) {
                    Ok(Some((image, objects))) => {
                        let by_rater = marks.by_image.entry(image).or_default();
                        if by_rater.insert(rater.clone(), objects).is_some() {
                            output.status.problems.push(twice(relative(session.study, &file)));
                        }
                    }
                    Ok(None) => {}
                    Err(problem) => output.status.problems.push(problem),
                }
            }
        }
        marks
    }

    /// The image that a file belongs to, and its marks by object; none for an image that was dropped (which is a problem of
    /// its own).
    fn read_file(
        &mut self,
        session: &Session<'_>,
        images: &ImagesByStem<'_>,
        path: &Path,
        output: &mut SessionOutput,
    ) -> Result<Option<(String, Vec<MarkedObject>)>, Problem> {
        let place = relative(session.study, path);
        let refuse = |error: MarksError| {
            problem(error.code(), place.clone(), error.to_string(), "correct the marks in LabelMe and run again")
        };
        let bytes = labelme::read_bytes(path).map_err(refuse)?;
        output.inputs_sha256.insert(place.clone(), sha256_of_bytes(&bytes));
        let marks = labelme::parse(&bytes, path, session.marks_camera.size_px()).map_err(refuse)?;
        output.status.problems.extend(marks.refused.into_iter().map(refuse));
        let stem = stem_of(&path.to_string_lossy());
        match images.get(&stem).map(Vec::as_slice) {
            None | Some([]) => Err(problem(
                "marks_without_image",
                place,
                format!("the card has no image named {stem}"),
                "give the file the image's name, or remove it",
            )),
            Some([Image { file, dropped: None }]) => {
                let found = |of: ObjectMarks| {
                    let found = marks.found.get(&of.object).copied();
                    (of, found)
                };
                let marked = marks.objects.into_iter().map(found).collect();
                let named = self.naming.named(marked, &place, &mut output.status.problems);
                Ok(Some(((*file).to_owned(), known_objects(session, named, &place, output))))
            }
            Some([Image { dropped: Some(reason), .. }]) => {
                let fact = format!("its image was dropped: {}", reason.meaning());
                let remedy = "see the problem of the image itself";
                output.status.problems.push(problem("marked_image_dropped", place, fact, remedy));
                Ok(None)
            }
            Some(several) => {
                let files: Vec<_> = several.iter().map(|image| image.file).collect();
                let fact = format!("several images have this name: {}", files.join(", "));
                Err(problem(
                    "ambiguous_marks",
                    place,
                    fact,
                    "rename all but one in the copy of the card, and its marks",
                ))
            }
        }
    }

    /// Adds what the program found, as rater [`AUTO`]. A file of that rater comes first.
    pub(super) fn add_found(
        &mut self,
        session: &Session<'_>,
        by_image: &BTreeMap<String, Vec<AutoRim>>,
        problems: &mut Vec<Problem>,
    ) {
        for (image, rims) in by_image {
            let by_rater = self.by_image.entry(image.clone()).or_default();
            if by_rater.contains_key(AUTO) {
                continue;
            }
            let found = rims.iter().map(|rim| (rim.marks(), Some(rim.found))).collect();
            let named = self.naming.named(found, &session.place_of(image), problems);
            let marked =
                named.into_iter().filter_map(|(marks, found)| MarkedObject::new(session.study, marks, found).ok());
            by_rater.insert(AUTO.to_owned(), marked.collect());
        }
    }

    /// Lines of names.csv that named nothing; `searched`: whether rims were looked for.
    pub(super) fn unused_names(&self, session: &Session<'_>, searched: bool) -> Vec<Problem> {
        self.naming.unused(&session.dir.name, searched)
    }

    /// Marks on one image, by rater.
    pub(super) fn of_image(&self, file: &str) -> impl Iterator<Item = (&String, &Vec<MarkedObject>)> {
        self.by_image.get(file).into_iter().flatten()
    }
}

fn twice(place: String) -> Problem {
    let fact = "a second file of this rater for the same image; it takes the place of the first".to_owned();
    problem("marks_twice", place, fact, "keep one of them")
}

fn files_of(session: &Session<'_>, dir: &Path, problems: &mut Vec<Problem>) -> Vec<PathBuf> {
    if !session.study.holds(dir) {
        let remedy = "copy the marks into the study";
        problems.push(problem("link_out_of_study", relative(session.study, dir), LINK_FACT.to_owned(), remedy));
        return Vec::new();
    }
    match marks_in(dir) {
        Ok(paths) => paths,
        Err(error) => {
            let fact = format!("cannot list the folder: {error}");
            problems.push(problem(
                labelme::MARKS_UNREADABLE,
                relative(session.study, dir),
                fact,
                "check its permissions",
            ));
            Vec::new()
        }
    }
}

/// An image of the card, used or dropped.
struct Image<'a> {
    file: &'a str,
    dropped: Option<FrameReason>,
}

type ImagesByStem<'a> = BTreeMap<String, Vec<Image<'a>>>;

fn images_by_stem<'a>(session: &'a Session<'_>) -> ImagesByStem<'a> {
    let used = session.frames.iter().map(|frame| Image { file: &frame.image.file, dropped: None });
    let dropped = session.dropped.iter().map(|image| Image { file: &image.file, dropped: Some(image.reason) });
    let mut images = ImagesByStem::new();
    for image in used.chain(dropped) {
        images.entry(stem_of(image.file)).or_default().push(image);
    }
    images
}

fn known_objects(
    session: &Session<'_>,
    marks: Vec<(ObjectMarks, Option<Found>)>,
    place: &str,
    output: &mut SessionOutput,
) -> Vec<MarkedObject> {
    let (mut known, mut unknown) = (Vec::new(), Vec::new());
    for (marks, found) in marks {
        match MarkedObject::new(session.study, marks, found) {
            Ok(marked) => known.push(marked),
            Err(marks) => unknown.push(marks),
        }
    }
    for marks in unknown {
        let names: Vec<_> = session.study.objects.keys().map(String::as_str).collect();
        let fact = format!("object '{}' is not in objects.csv, which has: {}", marks.object, names.join(", "));
        let remedy = "add it to objects.csv, or correct the label in LabelMe";
        output.status.problems.push(problem("unknown_object", place.to_owned(), fact, remedy));
    }
    known
}

pub(crate) fn stem_of(file: &str) -> String {
    Path::new(file).file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default()
}

fn problem(code: &str, place: String, fact: String, remedy: &str) -> Problem {
    Problem {
        severity: Severity::Loss,
        stage: Stage::Marks,
        code: code.to_owned(),
        place,
        fact,
        remedy: remedy.to_owned(),
    }
}
