//! The orientation that EXIF gives a picture (tag 0x0112): read, and set to upright in a copy.

use std::io;
use std::ops::Range;
use std::path::Path;

use model::Orientation;

use super::jpeg_segments::JpegSegments;
use crate::card::LARGEST_IMAGE_BYTES;

const ORIENTATION: u16 = 0x0112;
const PNG_MAGIC_BYTES: usize = 8;
const CHECKSUM_BYTES: usize = 4;

/// The orientation of a JPEG or PNG file; upright where there is none that EXIF defines, as viewers take it.
#[must_use]
pub fn orientation_of(picture: &[u8]) -> Orientation {
    find(picture).map_or(Orientation::Upright, |found| found.orientation)
}

/// The orientation of the picture in a file.
///
/// # Errors
/// The system's, where the file cannot be read.
pub fn orientation_of_file(path: &Path) -> io::Result<Orientation> {
    let mut bytes = Vec::new();
    io::Read::read_to_end(&mut io::Read::take(std::fs::File::open(path)?, LARGEST_IMAGE_BYTES), &mut bytes)?;
    Ok(orientation_of(&bytes))
}

/// The same picture, marked as upright, so that every viewer shows it as it is stored; none where it is upright already.
#[must_use]
pub fn upright(picture: &[u8]) -> Option<Vec<u8>> {
    let found = find(picture).filter(|found| found.orientation != Orientation::Upright)?;
    let mut upright = picture.to_owned();
    for (place, byte) in upright.get_mut(found.value.clone())?.iter_mut().rev().enumerate() {
        *byte = u8::from(place == 0);
    }
    if found.is_little_endian {
        upright.get_mut(found.value)?.reverse();
    }
    if let Some(chunk) = found.png_chunk {
        let checksum = crc32fast::hash(upright.get(chunk.clone())?).to_be_bytes();
        upright.get_mut(chunk.end..chunk.end + CHECKSUM_BYTES)?.copy_from_slice(&checksum);
    }
    Some(upright)
}

/// An orientation, and where it stands in the file.
struct Found {
    orientation: Orientation,
    value: Range<usize>,
    is_little_endian: bool,
    /// Type and data of the PNG chunk that holds it.
    png_chunk: Option<Range<usize>>,
}

fn find(picture: &[u8]) -> Option<Found> {
    if picture.starts_with(b"\x89PNG\r\n\x1a\n") {
        let chunk = png_exif(picture)?;
        let found = in_tiff(picture, chunk.start + 4..chunk.end)?;
        return Some(Found { png_chunk: Some(chunk), ..found });
    }
    in_tiff(picture, jpeg_exif(picture)?)
}

/// The TIFF structure in the first EXIF segment of a JPEG file.
fn jpeg_exif(picture: &[u8]) -> Option<Range<usize>> {
    const APP1: u8 = 0xe1;
    const NAME: &[u8] = b"Exif\0\0";
    let mut contents = JpegSegments::new(picture).filter(|(code, _)| *code == APP1).map(|(_, content)| content);
    let content = contents.find(|content| picture.get(content.clone()).is_some_and(|bytes| bytes.starts_with(NAME)))?;
    Some(content.start + NAME.len()..content.end)
}

/// Type and data of the `eXIf` chunk of a PNG file.
fn png_exif(picture: &[u8]) -> Option<Range<usize>> {
    let mut at = PNG_MAGIC_BYTES;
    loop {
        let length = picture.get(at..at + 4)?.iter().fold(0_usize, |sum, byte| sum << 8 | usize::from(*byte));
        let chunk = at + 4..at.checked_add(8)?.checked_add(length)?;
        match picture.get(chunk.clone())?.get(..4)? {
            b"eXIf" => return Some(chunk),
            b"IEND" => return None,
            _ => at = chunk.end.checked_add(CHECKSUM_BYTES)?,
        }
    }
}

