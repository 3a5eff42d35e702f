//! The time at which an image was taken: from its name or from EXIF, as the profile declares.

use exif::{Field, In, Tag, Value};
use jiff::civil::DateTime;
use jiff::tz::TimeZone;
use jiff::{Timestamp, Zoned};
use model::UtcNs;

use super::exif_time::ExifTime;
use super::written_time::{self, WrittenTime};

/// Why an image has no time.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TimeError {
    /// The name does not fit the pattern.
    #[error("the name '{name}' does not fit '{pattern}': {why}")]
    Name {
        /// The file's name.
        name: String,
        /// The profile's pattern.
        pattern: String,
        /// The place where it does not fit.
        why: String,
    },
    /// No EXIF, or no usable time in it.
    #[error("EXIF gives no time: {0}")]
    Exif(String),
    /// A local time that a clock change skips or shows twice.
    #[error("{local} exists never or twice in {zone}, where clocks change: {why}")]
    Ambiguous {
        /// The local time.
        local: String,
        /// The study's time zone.
        zone: String,
        /// Which of the two.
        why: String,
    },
    /// Name and EXIF give different times.
    #[error("the name says {name}, EXIF says {exif}: {apart_s} s apart, more than {tolerance_s} s")]
    Disagree {
        /// The name's time.
        name: String,
        /// EXIF's time.
        exif: String,
        /// Seconds between them.
        apart_s: f64,
        /// Seconds that are allowed.
        tolerance_s: f64,
    },
    /// Neither name nor EXIF gives a time.
    #[error("{0}; {1}")]
    Neither(Box<Self>, Box<Self>),
    /// Before 1970 or after 2262.
    #[error("{0} is not between 1970 and 2262")]
    Range(String),
}

/// Whether a pattern consists of strptime directives that give a date and a time to the second, and uses all of them.
///
/// # Errors
/// The fault.
pub fn check_pattern(pattern: &str) -> Result<(), String> {
    written_time::check_pattern(pattern, true)
}

/// The time in a file name. The pattern is tried on the whole name, then on the name without its extension; digits behind
/// the last point are a fraction or a number, not an extension.
///
/// # Errors
/// [`TimeError`] when the name does not fit, or its local time is none or two.
pub fn from_name(name: &str, pattern: &str, zone: &TimeZone) -> Result<UtcNs, TimeError> {
    let is_extension = |tail: &str| !tail.starts_with(|c: char| c.is_ascii_digit());
    let stem = name.rsplit_once('.').filter(|(_, tail)| is_extension(tail)).map_or(name, |(stem, _)| stem);
    let parsed = written_time::parse(name.as_bytes(), pattern, true)
        .or_else(|_| written_time::parse(stem.as_bytes(), pattern, true));
    let wrong = |why| TimeError::Name { name: name.to_owned(), pattern: pattern.to_owned(), why };
    match parsed.map_err(wrong)? {
        WrittenTime::Utc(time) => utc_ns(time),
        WrittenTime::InZone(local, named) => in_zone(local, &named),
        WrittenTime::Local(local) if is_utc(pattern) => in_zone(local, &TimeZone::UTC),
        WrittenTime::Local(local) => in_zone(local, zone),
    }
}

/// A pattern whose last letter is a literal Z, not the directive `%Z`.
fn is_utc(pattern: &str) -> bool {
    let without_extension = pattern.rsplit_once('.').filter(|(_, tail)| !tail.contains('Z') && !tail.contains('%'));
    let stem = without_extension.map_or(pattern, |(stem, _)| stem);
    stem.strip_suffix('Z').is_some_and(|before| !before.ends_with('%'))
}

