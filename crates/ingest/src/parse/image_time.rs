//! The time at which an image was taken: from its name or from EXIF, as the profile declares.

use exif::{Field, In, Tag, Value};
use jiff::civil::DateTime;
use jiff::fmt::strtime::{self, BrokenDownTime};
use jiff::tz::{Offset, TimeZone};
use jiff::{Timestamp, Zoned};
use model::UtcNs;

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

/// Whether a pattern consists of strptime directives that give a date and a time.
///
/// # Errors
/// The fault.
pub fn check_pattern(pattern: &str) -> Result<(), String> {
    let probe = Timestamp::UNIX_EPOCH.to_zoned(TimeZone::UTC);
    let name = strtime::format(pattern, &probe).map_err(|error| error.to_string())?;
    match from_name(&name, pattern, &TimeZone::UTC) {
        Ok(_) => Ok(()),
        Err(error) => Err(error.to_string()),
    }
}

/// The time in a file name. The pattern is tried on the whole name, then on the name without its extension.
///
/// # Errors
/// [`TimeError`] when the name does not fit, or its local time is none or two.
pub fn from_name(name: &str, pattern: &str, zone: &TimeZone) -> Result<UtcNs, TimeError> {
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let parsed = BrokenDownTime::parse(pattern, name).or_else(|_| BrokenDownTime::parse(pattern, stem));
    let wrong = |error: jiff::Error| TimeError::Name {
        name: name.to_owned(),
        pattern: pattern.to_owned(),
        why: error.to_string(),
    };
    let parsed = parsed.map_err(wrong)?;
    if parsed.timestamp().is_none() && parsed.second().is_none() {
        // Midnight, or the full minute, would be a guess.
        let why = "the pattern does not give hour, minute and second".to_owned();
        return Err(TimeError::Name { name: name.to_owned(), pattern: pattern.to_owned(), why });
    }
    if parsed.timestamp().is_some() || parsed.offset().is_some() {
        return utc_ns(parsed.to_timestamp().map_err(wrong)?);
    }
    let local = parsed.to_datetime().map_err(wrong)?;
    if is_utc(pattern) { in_zone(local, &TimeZone::UTC) } else { in_zone(local, zone) }
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
    let text = |tag| exif.get_field(tag, In::PRIMARY).and_then(ascii);
    let missing = || TimeError::Exif("there is no DateTimeOriginal".to_owned());
    let mut time = exif::DateTime::from_ascii(text(Tag::DateTimeOriginal).ok_or_else(missing)?).map_err(wrong)?;
    if let Some(digits) = text(Tag::SubSecTimeOriginal) {
        time.parse_subsec(digits).map_err(wrong)?;
    }
    // The first of the two that says something. GPS stamps are not read: a receiver indoors repeats old ones.
    for offset in [Tag::OffsetTimeOriginal, Tag::OffsetTime].into_iter().filter_map(text) {
        match time.parse_offset(offset) {
            Ok(()) => break,
            Err(exif::Error::BlankValue(_)) => {}
            Err(error) => return Err(wrong(error)),
        }
    }
    let local = civil(&time).ok_or_else(|| TimeError::Exif(format!("{time} is no date and time")))?;
    match time.offset {
        None => in_zone(local, zone),
        Some(minutes) => {
            let offset = Offset::from_seconds(i32::from(minutes) * 60);
            let utc = offset.and_then(|offset| offset.to_timestamp(local));
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

fn ascii(field: &Field) -> Option<&[u8]> {
    match &field.value {
        Value::Ascii(lines) => lines.first().map(Vec::as_slice),
        _ => None,
    }
}

fn civil(time: &exif::DateTime) -> Option<DateTime> {
    let small = |value: u8| i8::try_from(value).ok();
    DateTime::new(
        i16::try_from(time.year).ok()?,
        small(time.month)?,
        small(time.day)?,
        small(time.hour)?,
        small(time.minute)?,
        small(time.second)?,
        i32::try_from(time.nanosecond.unwrap_or(0)).ok()?,
    )
    .ok()
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
