//! A date and time as text, by a strptime pattern, without losing a part of either.

use jiff::civil::DateTime;
use jiff::fmt::strtime::{self, BrokenDownTime};
use jiff::tz::TimeZone;
use jiff::{SignedDuration, Timestamp};

/// A moment with which patterns are tried: every field is another number, and it is past noon.
const PROBE_S: i64 = 1_638_038_629; // 2021-11-27 18:43:49 UTC
const PROBE_FRACTION_NS: i32 = 123_456_789;

/// A time as it was written.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum WrittenTime {
    /// With an offset, or as seconds since 1970.
    Utc(Timestamp),
    /// On the wall clock of a zone that the text names.
    InZone(DateTime, TimeZone),
    /// On a wall clock that the text does not name.
    Local(DateTime),
}

/// The time in a text, all of which the pattern describes. With `needs_second`, a pattern without seconds is refused: the
/// full minute would be a guess.
///
/// # Errors
/// The place where the text does not fit, or the part of the pattern that would not be used.
pub(super) fn parse(text: &[u8], pattern: &str, needs_second: bool) -> Result<WrittenTime, String> {
    let parsed = BrokenDownTime::parse(pattern, text).map_err(|error| error.to_string())?;
    if let Some(seconds) = parsed.timestamp() {
        if has_civil_part(&parsed) {
            return Err("%s gives the whole time: a date or time of day beside it would not be used".to_owned());
        }
        // jiff leaves out the fraction beside %s.
        let fraction = SignedDuration::from_nanos(parsed.subsec_nanosecond().unwrap_or(0).into());
        return seconds.checked_add(fraction).map(WrittenTime::Utc).map_err(|error| error.to_string());
    }
    if parsed.second().is_none() && needs_second {
        return Err("the pattern does not give hour, minute and second".to_owned());
    }
    if parsed.hour().is_none() || parsed.minute().is_none() {
        return Err("the pattern does not give hour and minute".to_owned());
    }
    if parsed.offset().is_some() {
        return parsed.to_timestamp().map(WrittenTime::Utc).map_err(|error| error.to_string());
    }
    let local = parsed.to_datetime().map_err(|error| error.to_string())?;
    match parsed.iana_time_zone() {
        None => Ok(WrittenTime::Local(local)),
        Some(name) => {
            let zone = TimeZone::get(name).map_err(|error| error.to_string())?;
            Ok(WrittenTime::InZone(local, zone))
        }
    }
}

/// Whether a pattern gives back the time that it has written: nothing that it describes is passed over, such as `%I`
/// without `%p`.
///
/// # Errors
/// The fault.
pub(crate) fn check_pattern(pattern: &str, needs_second: bool) -> Result<(), String> {
    let probe = Timestamp::new(PROBE_S, PROBE_FRACTION_NS).map_err(|error| error.to_string())?;
    let text = strtime::format(pattern, &probe.to_zoned(TimeZone::UTC)).map_err(|error| error.to_string())?;
    let as_utc = |local: DateTime| TimeZone::UTC.to_timestamp(local).map_err(|error| error.to_string());
    let read = match parse(text.as_bytes(), pattern, needs_second)? {
        WrittenTime::Utc(time) => time,
        WrittenTime::InZone(local, _) | WrittenTime::Local(local) => as_utc(local)?,
    };
    // A pattern may leave out the fraction, and that of a column the seconds: then they are not written either.
    let resolution_s = if needs_second { 1 } else { 60 };
    let is_same = read.as_second().div_euclid(resolution_s) == probe.as_second().div_euclid(resolution_s);
    if is_same && read <= probe {
        return Ok(());
    }
    Err(format!("it writes {probe} as '{text}', and reads that as {read}"))
}

/// Whether a strptime pattern of a time names its zone: by an offset, by seconds since 1970, or by a literal Z at its end.
pub(crate) fn names_zone(pattern: &str) -> bool {
    let names = ["%z", "%:z", "%s", "%Q", "%:Q"].iter().any(|directive| pattern.contains(directive));
    names || (pattern.ends_with('Z') && !pattern.ends_with("%Z"))
}

/// Whether a date or a time of day was read, in part or as a whole.
fn has_civil_part(parsed: &BrokenDownTime) -> bool {
    let date = [parsed.month(), parsed.day(), parsed.hour(), parsed.minute(), parsed.second()];
    let has_week = parsed.iso_week_year().is_some() || parsed.iso_week().is_some();
    let has_day = parsed.day_of_year().is_some() || parsed.weekday().is_some() || parsed.year().is_some();
    has_week || has_day || date.iter().any(Option::is_some)
}
