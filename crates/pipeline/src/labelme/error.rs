//! Errors of a file of marks.

use std::io;
use std::path::PathBuf;

use model::ProblemCode;

use super::LARGEST_FILE_BYTES;

/// The reason why a file, or one shape of it, gives no marks.
#[derive(Debug, thiserror::Error)]
pub enum MarksError {
    /// The file cannot be read.
    #[error("cannot read the file: {source}: {}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
    /// The file is too large for marks.
    #[error("the file has more than {LARGEST_FILE_BYTES} bytes, too many for marks: {}", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
    },
    /// The file is not LabelMe's JSON.
    #[error("not a LabelMe file: {source}; open it in LabelMe and save it again: {}", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// The error of the parser, with line and column.
        source: serde_json::Error,
    },
    /// The picture that was marked has another size than the camera's.
    #[error(
        "marked on a picture of {got_width} x {got_height} px, but the camera's are {width} x {height}: mark the original \
         pictures, or name the camera of the marked ones ([marks] camera in study.toml): {}", path.display()
    )]
    OtherPicture {
        /// The file.
        path: PathBuf,
        /// The width that the file gives.
        got_width: u32,
        /// The height that the file gives.
        got_height: u32,
        /// The width of the camera's pictures.
        width: u32,
        /// The height of the camera's pictures.
        height: u32,
    },
    /// The picture is shown otherwise than it is stored, and either may have been marked.
    #[error("{fact}: {}", path.display())]
    UnknownFrame {
        /// The file.
        path: PathBuf,
        /// The fault, and what to do.
        fact: String,
    },
    /// One of its shapes is no mark.
    #[error("shape {number} ('{label}'): {fact}: {}", path.display())]
    Shape {
        /// The file.
        path: PathBuf,
        /// The number of the shape, from 1.
        number: usize,
        /// The label of the shape.
        label: String,
        /// The fault: what was expected, and what was there.
        fact: String,
    },
}

impl MarksError {
    /// The stable code, for the status of a session.
    #[must_use]
    pub fn code(&self) -> ProblemCode {
        match self {
            Self::Unreadable { .. } => ProblemCode::MarksUnreadable,
            Self::TooLarge { .. } => ProblemCode::MarksTooLarge,
            Self::Malformed { .. } => ProblemCode::MarksMalformed,
            Self::OtherPicture { .. } => ProblemCode::MarksOfOtherPicture,
            Self::UnknownFrame { .. } => ProblemCode::MarksFrameUnknown,
            Self::Shape { .. } => ProblemCode::BadMark,
        }
    }
}
