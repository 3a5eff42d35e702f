//! Exports the marks of one rater as one file for another tool.

mod coco;
mod cvat;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use ingest::nfc;
use model::{Mark, ObjectMarks};

use super::ExchangeError;
use super::foreign::Refused;
use super::label::What;
use super::pictures::Pictures;
use crate::labelme;
use crate::study::{Study, marks_in, stem_of};
use crate::write_marks::write_whole;

/// A format of another tool.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// JSON: outlines as polygons, lines as two keypoints.
    Coco,
    /// XML, 'CVAT for images 1.1': outlines as polygons, lines as polylines.
    Cvat,
}

/// Settings of an export.
#[derive(Debug, Clone)]
pub struct ExportOptions {
    /// The rater whose marks are written.
    pub rater: String,
    /// The format of the file.
    pub format: Format,
    /// The file to write; one that is there is written over.
    pub out: PathBuf,
    /// The program and its version, for the file.
    pub program: String,
}

/// The result of an export.
#[derive(Debug, Default, PartialEq)]
pub struct Exported {
    /// The number of images that are marked.
    pub images: usize,
    /// The number of their marks.
    pub marks: usize,
    /// The files and shapes that were left out.
    pub refused: Vec<Refused>,
}

/// An image with its marks.
struct MarkedImage {
    /// The name `SESSION/FILE`, as below cards/.
    name: String,
    size_px: [u32; 2],
    marks: Vec<Labelled>,
}

/// A mark with its label.
struct Labelled {
    object: String,
    what: What,
    points_px: Vec<[f64; 2]>,
}

impl Labelled {
    fn label(&self) -> String {
        format!("{}/{}", self.object, self.what.code())
    }
}

/// Writes the marks of a rater in `study` into one file. What cannot be written is listed in the result, and the rest is
/// written.
///
/// # Errors
/// [`ExchangeError`] where there are no marks, or the file cannot be written.
pub fn export(study: &Study, options: &ExportOptions) -> Result<Exported, ExchangeError> {
    let pictures = Pictures::list(study, None, &options.program);
    let (mut exported, mut images) = (Exported::default(), Vec::new());
    for (number, session) in pictures.sessions.iter().enumerate() {
        if let Some(folder) = session.dir.marks.get(&nfc(&options.rater)) {
            images.extend(images_of(study, &pictures, number, folder, &mut exported));
        }
    }
    if images.is_empty() && exported.refused.is_empty() {
        let raters: std::collections::BTreeSet<_> = study.sessions.iter().flat_map(|dir| dir.marks.keys()).collect();
        let known = raters.into_iter().map(String::as_str).collect::<Vec<_>>().join(", ");
        return Err(ExchangeError::NoMarks { rater: options.rater.clone(), known });
    }
    exported.images = images.len();
    exported.marks = images.iter().map(|image| image.marks.len()).sum();
    let text = match options.format {
        Format::Coco => coco::text(&images, &study.spec.name, &options.program),
        Format::Cvat => cvat::text(&images, &study.spec.name),
    };
    let failed = |source| ExchangeError::Write { path: options.out.clone(), source };
    write_whole(&options.out, &text.map_err(failed)?).map_err(failed)?;
    Ok(exported)
}

fn images_of(
    study: &Study,
    pictures: &Pictures<'_>,
    session: usize,
    folder: &Path,
    exported: &mut Exported,
) -> Vec<MarkedImage> {
    let mut refuse = |path: &Path, fact: String| {
        let place = path.strip_prefix(&study.dir).unwrap_or(path).display().to_string();
        exported.refused.push(Refused { place, fact });
    };
    let prepared = match pictures.sessions.get(session).map(|session| &session.prepared) {
        Some(Ok(prepared)) => prepared,
        Some(Err(fact)) => {
            refuse(folder, fact.clone());
            return Vec::new();
        }
        None => return Vec::new(),
    };
    let files = match marks_in(folder) {
        Ok(files) => files,
        Err(error) => {
            refuse(folder, format!("cannot list the folder: {error}"));
            return Vec::new();
        }
    };
    let mut images = Vec::new();
    for path in files {
        let size_px = prepared.marks_camera.1.size_px();
        let name = pictures.of_marks(session, &stem_of(&path.to_string_lossy()));
        let marks = labelme::read_bytes(&path).and_then(|bytes| labelme::parse(&bytes, &path, size_px));
        match (name, marks) {
            (Ok(picture), Ok(mut marks)) => {
                marks.refuse_four_corners(|object| study.is_round(object));
                marks.refused.iter().for_each(|error| refuse(&path, error.to_string()));
                let (marks, too_few) = labelled(marks.objects);
                too_few.into_iter().for_each(|fact| refuse(&path, fact));
                images.push(MarkedImage { name: pictures.place(picture), size_px, marks });
            }
            (Err(fact), _) => refuse(&path, fact),
            (_, Err(error)) => refuse(&path, error.to_string()),
        }
    }
    images
}

/// The marks with their labels, and messages on outlines that no tool takes for one.
fn labelled(objects: Vec<ObjectMarks>) -> (Vec<Labelled>, Vec<String>) {
    let (mut labelled, mut too_few) = (Vec::new(), Vec::new());
    for ObjectMarks { object, marks } in objects {
        for mark in marks {
            let what = match &mark {
                Mark::Line { quantity, .. } => What::Line(*quantity),
                Mark::Outline { feature, .. } => What::Outline(*feature),
            };
            let points_px: Vec<[f64; 2]> = mark.points_px().iter().map(|point| [point.x, point.y]).collect();
            let mark = Labelled { object: object.clone(), what, points_px };
            match (what, mark.points_px.len()) {
                (What::Outline(_), count @ 0..3) => {
                    too_few.push(format!("{} with {count} points: a polygon has 3", mark.label()));
                }
                _ => labelled.push(mark),
            }
        }
    }
    (labelled, too_few)
}

/// All labels of the images, by name, with what they mark.
fn labels(images: &[MarkedImage]) -> BTreeMap<String, What> {
    images.iter().flat_map(|image| &image.marks).map(|mark| (mark.label(), mark.what)).collect()
}
