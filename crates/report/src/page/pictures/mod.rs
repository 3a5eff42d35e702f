//! Pictures with marks for the page: in memory while they are few, and else as files beside the page.

mod names;
mod outline;
mod store;

use std::io;
use std::path::{Path, PathBuf};

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use model::{GalleryPicture, GallerySink, PictureView};
use serde::Serialize;

use names::Names;
use outline::MarkEntry;
use store::Store;

/// Pictures of so many bytes together are part of the page, which stays below 10 MB with all else that it holds.
const INLINE_BYTES: usize = 4 << 20;

/// Why a picture could not be stored.
#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    /// A folder or a file cannot be made.
    #[error("cannot write a picture of the report; is the disk full? {}", path.display())]
    Write {
        /// The folder or the file.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
}

/// The pictures of a page in the folder of a report. While they are few they are held, and become part of the page. Once they
/// are more, each becomes a file below `pictures/` as soon as it comes. Memory holds at most 4 MB of pictures, and the marks.
#[derive(Debug)]
pub struct Pictures {
    entries: Vec<Entry>,
    held: Vec<Vec<u8>>,
    held_bytes: usize,
    names: Names,
    store: Store,
}

/// A picture in the page's index.
#[derive(Debug, Clone, Serialize)]
struct Entry {
    session: String,
    image: String,
    view: &'static str,
    width: u32,
    height: u32,
    /// Path below the report's folder.
    #[serde(skip)]
    file: String,
    marks: Vec<MarkEntry>,
}

/// A picture in the page's index, with its source.
#[derive(Debug, Serialize)]
pub(super) struct Indexed<'a> {
    #[serde(flatten)]
    entry: &'a Entry,
    source: String,
}

impl Pictures {
    /// No pictures yet, for the page in the folder `report`, which need not exist.
    #[must_use]
    pub fn new(report: &Path) -> Self {
        Self {
            entries: Vec::new(),
            held: Vec::new(),
            held_bytes: 0,
            names: Names::default(),
            store: Store::new(report),
        }
    }

    /// Number of pictures.
    #[must_use]
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether there is no picture.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Whether the pictures are files beside the page.
    fn are_files(&self) -> bool {
        self.held.len() < self.entries.len()
    }

    /// All pictures, in the order in which they came.
    pub(super) fn index(&self) -> Vec<Indexed<'_>> {
        let inline = |jpeg: &Vec<u8>| format!("data:image/jpeg;base64,{}", BASE64_STANDARD.encode(jpeg));
        let source = |(place, entry): (usize, &Entry)| match self.held.get(place) {
            Some(jpeg) => inline(jpeg),
            None => entry.file.clone(),
        };
        self.entries.iter().enumerate().map(|item| Indexed { entry: item.1, source: source(item) }).collect()
    }

    /// Removes the pictures of an earlier report in the same folder that are not part of this one: a picture that a study no
    /// longer has must not stay in its report.
    ///
    /// # Errors
    /// The list of files cannot be read or written, or a file cannot be removed.
    pub(crate) fn finish(&self) -> Result<(), PictureError> {
        let files = if self.are_files() { &self.entries[..] } else { &[] };
        self.store.finish(files.iter().map(|entry| entry.file.as_str()))
    }
}

impl GallerySink for Pictures {
    type Error = PictureError;

    fn picture(&mut self, picture: GalleryPicture) -> Result<(), PictureError> {
        let GalleryPicture { session, image, view, size_px: [width, height], jpeg, marks } = picture;
        let view = code(view);
        let file = self.names.file(&session, &image, view);
        let marks = marks.iter().map(MarkEntry::from_mark).collect();
        self.held_bytes = self.held_bytes.saturating_add(jpeg.len());
        if self.held_bytes <= INLINE_BYTES {
            self.held.push(jpeg);
        } else {
            for (entry, jpeg) in self.entries.iter().zip(std::mem::take(&mut self.held)) {
                self.store.write(&entry.file, &jpeg)?;
            }
            self.store.write(&file, &jpeg)?;
        }
        self.entries.push(Entry { session, image, view, width, height, file, marks });
        Ok(())
    }
}

/// The name of a view in names of files and in the script.
fn code(view: PictureView) -> &'static str {
    match view {
        PictureView::Camera => "camera",
        PictureView::Corrected => "corrected",
        PictureView::Plane => "plane",
    }
}
