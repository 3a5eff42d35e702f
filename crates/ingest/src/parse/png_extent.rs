//! PNG: from chunk to chunk until IEND, with their checksums.

use super::image_extent::{ImageDamage, ImageExtent};

const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";
/// Length, name and checksum of a chunk.
const FRAME_BYTES: usize = 12;

/// The extent of a PNG file.
///
/// # Errors
/// [`ImageDamage`] when IEND cannot be reached, or a chunk's checksum is wrong.
pub(super) fn png_extent(bytes: &[u8]) -> Result<ImageExtent, ImageDamage> {
    let mut at = SIGNATURE.len();
    let mut has_pixels = false;
    loop {
        let chunk = Chunk::read(bytes, at)?;
        has_pixels |= chunk.name == *b"IDAT";
        let end = at + FRAME_BYTES + chunk.data_bytes;
        if chunk.name == *b"IEND" {
            let whole = ImageExtent { bytes: end, has_more_pictures: false, stray_bytes: 0 };
            return if has_pixels { Ok(whole) } else { Err(ImageDamage::NoPixels { at }) };
        }
        at = end;
    }
}

struct Chunk {
    name: [u8; 4],
    data_bytes: usize,
}

impl Chunk {
    fn read(bytes: &[u8], at: usize) -> Result<Self, ImageDamage> {
        let rest = bytes.get(at..).unwrap_or_default();
        let Some((&[a, b, c, d, n0, n1, n2, n3], _)) = rest.split_first_chunk() else {
            return Err(ImageDamage::NoEnd { bytes: bytes.len(), marker: "IEND" });
        };
        let name = [n0, n1, n2, n3];
        let text = name.escape_ascii().to_string();
        if !name.iter().all(u8::is_ascii_alphabetic) {
            return Err(ImageDamage::Strange { found: format!("'{text}'"), at, expected: "the name of a PNG chunk" });
        }
        let data_bytes = usize::try_from(u32::from_be_bytes([a, b, c, d])).unwrap_or(usize::MAX);
        let expected = data_bytes.saturating_add(FRAME_BYTES);
        let Some(chunk) = rest.get(..expected) else {
            return Err(ImageDamage::Cut { part: format!("PNG chunk {text}"), at, expected, got: rest.len() });
        };
        let (content, checksum) = chunk.split_at(expected - 4);
        if crc32fast::hash(&content[4..]).to_be_bytes() != checksum {
            return Err(ImageDamage::Checksum { chunk: text, at });
        }
        Ok(Self { name, data_bytes })
    }
}
