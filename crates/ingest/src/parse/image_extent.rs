//! The place where a picture ends in its file, and whether it is whole until there. The pixels are not decoded.

use super::image_header::Encoding;
use super::jpeg_extent::jpeg_extent;
use super::png_extent::png_extent;

/// The extent of a whole picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ImageExtent {
    /// Bytes from the file's first to the last of the picture's end marker; never more than the file has.
    pub bytes: usize,
    /// The picture announces others behind it (multi-picture format), so bytes behind it are no garbage.
    pub has_more_pictures: bool,
    /// Stray bytes before markers of the picture, which decoders pass over.
    pub stray_bytes: usize,
}

/// Why a picture is not whole. Offsets count bytes from the start of the file.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ImageDamage {
    /// The file ends before the picture.
    #[error("the file ends after {bytes} bytes without the end marker ({marker})")]
    NoEnd {
        /// Bytes of the file.
        bytes: usize,
        /// The marker that ends a whole picture.
        marker: &'static str,
    },
    /// The file ends inside a part that says how long it is.
    #[error("the file ends inside {part} at byte {at}: expected {expected} bytes, got {got}")]
    Cut {
        /// The part.
        part: String,
        /// The place where it begins.
        at: usize,
        /// Its length as it says.
        expected: usize,
        /// Bytes of it in the file.
        got: usize,
    },
    /// Something stands where the format does not allow it.
    #[error("{found} at byte {at}, expected {expected}")]
    Strange {
        /// The bytes that stand there.
        found: String,
        /// The place.
        at: usize,
        /// The bytes that a picture has there.
        expected: &'static str,
    },
    /// A block of zeros in the picture's data, as damaged cards give.
    #[error("{bytes} zero bytes in the picture's data, from byte {at} on")]
    Zeros {
        /// The place where the zeros begin.
        at: usize,
        /// The number of them.
        bytes: usize,
    },
    /// A PNG chunk whose bytes are not those that were written.
    #[error("the checksum of the PNG chunk {chunk} at byte {at} is wrong")]
    Checksum {
        /// The chunk's name.
        chunk: String,
        /// The place where it begins.
        at: usize,
    },
    /// The end marker comes before any picture data.
    #[error("the end marker comes at byte {at}, before any picture data")]
    NoPixels {
        /// The place where the end marker is.
        at: usize,
    },
}

/// Follows a picture's structure from its first byte to its end marker.
///
/// # Errors
/// [`ImageDamage`] when the end marker cannot be reached, or a block of the data is zeros.
pub fn extent(encoding: Encoding, bytes: &[u8]) -> Result<ImageExtent, ImageDamage> {
    match encoding {
        Encoding::Jpeg => jpeg_extent(bytes),
        Encoding::Png => png_extent(bytes),
    }
}
