//! The time of day in the texts of EXIF, read to their ends: what programs write behind the 19 characters of a date and
//! time (a fraction, an offset, a `Z`) counts.

use jiff::civil::DateTime;
use jiff::tz::Offset;

/// Length of `YYYY:MM:DD HH:MM:SS`.
const DATE_TIME_BYTES: usize = 19;

/// A date and time of EXIF.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ExifTime {
    /// On the wall clock.
    pub local: DateTime,
    /// East of UTC, where the text says so.
    pub offset: Option<Offset>,
}

impl ExifTime {
    /// The time of `DateTimeOriginal`, `SubSecTimeOriginal` and `OffsetTimeOriginal`. A fraction or an offset may be in the
    /// first as well; then it must be the same.
    ///
    /// # Errors
    /// The text that cannot be read wholly, or the two that say different things.
    pub fn parse(date_time: &str, subsec: Option<&str>, offset: Option<&str>) -> Result<Self, String> {
        let wrong = |why: &str| format!("DateTimeOriginal '{}' {why}", date_time.escape_debug());
        let text = date_time.trim_end_matches([' ', '\0']);
        let (Some(civil), Some(rest)) = (text.get(..DATE_TIME_BYTES), text.get(DATE_TIME_BYTES..)) else {
            return Err(wrong("is no date and time"));
        };
        let whole = civil_time(civil).ok_or_else(|| wrong("is no date and time"))?;
        let (own_fraction, own_offset) =
            behind(rest).ok_or_else(|| wrong(&format!("has '{}' behind the time", rest.escape_debug())))?;
        let subsec = subsec.map(str::trim).filter(|text| !text.is_empty());
        let offset = offset.map(str::trim).filter(|text| !text.is_empty() && *text != ":");
        let fraction_ns = fraction_of(own_fraction, subsec)?;
        let read = |text: &str| offset_of(text).ok_or_else(|| format!("OffsetTimeOriginal '{text}' is no offset"));
        let tag_offset = offset.map(read).transpose()?;
        if let (Some(own), Some(tag)) = (own_offset, tag_offset)
            && own != tag
        {
            return Err(wrong(&format!("has another offset than OffsetTimeOriginal, {tag}")));
        }
        let local = whole.with().subsec_nanosecond(fraction_ns).build().map_err(|error| error.to_string())?;
        Ok(Self { local, offset: own_offset.or(tag_offset) })
    }
}

/// `YYYY:MM:DD HH:MM:SS`, to the second. None for anything else.
fn civil_time(text: &str) -> Option<DateTime> {
    let is_digit_or = |(i, byte): (usize, u8)| match i {
        4 | 7 | 13 | 16 => byte == b':',
        10 => byte == b' ',
        _ => byte.is_ascii_digit(),
    };
    if !text.bytes().enumerate().all(is_digit_or) {
        return None;
    }
    let small = |from: usize| text.get(from..from + 2)?.parse::<i8>().ok();
    let year = text.get(..4)?.parse::<i16>().ok()?;
    DateTime::new(year, small(5)?, small(8)?, small(11)?, small(14)?, small(17)?, 0).ok()
}

/// The digits of a fraction and the offset in the text behind a time. None where there is anything else.
fn behind(rest: &str) -> Option<(Option<&str>, Option<Offset>)> {
    let (digits, rest) = match rest.strip_prefix(['.', ',']) {
        None => (None, rest),
        Some(fraction) => {
            let end = fraction.find(|c: char| !c.is_ascii_digit()).unwrap_or(fraction.len());
            let (digits, rest) = fraction.split_at(end);
            if digits.is_empty() {
                return None;
            }
            (Some(digits), rest)
        }
    };
    match rest.trim_start() {
        "" => Some((digits, None)),
        offset => Some((digits, Some(offset_of(offset)?))),
    }
}

/// Nanoseconds of the fraction behind the time, of `SubSecTimeOriginal`, or of the two, which must then be the same as far
/// as the shorter one goes.
fn fraction_of(own: Option<&str>, tag: Option<&str>) -> Result<i32, String> {
    if let Some(tag) = tag.filter(|tag| !tag.bytes().all(|byte| byte.is_ascii_digit())) {
        return Err(format!("SubSecTimeOriginal '{}' is no fraction", tag.escape_debug()));
    }
    let longest = match (own, tag) {
        (Some(own), Some(tag)) if own.starts_with(tag) => own,
        (Some(own), Some(tag)) if tag.starts_with(own) => tag,
        (Some(own), Some(tag)) => {
            return Err(format!("DateTimeOriginal has the fraction .{own}, SubSecTimeOriginal .{tag}"));
        }
        (own, tag) => own.or(tag).unwrap_or_default(),
    };
    let digits = longest.bytes().chain(std::iter::repeat(b'0')).take(9);
    Ok(digits.fold(0, |total, digit| 10 * total + i32::from(digit - b'0')))
}

/// `Z`, `+HH:MM` or `+HHMM`. None for anything else.
fn offset_of(text: &str) -> Option<Offset> {
    if text == "Z" {
        return Some(Offset::UTC);
    }
    let sign = match text.bytes().next()? {
        b'+' => 1,
        b'-' => -1,
        _ => return None,
    };
    let digits = text.get(1..)?;
    let (hours, minutes) = if digits.len() == 4 { digits.split_at_checked(2)? } else { digits.split_once(':')? };
    let number = |part: &str| {
        let is_number = part.len() == 2 && part.bytes().all(|byte| byte.is_ascii_digit());
        part.parse::<i32>().ok().filter(|_| is_number)
    };
    let (hours, minutes) = (number(hours)?, number(minutes)?);
    // No zone is further from UTC than 14 h.
    (hours <= 14 && minutes < 60).then(|| Offset::from_seconds(sign * (3600 * hours + 60 * minutes)).ok()).flatten()
}
