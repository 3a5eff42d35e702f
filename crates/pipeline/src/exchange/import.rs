//! Imports marks of another tool as LabelMe files, `FOLDER/RATER/SESSION/IMAGE.json`.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use ingest::nfc;

use super::changed_names::Change;
use super::convert::{ConvertedMark, marks_of};
use super::foreign::{ForeignImage, Refused, short};
use super::label::Names;
use super::pictures::{Picture, Pictures};
use super::target::{Target, There};
use super::{ExchangeError, read};
use crate::labelme::{self, FrameFault, MarkedPicture, MarksError, MarksFrame};
use crate::study::{AUTO, Study};
use crate::write_marks::write_whole;

/// Settings of an import.
#[derive(Debug, Clone)]
pub struct ImportOptions {
    /// The rater who made the marks.
    pub rater: String,
    /// The folder of marks of all raters.
    pub folder: PathBuf,
    /// The only session whose images are marked, where that is known.
    pub session: Option<String>,
    /// Labels of the file, each with the label that it stands for.
    pub renamed: BTreeMap<String, String>,
    /// Labels that are no marks, and are meant to be passed over.
    pub ignored: BTreeSet<String>,
    /// The frame of the marks on pictures that EXIF tells viewers to turn, where neither the tool nor the size shows it; the study's
    /// when left out.
    pub frame: Option<MarksFrame>,
    /// Whether named points are taken that are marked as hidden.
    pub with_hidden: bool,
    /// Whether files that hold other marks are written over.
    pub force: bool,
    /// Whether to write nothing.
    pub dry_run: bool,
    /// The program and its version, for messages.
    pub program: String,
}

/// The result of an import.
#[derive(Debug, Default, PartialEq)]
pub struct Imported {
    /// The number of marks in files that now hold what was imported.
    pub marks: usize,
    /// The number of files that were written, or would be.
    pub written: usize,
    /// The number of files that held these marks already.
    pub unchanged: usize,
    /// The number of annotations passed over by [`ImportOptions::ignored`].
    pub ignored: usize,
    /// The annotations, images and files that were left out, in the order of the file.
    pub refused: Vec<Refused>,
    /// Notes on what is worth knowing, by which nothing was lost.
    pub notes: Vec<Refused>,
}

/// Writes the marks of `file` into LabelMe files. What cannot be used is listed in the result, and the rest is used.
///
/// # Errors
/// [`ExchangeError`] where nothing of the file can be used, or a file cannot be written; what was written until then stays.
pub fn import(study: &Study, file: &Path, options: &ImportOptions) -> Result<Imported, ExchangeError> {
    if !is_rater(&options.rater) {
        return Err(ExchangeError::Rater(options.rater.clone()));
    }
    let options = &normalised(options);
    check_session(study, options.session.as_deref())?;
    let foreign = read(&labelme::read_bytes(file)?, file)?;
    let import = Import {
        study,
        tool: foreign.frame,
        names: Names::new(study.objects.keys(), options.renamed.clone()),
        pictures: Pictures::list(study, options.session.as_deref(), &options.program),
        options,
    };
    let mut imported = Imported { refused: foreign.refused, ..Imported::default() };
    let mut marked: BTreeMap<&Picture, &str> = BTreeMap::new();
    let mut changed: BTreeMap<Change, Vec<(&ForeignImage, &Picture)>> = BTreeMap::new();
    for image in &foreign.images {
        let found = import.pictures.find(&image.name);
        if let (Ok((picture, Some(change))), false) = (&found, image.annotations.is_empty()) {
            changed.entry(*change).or_default().push((image, *picture));
        }
        match found.map(|(picture, _)| picture) {
            Ok(picture) => match marked.insert(picture, &image.place) {
                None => import.image(image, picture, &mut imported)?,
                Some(_) if image.annotations.is_empty() => {}
                Some(first) => {
                    let fact = format!(
                        "the same picture as another image of the file ({first}): {}",
                        import.pictures.place(picture)
                    );
                    imported.refused.push(at_image(image, fact));
                }
            },
            Err(_) if image.annotations.is_empty() => {}
            Err(fact) => imported.refused.push(at_image(image, fact)),
        }
    }
    imported.notes.extend(changed.iter().map(|(change, images)| import.changed_note(*change, images)));
    Ok(imported)
}

