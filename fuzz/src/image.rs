//! The facts in the file of a picture: header, extent, EXIF time, time in its name. Input: the file; or, as text, a pattern and a
//! name, each on a line.

use ingest::parse::image_extent::{ImageDamage, extent};
use ingest::parse::image_header::Encoding;
use ingest::parse::{image_header, image_time};
use jiff::tz::TimeZone;

use crate::clocked::zone;
use crate::mend;

/// Pictures: sizes and times are of this world, and a picture ends within its file. PNG also with its checksums made right.
pub fn image(input: &[u8]) -> usize {
    let mended = mend::png(input).map_or(0, |mended| read(&mended));
    read(input).max(mended)
}

fn read(input: &[u8]) -> usize {
    let zone = zone(input.last().copied().unwrap_or(0));
    let header = match image_header::read(input) {
        Ok(header) => {
            assert!(header.width_px > 0 && header.height_px > 0, "{header:?}");
            1
        }
        Err(error) => usize::from(error.to_string().is_empty()),
    };
    let exif = match image_time::from_exif(input, &zone) {
        Ok(time) => {
            assert!(time.0 >= 0, "{time:?}");
            1
        }
        Err(error) => usize::from(error.to_string().is_empty()),
    };
    let whole = match input {
        [0xff, 0xd8, ..] => reach(Encoding::Jpeg, input),
        [0x89, b'P', ..] => reach(Encoding::Png, input),
        _ => 0,
    };
    header + exif + whole + std::str::from_utf8(input).map_or(0, |text| named(text, &zone))
}

/// How far a picture reaches, and that what lies behind it is of no account.
fn reach(encoding: Encoding, input: &[u8]) -> usize {
    let error = match extent(encoding, input) {
        Ok(found) => {
            let end: &[u8] = if encoding == Encoding::Jpeg { &[0xff, 0xd9] } else { b"IEND\xaeB`\x82" };
            let picture = &input[..found.bytes];
            // IEND with something in it ends otherwise; JPEG allows nothing there.
            assert!(picture.ends_with(end) || encoding == Encoding::Png, "{found:?}");
            assert_eq!(extent(encoding, picture), Ok(found), "the picture alone is as whole");
            assert!(found.bytes < 4 || extent(encoding, &picture[..found.bytes - 1]).is_err(), "one byte less is cut");
            return 1;
        }
        Err(error) => error,
    };
    let (at, least) = match &error {
        ImageDamage::NoEnd { bytes, .. } => (*bytes, 0),
        ImageDamage::Cut { at, expected, got, .. } => (at + got, usize::from(got >= expected)),
        ImageDamage::Strange { at, .. } | ImageDamage::Checksum { at, .. } | ImageDamage::NoPixels { at } => (*at, 0),
        ImageDamage::Zeros { at, bytes } => (at + bytes, 0),
    };
    assert!(at <= input.len() && least == 0, "what is wrong lies in the file of {} bytes: {error:?}", input.len());
    0
}

/// A pattern that is accepted reads the name that it writes.
fn named(text: &str, zone: &TimeZone) -> usize {
    let Some((pattern, name)) = text.split_once('\n') else { return 0 };
    if image_time::check_pattern(pattern).is_err() {
        return 0;
    }
    match image_time::from_name(name, pattern, zone) {
        Ok(time) => {
            assert!(time.0 >= 0, "{time:?}");
            1
        }
        Err(error) => usize::from(error.to_string().is_empty()),
    }
}