/// The time in the EXIF data of a JPEG or PNG file.
///
/// # Errors
/// [`TimeError`] when there is none, or its local time is none or two.
pub fn from_exif(image: &[u8], zone: &TimeZone) -> Result<UtcNs, TimeError> {
    let wrong = |error: exif::Error| TimeError::Exif(error.to_string());
    // Some programs leave out pointers that the time does not need: what can be read is read.
    let mut reader = exif::Reader::new();
    let exif = reader
        .continue_on_error(true)
        .read_from_container(&mut std::io::Cursor::new(image))
        .or_else(|error| error.distill_partial_result(|_| ()))
        .map_err(wrong)?;
    let text = |tag| exif.get_field(tag, In::PRIMARY).map(text_of).transpose();
    let missing = || TimeError::Exif("there is no DateTimeOriginal".to_owned());
    let date_time = text(Tag::DateTimeOriginal)?.filter(|text| !is_blank(text)).ok_or_else(missing)?;
    let (subsec, offset) = (text(Tag::SubSecTimeOriginal)?, text(Tag::OffsetTimeOriginal)?);
    let mut time = ExifTime::parse(&date_time, subsec.as_deref(), offset.as_deref()).map_err(TimeError::Exif)?;
    if time.offset.is_none() {
        // That of the file's own time. GPS stamps are not read: a receiver indoors repeats old ones.
        let offset = text(Tag::OffsetTime)?;
        time = ExifTime::parse(&date_time, subsec.as_deref(), offset.as_deref()).map_err(TimeError::Exif)?;
    }
    match time.offset {
        None => in_zone(time.local, zone),
        Some(offset) => {
            let utc = offset.to_timestamp(time.local);
            utc_ns(utc.map_err(|error| TimeError::Exif(error.to_string()))?)
        }
    }
}

/// The time of an image whose name and EXIF both give one: the name's, if the two are at most `tolerance_s` apart. Where
/// only one gives a time, that one; the flag says so.
///
/// # Errors
/// [`TimeError::Disagree`] when they are further apart, [`TimeError::Neither`] when there is none.
pub fn from_both(
    name: Result<UtcNs, TimeError>,
    exif: Result<UtcNs, TimeError>,
    tolerance_s: f64,
) -> Result<(UtcNs, bool), TimeError> {
    match (name, exif) {
        (Ok(name), Ok(exif)) => {
            let apart_s = name.0.abs_diff(exif.0) as f64 / 1e9;
            if apart_s <= tolerance_s {
                return Ok((name, false));
            }
            Err(TimeError::Disagree { name: utc_text(name), exif: utc_text(exif), apart_s, tolerance_s })
        }
        (Ok(time), Err(_)) | (Err(_), Ok(time)) => Ok((time, true)),
        (Err(name), Err(exif)) => Err(TimeError::Neither(Box::new(name), Box::new(exif))),
    }
}

/// A time for people: `2025-06-01T12:00:00Z`.
pub(crate) fn utc_text(time: UtcNs) -> String {
    Timestamp::from_nanosecond(time.0.into()).map_or_else(|_| format!("{} ns", time.0), |time| time.to_string())
}

/// The text of a field, to its first NUL; some programs write texts as bytes.
///
/// # Errors
/// A field that holds no text says something that is not read.
fn text_of(field: &Field) -> Result<String, TimeError> {
    let bytes = match &field.value {
        Value::Ascii(lines) => lines.first().map(Vec::as_slice),
        Value::Byte(bytes) | Value::Undefined(bytes, _) => Some(bytes.as_slice()),
        _ => None,
    };
    let before_nul = bytes.and_then(|bytes| bytes.split(|byte| *byte == 0).next());
    let text = before_nul.filter(|bytes| bytes.is_ascii()).map(|bytes| String::from_utf8_lossy(bytes).into_owned());
    text.ok_or_else(|| TimeError::Exif(format!("{} holds no text", field.tag)))
}

/// Whether a date and time is left open, as EXIF writes an unknown one.
fn is_blank(text: &str) -> bool {
    text.bytes().all(|byte| matches!(byte, b' ' | b':'))
}

/// A local time that is none or two is refused, not guessed.
fn in_zone(local: DateTime, zone: &TimeZone) -> Result<UtcNs, TimeError> {
    let unambiguous = zone.to_ambiguous_zoned(local).unambiguous();
    let zoned: Zoned = unambiguous.map_err(|error| TimeError::Ambiguous {
        local: local.to_string(),
        zone: zone.iana_name().unwrap_or("the study's time zone").to_owned(),
        why: error.to_string(),
    })?;
    utc_ns(zoned.timestamp())
}

fn utc_ns(time: Timestamp) -> Result<UtcNs, TimeError> {
    match i64::try_from(time.as_nanosecond()) {
        Ok(ns) if ns >= 0 => Ok(UtcNs(ns)),
        _ => Err(TimeError::Range(time.to_string())),
    }
}
