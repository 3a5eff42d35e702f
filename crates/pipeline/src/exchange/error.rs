//! Errors by which marks cannot be carried over at all.

use std::io;
use std::path::PathBuf;

use crate::labelme::MarksError;

/// The reason why a file gives or takes no marks. What concerns one annotation is a [`Refused`](super::Refused).
#[derive(Debug, thiserror::Error)]
pub enum ExchangeError {
    /// The file cannot be read, or is too large.
    #[error(transparent)]
    File(#[from] MarksError),
    /// It is neither XML nor JSON.
    #[error("neither XML nor JSON; expected CVAT's annotations.xml or a JSON file of COCO{}: {}", archive_hint(*is_zip), path.display())]
    Unknown {
        /// The file.
        path: PathBuf,
        /// Whether it is an archive.
        is_zip: bool,
    },
    /// The text is not UTF-8.
    #[error("byte {offset} is not UTF-8, in which these files are written; export it again: {}", path.display())]
    NotUtf8 {
        /// The file.
        path: PathBuf,
        /// The offset of the first odd byte.
        offset: usize,
    },
    /// It is not well-formed XML.
    #[error("line {line}: not well-formed XML: {fact}; export it again: {}", path.display())]
    Xml {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// The fault.
        fact: String,
    },
    /// It is XML, but not CVAT's.
    #[error("line {line}: {fact}: {}", path.display())]
    NotCvat {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// The fault: what was expected, and what to do.
        fact: String,
    },
    /// It is not COCO's JSON.
    #[error("not a COCO file: {source}; expected images, annotations and categories: {}", path.display())]
    Coco {
        /// The file.
        path: PathBuf,
        /// The error of the parser, with line and column.
        source: serde_json::Error,
    },
    /// It is a LabelMe file.
    #[error("a LabelMe file, which needs no import: copy it to marks/RATER/SESSION/ of the study: {}", path.display())]
    LabelMe {
        /// The file.
        path: PathBuf,
    },
    /// The name cannot be that of a folder of marks.
    #[error(
        "rater '{0}': expected a name without '/', '\\' and line breaks that does not begin with '.', and is not 'auto'"
    )]
    Rater(String),
    /// No session of that name has a card.
    #[error("session '{session}': the study has no card of this name; it has: {known}")]
    Session {
        /// The name that was given.
        session: String,
        /// The names that there are.
        known: String,
    },
    /// There is nothing to export.
    #[error("rater '{rater}' has no marks in this study; raters: {known}")]
    NoMarks {
        /// The name that was given.
        rater: String,
        /// The names that there are.
        known: String,
    },
    /// A file cannot be written.
    #[error("cannot write: {source}: {}", path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
}

fn archive_hint(is_zip: bool) -> &'static str {
    if is_zip { "; this is a ZIP archive: unpack it, and give the file of annotations in it" } else { "" }
}