/// The settings with names in the form in which they are compared.
fn normalised(options: &ImportOptions) -> ImportOptions {
    let mut options = options.clone();
    options.rater = nfc(options.rater);
    options.session = options.session.map(nfc);
    options.ignored = options.ignored.into_iter().map(nfc).collect();
    options
}

fn at_image(image: &ForeignImage, fact: String) -> Refused {
    let count = match image.annotations.len() {
        1 => "1 annotation".to_owned(),
        more => format!("{more} annotations"),
    };
    Refused { place: format!("{}, '{}' ({count})", image.place, short(&image.name)), fact }
}

/// The reason why the frame of an image's marks is not known.
fn frame_fact(fault: FrameFault, image: &ForeignImage, picture: &MarkedPicture) -> String {
    match (fault, image.size_px) {
        (FrameFault::OtherSize, Some([got_width, got_height])) => {
            let [width, height] = picture.size_px;
            format!(
                "marked on a picture of {got_width} x {got_height} px, but the camera's are {width} x {height}: mark the \
                 original pictures, or name the camera of the marked ones ([marks] camera in study.toml)"
            )
        }
        _ => picture.unknown_frame_text(),
    }
}

fn check_session(study: &Study, session: Option<&str>) -> Result<(), ExchangeError> {
    let with_card = || study.sessions.iter().filter(|dir| dir.card.is_some()).map(|dir| dir.name.as_str());
    match session.filter(|session| with_card().all(|name| name != *session)) {
        None => Ok(()),
        Some(session) => {
            let known = with_card().collect::<Vec<_>>().join(", ");
            Err(ExchangeError::Session { session: session.to_owned(), known })
        }
    }
}

/// Whether a folder of marks may have this name.
fn is_rater(name: &str) -> bool {
    let odd = |c: char| matches!(c, '/' | '\\' | ':') || c.is_control();
    !(name.is_empty() || name.starts_with('.') || name.contains(odd) || name == AUTO)
}

struct Import<'a> {
    study: &'a Study,
    /// The frame in which the tool marks, where that is known.
    tool: Option<MarksFrame>,
    names: Names,
    pictures: Pictures<'a>,
    options: &'a ImportOptions,
}

/// A mark with the place where it stands.
struct Placed {
    place: String,
    mark: ConvertedMark,
}

