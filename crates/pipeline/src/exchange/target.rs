//! The LabelMe file of an image that marks are imported into.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use ingest::card::entry_named;

use super::ExchangeError;
use super::convert::ConvertedMark;
use super::import::ImportOptions;
use crate::labelme::{self, OutShape};
use crate::session::Prepared;
use crate::study::{SessionDir, stem_of};
use crate::write_marks::picture_for;

/// The LabelMe file of an image.
pub(super) struct Target<'a> {
    pub folder: PathBuf,
    pub path: PathBuf,
    dir: &'a SessionDir,
    prepared: &'a Prepared,
    /// The picture on the card.
    file: &'a str,
}

/// The content of a file that is there already.
#[derive(PartialEq)]
pub(super) enum There {
    Marks(Vec<model::ObjectMarks>),
    /// Something that cannot be read as marks.
    Other,
}

impl<'a> Target<'a> {
    pub fn new(options: &ImportOptions, dir: &'a SessionDir, prepared: &'a Prepared, file: &'a str) -> Self {
        // A folder or file that is there keeps its name, in whatever Unicode form. Else this is the card's own name, whatever
        // bytes it consists of.
        let there_or =
            |folder: &Path, name: &str, new: &OsStr| entry_named(folder, name).unwrap_or_else(|| folder.join(new));
        let rater = there_or(&options.folder, &options.rater, options.rater.as_ref());
        let session = dir.card.as_deref().and_then(Path::file_name).unwrap_or(dir.name.as_ref());
        let folder = there_or(&rater, &dir.name, session);
        let file_name = format!("{}.json", stem_of(file));
        let path = there_or(&folder, &file_name, file_name.as_ref());
        Self { folder, path, dir, prepared, file }
    }

    pub fn picture_px(&self) -> [u32; 2] {
        self.prepared.marks_camera.1.size_px()
    }

    /// The text of the file. It holds the way to the picture, which is known once there is a folder for the marks.
    pub fn text<'m>(&self, marks: impl Iterator<Item = &'m ConvertedMark>) -> Result<String, ExchangeError> {
        let shapes = marks
            .map(|ConvertedMark { label, shape_type, points_px }| OutShape::new(label.clone(), shape_type, points_px));
        let picture = picture_for(&self.folder, self.dir, self.prepared, self.file);
        let text = labelme::text_of_shapes(shapes.collect(), &picture, self.picture_px());
        text.map_err(|error| self.failed(error.into()))
    }

    pub fn marks_there(&self) -> Result<Option<There>, ExchangeError> {
        if !self.path.try_exists().map_err(|source| self.failed(source))? {
            return Ok(None);
        }
        let bytes = labelme::read_bytes(&self.path)?;
        Ok(Some(match labelme::parse(&bytes, &self.path, self.picture_px()) {
            Ok(marks) if marks.refused.is_empty() => There::Marks(marks.objects),
            Ok(_) | Err(_) => There::Other,
        }))
    }

    pub fn failed(&self, source: std::io::Error) -> ExchangeError {
        ExchangeError::Write { path: self.path.clone(), source }
    }
}