/// The orientation in the first directory of a TIFF structure.
fn in_tiff(picture: &[u8], tiff: Range<usize>) -> Option<Found> {
    let bytes = picture.get(tiff.clone())?;
    let is_little_endian = match bytes.get(..4)? {
        b"II\x2a\0" => true,
        b"MM\0\x2a" => false,
        _ => return None,
    };
    let number = |range: Range<usize>| {
        let bytes = bytes.get(range)?;
        let join = |sum: u32, byte: &u8| sum << 8 | u32::from(*byte);
        Some(if is_little_endian { bytes.iter().rev().fold(0, join) } else { bytes.iter().fold(0, join) })
    };
    let directory = usize::try_from(number(4..8)?).ok()?;
    for entry in 0..number(directory..directory.checked_add(2)?)? {
        let at = directory + 2 + 12 * usize::try_from(entry).ok()?;
        if number(at..at + 2)? != u32::from(ORIENTATION) {
            continue;
        }
        let value_bytes = match number(at + 2..at + 4)? {
            1 => 1,
            3 => 2,
            4 => 4,
            _ => return None,
        };
        let value = at + 8..at + 8 + value_bytes;
        let orientation = Orientation::from_exif(number(value.clone())?)?;
        let value = tiff.start + value.start..tiff.start + value.end;
        return Some(Found { orientation, value, is_little_endian, png_chunk: None });
    }
    None
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use super::*;

    fn tiff(is_little_endian: bool, number: u8) -> Vec<u8> {
        if is_little_endian {
            [b"II\x2a\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0".as_slice(), &[number, 0, 0, 0, 0, 0, 0, 0]].concat()
        } else {
            [b"MM\0\x2a\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01".as_slice(), &[0, number, 0, 0, 0, 0, 0, 0]].concat()
        }
    }

    fn jpeg(tiff: &[u8]) -> Vec<u8> {
        let length = u16::try_from(tiff.len() + 8).unwrap().to_be_bytes();
        [b"\xff\xd8\xff\xe0\0\x04ab\xff\xe1".as_slice(), &length, b"Exif\0\0", tiff, b"\xff\xda\0\x02"].concat()
    }

    fn png(tiff: &[u8]) -> Vec<u8> {
        let data = [b"eXIf", tiff].concat();
        let length = u32::try_from(tiff.len()).unwrap().to_be_bytes();
        let end = b"\0\0\0\0IEND\xae\x42\x60\x82";
        let checksum = crc32fast::hash(&data).to_be_bytes();
        [b"\x89PNG\r\n\x1a\n".as_slice(), &length, &data, &checksum, end].concat()
    }

    #[test]
    fn orientations_are_read_and_set_upright() {
        for (orientation, is_little_endian) in Orientation::ALL.into_iter().flat_map(|one| [(one, true), (one, false)])
        {
            let number = u8::try_from(orientation.exif()).unwrap();
            for file in [jpeg, png] {
                let picture = file(&tiff(is_little_endian, number));
                assert_eq!(orientation_of(&picture), orientation);
                let expected = (number != 1).then(|| file(&tiff(is_little_endian, 1)));
                assert_eq!(upright(&picture), expected, "{orientation:?}, little endian: {is_little_endian}");
            }
        }
    }

    #[test]
    fn what_says_nothing_is_upright() {
        for number in [0, 9] {
            assert_eq!(orientation_of(&jpeg(&tiff(true, number))), Orientation::Upright);
        }
        let whole = jpeg(&tiff(false, 6));
        for end in 0..whole.len() {
            let _ = orientation_of(&whole[..end]); // no panic
        }
        assert_eq!(orientation_of(b"\xff\xd8\xff\xda\0\x02"), Orientation::Upright);
    }

    #[test]
    fn stray_and_fill_bytes_before_a_marker_are_passed_over() {
        let picture = jpeg(&tiff(true, 3));
        let odd = [&picture[..8], b"\0\xff\xff", &picture[8..]].concat();
        assert_eq!(orientation_of(&odd), Orientation::HalfTurn);
    }
}
