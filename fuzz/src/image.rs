//! What a picture says of itself: header, EXIF time, time in its name. Input: the file; or, as text, a pattern and a name,
//! each on a line.

use ingest::parse::{image_header, image_time};
use jiff::tz::TimeZone;

use crate::clocked::zone;

/// Pictures: sizes and times are of this world.
pub fn image(input: &[u8]) -> usize {
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
    header + exif + std::str::from_utf8(input).map_or(0, |text| named(text, &zone))
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
