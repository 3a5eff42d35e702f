//! Step *marks*: collects the marks of a session by image and rater.
//!
//! - Input: the LabelMe files of every rater, the rims that the program found, the objects of objects.csv and the names of
//!   names.csv.
//! - Output: [`SessionMarks`], in which every object is known, and a problem for each mark that cannot be used.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use model::{FrameReason, ObjectMarks, Orientation, Problem, ProblemCode, Severity, Stage};

use super::beside::marks_beside_pictures;
use super::frames::Session;
use super::naming::Naming;
use super::problems::LINK_FACT;
use crate::inputs::sha256_of_bytes;
use crate::labelme::{self, AutoRim, MarksAuthor, MarksError, author_of};
use crate::study::{AUTO, Object, SessionDir, Study, marks_in, stem_of};
use rims::Found;

/// The marks of a session by image (file on the card), then by rater.
#[derive(Debug)]
pub(super) struct SessionMarks {
    by_image: BTreeMap<String, BTreeMap<String, Vec<MarkedObject>>>,
    naming: Naming,
}

/// The marks of one object on one image, with what is known of the object.
#[derive(Debug)]
pub(super) struct MarkedObject {
    pub marks: ObjectMarks,
    pub object: Object,
    /// The found rim, where the program made the marks.
    pub found: Option<Found>,
    /// Who made them as they are now.
    pub author: MarksAuthor,
}

/// The files of marks to read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reading {
    /// Those of all raters.
    All,
    /// Those of the rater [`AUTO`] that a person has made or corrected.
    Corrections,
}

impl MarkedObject {
    /// The marks with their object: the one of objects.csv, else the container that a found rim looks like. The marks come
    /// back as the error where neither is there.
    fn new(study: &Study, marks: ObjectMarks, found: Option<Found>, author: MarksAuthor) -> Result<Self, ObjectMarks> {
        let unlisted = || Some(Object { container: found?.container(), truth_mm: BTreeMap::new() });
        match study.objects.get(&marks.object).cloned().or_else(unlisted) {
            Some(object) => Ok(Self { marks, object, found, author }),
            None => Err(marks),
        }
    }
}

impl SessionMarks {
    /// No marks yet, and the names that names.csv gives to found containers of the session.
    pub(super) fn new(study: &Study, dir: &SessionDir) -> Self {
        Self { by_image: BTreeMap::new(), naming: Naming::for_session(study, dir) }
    }

    /// Reads files of raters. What cannot be used becomes a problem; the rest is kept. The SHA-256 of every file that could be read
    /// and is used is added to `inputs_sha256`.
    pub(super) fn read(
        &mut self,
        session: &Session<'_>,
        which: Reading,
        problems: &mut Vec<Problem>,
        inputs_sha256: &mut BTreeMap<String, String>,
    ) {
        let images = images_by_stem(session);
        if which == Reading::All {
            let orientation_of = |stem: &str| images.get(stem)?.first().map(|image| image.orientation);
            problems.extend(marks_beside_pictures(session, orientation_of));
        }
        let is_read = |rater: &str| which == Reading::All || rater == AUTO;
        for (rater, dir) in session.dir.marks.iter().filter(|(rater, _)| is_read(rater)) {
            for path in files_of(session, dir, problems) {
                let place = session.study.relative(&path);
                match self.read_file(session, &images, &path, which, problems, inputs_sha256).transpose() {
                    None => {}
                    Some(Ok((image, objects))) => {
                        let by_rater = self.by_image.entry(image).or_default();
                        if by_rater.insert(rater.clone(), objects).is_some() {
                            problems.push(twice(place));
                        }
                    }
                    Some(Err(problem)) => problems.push(problem),
                }
            }
        }
    }

    /// The image that a file belongs to, and the marks in the file by object; none where the file is not to be read.
    fn read_file(
        &mut self,
        session: &Session<'_>,
        images: &ImagesByStem<'_>,
        path: &Path,
        which: Reading,
        problems: &mut Vec<Problem>,
        inputs_sha256: &mut BTreeMap<String, String>,
    ) -> Result<Option<(String, Vec<MarkedObject>)>, Problem> {
        let place = session.study.relative(path);
        let refuse = |error: MarksError| {
            problem(error.code(), place.clone(), error.to_string(), "correct the marks in LabelMe and run again")
        };
        let bytes = labelme::read_bytes(path).map_err(refuse)?;
        if which == Reading::Corrections && author_of(&bytes) == MarksAuthor::Program {
            return Ok(None); // the rims of an earlier run: this one finds its own
        }
        inputs_sha256.insert(place.clone(), sha256_of_bytes(&bytes));
        let image = image_of(images, &stem_of(&path.to_string_lossy()), &place);
        let orientation = image.as_ref().map_or(Orientation::Upright, |image| image.orientation);
        let mut marks = labelme::parse(&bytes, path, session.marked_picture(orientation)).map_err(refuse)?;
        marks.refuse_four_corners(|object| session.study.is_round(object));
        problems.extend(marks.refused.into_iter().map(refuse));
        let image = image?.file;
        let with_found = |of: ObjectMarks| {
            let found = marks.found.get(&of.object).copied();
            (of, found)
        };
        let marked = marks.objects.into_iter().map(with_found).collect();
        let named = self.naming.rename(marked, &place, problems);
        Ok(Some((image.to_owned(), known_objects(session, named, marks.author, &place, problems))))
    }

