//! Carries marks from and to files of other annotation tools: CVAT's XML, COCO's JSON (docs/marks.md).
//!
//! [`read`] gives the content of a file, and [`marks_of`] the marks that one annotation means. [`import()`] writes them as
//! LabelMe files, the only ones that sizes are measured from. [`export()`] goes the other way.
//!
//! LabelMe, CVAT and the tools that write COCO all put (0, 0) at the corner of the first pixel, so coordinates are carried
//! over unchanged.

mod changed_names;
mod coco;
mod convert;
mod cvat;
mod error;
mod export;
mod foreign;
mod import;
mod label;
mod named;
mod pictures;
mod target;

use std::path::Path;

pub use convert::{Converted, ConvertedMark, marks_of};
pub use error::ExchangeError;
pub use export::{ExportOptions, Exported, Format, export};
pub use foreign::{Annotation, Drawn, Ellipse, Foreign, ForeignImage, Form, NamedPoint, Refused, Sight};
pub use import::{ImportOptions, Imported, import};
pub use label::Names;

/// The content of a file, by its bytes: XML of CVAT or JSON of COCO, whichever it is. `path` is for messages.
///
/// # Errors
/// [`ExchangeError`] where nothing of the file can be used. What concerns one annotation is in [`Drawn::Unusable`].
pub fn read(bytes: &[u8], path: &Path) -> Result<Foreign, ExchangeError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes); // a byte order mark, as some editors write
    let first = bytes.iter().find(|byte| !byte.is_ascii_whitespace());
    let parse = match first {
        Some(b'<') => cvat::parse,
        Some(b'{') => coco::parse,
        _ => return Err(ExchangeError::Unknown { path: path.to_owned(), is_zip: bytes.starts_with(b"PK\x03\x04") }),
    };
    let text = std::str::from_utf8(bytes)
        .map_err(|error| ExchangeError::NotUtf8 { path: path.to_owned(), offset: error.valid_up_to() })?;
    parse(text, path)
}