impl Import<'_> {
    /// The note on images that were found although a tool had changed their names.
    fn changed_note(&self, change: Change, images: &[(&ForeignImage, &Picture)]) -> Refused {
        let first = images
            .first()
            .map(|(image, picture)| format!("'{}' is taken as {}", short(&image.name), self.pictures.place(picture)));
        let count = if images.len() == 1 { "1 image".to_owned() } else { format!("{} images", images.len()) };
        Refused { place: format!("{count}, first {}", first.unwrap_or_default()), fact: change.words().to_owned() }
    }

    fn image(&self, image: &ForeignImage, picture: &Picture, imported: &mut Imported) -> Result<(), ExchangeError> {
        let Some(session) = self.pictures.sessions.get(picture.session) else { return Ok(()) };
        let prepared = match &session.prepared {
            Ok(prepared) => prepared,
            Err(fact) => {
                imported.refused.push(at_image(image, format!("session '{}': {fact}", session.dir.name)));
                return Ok(());
            }
        };
        let target = match Target::new(self.options, self.study, session.dir, prepared, &picture.file) {
            Ok(target) => target,
            Err(fact) => {
                imported.refused.push(at_image(image, fact));
                return Ok(());
            }
        };
        if let Some(fault) = image.fault.as_ref().filter(|_| !image.annotations.is_empty()) {
            imported.refused.push(at_image(image, fault.clone()));
            return Ok(());
        }
        let marked = MarkedPicture { frame: self.options.frame.or(target.picture.frame), ..target.picture };
        let frame = match marked.frame_of(image.size_px, self.tool) {
            Ok(frame) => frame,
            Err(_) if image.annotations.is_empty() => return Ok(()),
            Err(fault) => {
                imported.refused.push(at_image(image, frame_fact(fault, image, &target.picture)));
                return Ok(());
            }
        };
        let placed = self.marks(image, &target.picture, frame, imported);
        self.write(image, &target, placed, imported)
    }

    fn marks(
        &self,
        image: &ForeignImage,
        picture: &MarkedPicture,
        frame: MarksFrame,
        imported: &mut Imported,
    ) -> Vec<Placed> {
        let picture_px = picture.size_in(frame);
        let carried = |mut mark: ConvertedMark| {
            mark.points_px.iter_mut().for_each(|point_px| *point_px = picture.to_stored(frame, *point_px));
            mark
        };
        let mut placed = Vec::new();
        for annotation in &image.annotations {
            if self.options.ignored.contains(&nfc(&annotation.label)) {
                imported.ignored += 1;
                continue;
            }
            let place = format!("{}, '{}' on '{}'", annotation.place, short(&annotation.label), short(&image.name));
            match marks_of(annotation, &self.names, picture_px, self.options.with_hidden) {
                Ok(converted) => {
                    let note = |fact| Refused { place: place.clone(), fact };
                    imported.notes.extend(converted.notes.into_iter().map(note));
                    let marks = converted.marks.into_iter().map(carried);
                    placed.extend(marks.map(|mark| Placed { place: place.clone(), mark }));
                }
                Err(fact) => imported.refused.push(Refused { place, fact }),
            }
        }
        placed
    }

    /// Writes the marks that LabelMe's reader takes, since the same rules hold for marks of all tools.
    fn write(
        &self,
        image: &ForeignImage,
        target: &Target<'_>,
        placed: Vec<Placed>,
        imported: &mut Imported,
    ) -> Result<(), ExchangeError> {
        let (placed, marks) = accepted(placed, target, imported)?;
        let there = target.marks_there()?;
        if placed.is_empty() && there.is_none() {
            return Ok(());
        }
        if there.as_ref() == Some(&There::Marks(marks.objects)) {
            imported.unchanged += 1;
            imported.marks += placed.len();
            return Ok(());
        }
        let there_is = |fact: &str| Refused {
            place: format!("{}: {}", image.place, target.path.display()),
            fact: fact.to_owned(),
        };
        if placed.is_empty() {
            let fact = "holds marks, of which this file has none, and is left as it is; move it out of the marks if they are no longer wanted";
            imported.notes.push(there_is(fact));
            return Ok(());
        }
        if there.is_some() && !self.options.force {
            imported.refused.push(there_is("holds other marks, and is left as it is; --force writes over it"));
            return Ok(());
        }
        if !self.options.dry_run {
            std::fs::create_dir_all(&target.folder).map_err(|source| target.failed(source))?;
            let text = target.text(placed.iter().map(|placed| &placed.mark))?;
            write_whole(&target.path, &text).map_err(|source| target.failed(source))?;
        }
        imported.written += 1;
        imported.marks += placed.len();
        Ok(())
    }
}

/// The marks that LabelMe's reader takes. What it refuses is listed by its place in the file of the other tool.
fn accepted(
    placed: Vec<Placed>,
    target: &Target<'_>,
    imported: &mut Imported,
) -> Result<(Vec<Placed>, labelme::Marks), ExchangeError> {
    let text = target.text(placed.iter().map(|placed| &placed.mark))?;
    let mut marks = labelme::parse(text.as_bytes(), &target.path, target.picture)?;
    let mut refused = BTreeMap::new();
    for error in std::mem::take(&mut marks.refused) {
        if let MarksError::Shape { number, fact, .. } = error {
            refused.insert(number, fact);
        }
    }
    let mut kept = Vec::new();
    for (number, placed) in (1..).zip(placed) {
        match refused.remove(&number) {
            Some(fact) => imported.refused.push(Refused { place: placed.place, fact }),
            None => kept.push(placed),
        }
    }
    Ok((kept, marks))
}