    /// Adds the found rims as marks of rater [`AUTO`]. On an image for which that rater has a file, the file counts.
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
            let named = self.naming.rename(found, &session.place_of(image), problems);
            let marked = named
                .into_iter()
                .filter_map(|(marks, found)| MarkedObject::new(session.study, marks, found, MarksAuthor::Program).ok());
            by_rater.insert(AUTO.to_owned(), marked.collect());
        }
    }

    /// A problem for each line of names.csv that named nothing; `searched` says whether rims were looked for.
    pub(super) fn unused_names(&self, session: &Session<'_>, searched: bool) -> Vec<Problem> {
        self.naming.unused(&session.dir.name, searched)
    }

    /// The marks on one image, by rater.
    pub(super) fn of_image(&self, file: &str) -> impl Iterator<Item = (&String, &Vec<MarkedObject>)> {
        self.by_image.get(file).into_iter().flatten()
    }
}

fn twice(place: String) -> Problem {
    let fact = "a second file of this rater for the same image; it takes the place of the first".to_owned();
    problem(ProblemCode::MarksTwice, place, fact, "keep one of them")
}

fn files_of(session: &Session<'_>, dir: &Path, problems: &mut Vec<Problem>) -> Vec<PathBuf> {
    if !session.study.holds(dir) {
        let remedy = "copy the marks into the study";
        problems.push(problem(ProblemCode::LinkOutOfStudy, session.study.relative(dir), LINK_FACT.to_owned(), remedy));
        return Vec::new();
    }
    match marks_in(dir) {
        Ok(paths) => paths,
        Err(error) => {
            let fact = format!("cannot list the folder: {error}");
            problems.push(problem(
                ProblemCode::MarksUnreadable,
                session.study.relative(dir),
                fact,
                "check its permissions",
            ));
            Vec::new()
        }
    }
}

/// An image of the card; with the reason, where it was dropped.
struct Image<'a> {
    file: &'a str,
    orientation: Orientation,
    dropped: Option<FrameReason>,
}

type ImagesByStem<'a> = BTreeMap<String, Vec<Image<'a>>>;

fn images_by_stem<'a>(session: &'a Session<'_>) -> ImagesByStem<'a> {
    let used = session.frames.iter().map(|frame| Image {
        file: &frame.image.file,
        orientation: frame.image.orientation,
        dropped: None,
    });
    let dropped = session.dropped.iter().map(|image| Image {
        file: &image.file,
        orientation: Orientation::Upright,
        dropped: Some(image.reason),
    });
    let mut images = ImagesByStem::new();
    for image in used.chain(dropped) {
        images.entry(stem_of(image.file)).or_default().push(image);
    }
    images
}

/// The one image of the card with this name; an error where there is none, several, or it was dropped.
fn image_of<'i, 'a>(images: &'i ImagesByStem<'a>, stem: &str, place: &str) -> Result<&'i Image<'a>, Problem> {
    let refuse = |code, fact, remedy| Err(problem(code, place.to_owned(), fact, remedy));
    match images.get(stem).map(Vec::as_slice) {
        None | Some([]) => refuse(
            ProblemCode::MarksWithoutImage,
            format!("the card has no image named {stem}"),
            "give the file the image's name, or move it out of the marks",
        ),
        Some([image @ Image { dropped: None, .. }]) => Ok(image),
        Some([Image { dropped: Some(reason), .. }]) => refuse(
            ProblemCode::MarkedImageDropped,
            format!("its image was dropped: {}", reason.meaning()),
            "see the problem of the image itself",
        ),
        Some(several) => {
            let files: Vec<_> = several.iter().map(|image| image.file).collect();
            refuse(
                ProblemCode::AmbiguousMarks,
                format!("several images have this name: {}", files.join(", ")),
                "rename all but one in the copy of the card, and its marks",
            )
        }
    }
}

fn known_objects(
    session: &Session<'_>,
    marks: Vec<(ObjectMarks, Option<Found>)>,
    author: MarksAuthor,
    place: &str,
    problems: &mut Vec<Problem>,
) -> Vec<MarkedObject> {
    let (mut known, mut unknown) = (Vec::new(), Vec::new());
    for (marks, found) in marks {
        match MarkedObject::new(session.study, marks, found, author) {
            Ok(marked) => known.push(marked),
            Err(marks) => unknown.push(marks),
        }
    }
    for marks in unknown {
        let names: Vec<_> = session.study.objects.keys().map(String::as_str).collect();
        let fact = format!("object '{}' is not in objects.csv, which has: {}", marks.object, names.join(", "));
        let remedy = "add it to objects.csv, or correct the label in LabelMe";
        problems.push(problem(ProblemCode::UnknownObject, place.to_owned(), fact, remedy));
    }
    known
}

fn problem(code: ProblemCode, place: String, fact: String, remedy: &str) -> Problem {
    Problem { severity: Severity::Loss, stage: Stage::Marks, code, place, fact, remedy: remedy.to_owned() }
}
