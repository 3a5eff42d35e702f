//! The header of an image file: encoding, size, EXIF.

use std::io::Cursor;

use image::{ImageFormat, ImageReader};

use super::jpeg_segments::JpegSegments;

/// The encodings that are taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Encoding {
    /// JPEG.
    Jpeg,
    /// PNG.
    Png,
}

impl Encoding {
    /// As foxglove.CompressedImage names it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Jpeg => "jpeg",
            Self::Png => "png",
        }
    }
}

/// An image's header.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ImageHeader {
    /// Encoding.
    pub encoding: Encoding,
    /// Width.
    pub width_px: u32,
    /// Height.
    pub height_px: u32,
}

/// Why bytes are no image.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum HeaderError {
    /// Neither JPEG nor PNG.
    #[error("begins with {0}, not like a JPEG (ff d8 ff) or PNG (89 50 4e 47)")]
    Magic(String),
    /// A JPEG that is coded in a way that this program cannot decode.
    #[error(
        "{0} (marker ff {1:02x}) is not supported; convert a copy of it without loss to baseline JPEG, by jpegtran"
    )]
    Unsupported(&'static str, u8),
    /// Begins like an image, but its header cannot be read.
    #[error("the {0} header is damaged: {1}")]
    Damaged(&'static str, String),
}

/// The encoding by the first bytes of a file; 8 of them are enough.
#[must_use]
pub fn encoding_of(start: &[u8]) -> Option<Encoding> {
    if start.starts_with(&[0xff, 0xd8, 0xff]) {
        Some(Encoding::Jpeg)
    } else if start.starts_with(b"\x89PNG\r\n\x1a\n") {
        Some(Encoding::Png)
    } else {
        None
    }
}

/// The coding of a JPEG that cannot be decoded, and the marker of its frame (T.81, Table B.1).
fn unsupported_coding(encoding: Encoding, bytes: &[u8]) -> Option<(&'static str, u8)> {
    if encoding != Encoding::Jpeg {
        return None;
    }
    let is_frame = |code: u8| matches!(code, 0xc0..=0xcf) && !matches!(code, 0xc4 | 0xc8 | 0xcc);
    let (code, content) = JpegSegments::new(bytes).find(|(code, _)| is_frame(*code))?;
    let bits = bytes.get(content.start).copied();
    let coding = match code {
        0xc3 => "lossless JPEG",
        0xc5..=0xc7 => "hierarchical JPEG",
        0xc9..=0xcf => "arithmetic-coded JPEG",
        _ if bits.is_some_and(|bits| bits != 8) => "JPEG with other than 8 bits per sample",
        _ => return None,
    };
    Some((coding, code))
}

/// Reads the header of a JPEG or PNG file; the pixels are not decoded.
///
/// # Errors
/// [`HeaderError`] when the bytes are no image, or the header is cut off or damaged.
pub fn read(bytes: &[u8]) -> Result<ImageHeader, HeaderError> {
    let encoding = encoding_of(bytes).ok_or_else(|| {
        let start: Vec<String> = bytes.iter().take(4).map(|byte| format!("{byte:02x}")).collect();
        HeaderError::Magic(start.join(" "))
    })?;
    if let Some((coding, marker)) = unsupported_coding(encoding, bytes) {
        return Err(HeaderError::Unsupported(coding, marker));
    }
    let format = match encoding {
        Encoding::Jpeg => ImageFormat::Jpeg,
        Encoding::Png => ImageFormat::Png,
    };
    match ImageReader::with_format(Cursor::new(bytes), format).into_dimensions() {
        Ok((width_px, height_px)) => Ok(ImageHeader { encoding, width_px, height_px }),
        Err(error) => Err(HeaderError::Damaged(encoding.name(), error.to_string())),
    }
}
