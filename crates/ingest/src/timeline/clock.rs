//! From a device's stamps to UTC.

use jiff::tz::{AmbiguousOffset, TimeZone};
use jiff::{SignedDuration, Timestamp, civil};
use model::UtcNs;

use crate::profile::Epoch;

/// Local time is resolved anew where it enters another stretch of this length: zones change at full quarters of an hour.
const QUARTER_NS: i64 = 900 * 1_000_000_000;

/// A counter that wraps may go back by this part of its turn without having started anew.
const LATE_PART: i128 = 8;

/// Why a stamp is no time.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ClockError {
    /// The clock counts from the device's start, and nobody says when that was.
    #[error("the clock counts from when the device was started, and nothing says when that was")]
    NoAnchor,
    /// Before 1970 or after 2262.
    #[error("a stamp lies before 1970 or after 2262")]
    Range,
    /// A local time that a clock change skips.
    #[error("the local time {0} does not exist: clocks change there")]
    Skipped(String),
    /// A local time that a clock change shows twice, with nothing before it that tells which it is.
    #[error("the local time {0} exists twice: clocks change there, and no sample before tells which it is")]
    Twice(String),
}

/// From a device's stamps to UTC, in the order of the stamps: a counter that starts anew, or an hour that local time shows
/// twice, is told by what came before.
#[derive(Debug, Clone)]
pub struct Clock {
    epoch: Epoch,
    zone: TimeZone,
    /// UTC at which a boot-relative clock was zero.
    anchor: Option<UtcNs>,
    /// The counter starts anew after so many ns.
    wrap_ns: Option<i128>,
    /// Unwrapped stamp of the last one.
    last_unwrapped: Option<i128>,
    last: Option<UtcNs>,
    /// Why the first stamp of a clock whose offset stays is no time.
    refused: Option<ClockError>,
    /// Quarter of an hour of local time, and its offset, where it has one only.
    known: Option<(i64, i64)>,
}

impl Clock {
    /// A clock. `wrap_ns`: the counter starts anew after so many ns. `zone`: for local time.
    #[must_use]
    pub fn new(epoch: Epoch, wrap_ns: Option<i128>, zone: TimeZone) -> Self {
        Self { epoch, zone, anchor: None, wrap_ns, last_unwrapped: None, last: None, refused: None, known: None }
    }

    /// UTC at which a boot-relative clock was zero.
    #[must_use]
    pub fn anchor(&self) -> Option<UtcNs> {
        self.anchor
    }

    /// Sets the anchor for all stamps from now on. Another anchor is another start of the device: its counter starts anew.
    pub fn set_anchor(&mut self, anchor: Option<UtcNs>) {
        if self.anchor != anchor {
            self.last_unwrapped = None;
        }
        self.anchor = anchor;
    }

    /// UTC of a stamp.
    ///
    /// # Errors
    /// [`ClockError`] when it is no time.
    pub fn utc(&mut self, stamp_ns: i64) -> Result<UtcNs, ClockError> {
        let unwrapped = self.unwrapped(stamp_ns);
        let utc = match self.epoch {
            Epoch::Unix => in_range(unwrapped)?,
            Epoch::Boot => in_range(i128::from(self.anchor.ok_or(ClockError::NoAnchor)?.0) + unwrapped)?,
            Epoch::Local => self.utc_of_local(in_range(unwrapped)?)?,
            Epoch::LocalAtStart => self.utc_of_local_at_start(in_range(unwrapped)?)?,
        };
        self.last_unwrapped = Some(unwrapped);
        self.last = Some(utc);
        Ok(utc)
    }

    /// The stamp in the first turn of the counter in which it is not far behind the last one.
    fn unwrapped(&self, stamp_ns: i64) -> i128 {
        let stamp = i128::from(stamp_ns);
        match (self.wrap_ns, self.last_unwrapped) {
            (Some(wrap), Some(last)) => {
                // A packet that was written late is a little behind; what is further back has begun anew.
                let turns = (last - stamp - wrap / LATE_PART + wrap - 1).div_euclid(wrap).max(0);
                stamp + turns * wrap
            }
            _ => stamp,
        }
    }

    fn utc_of_local_at_start(&mut self, local: UtcNs) -> Result<UtcNs, ClockError> {
        match self.known {
            Some((_, offset_ns)) => in_range(i128::from(local.0) - i128::from(offset_ns)),
            None => {
                // By the first stamp or not at all: a later one may be under another offset.
                if let Some(error) = &self.refused {
                    return Err(error.clone());
                }
                let utc = self.utc_of_local(local);
                match &utc {
                    Ok(utc) => self.known = Some((0, local.0 - utc.0)),
                    Err(error) => self.refused = Some(error.clone()),
                }
                utc
            }
        }
    }

    /// `local`: ns since 1970-01-01 00:00 on the wall clock.
    fn utc_of_local(&mut self, local: UtcNs) -> Result<UtcNs, ClockError> {
        let quarter = local.0.div_euclid(QUARTER_NS);
        if let Some((known, offset_ns)) = self.known
            && known == quarter
        {
            return in_range(i128::from(local.0) - i128::from(offset_ns));
        }
        let wall = civil_of(local)?;
        let offset_ns = |offset: jiff::tz::Offset| i64::from(offset.seconds()) * 1_000_000_000;
        match self.zone.to_ambiguous_timestamp(wall).offset() {
            AmbiguousOffset::Unambiguous { offset } => {
                self.known = Some((quarter, offset_ns(offset)));
                in_range(i128::from(local.0) - i128::from(offset_ns(offset)))
            }
            AmbiguousOffset::Gap { .. } => Err(ClockError::Skipped(wall.to_string())),
            AmbiguousOffset::Fold { before, after } => {
                let first = in_range(i128::from(local.0) - i128::from(offset_ns(before)))?;
                let second = in_range(i128::from(local.0) - i128::from(offset_ns(after)))?;
                match self.last {
                    None => Err(ClockError::Twice(wall.to_string())),
                    Some(last) if second.0.abs_diff(last.0) < first.0.abs_diff(last.0) => Ok(second),
                    Some(_) => Ok(first),
                }
            }
        }
    }
}

fn civil_of(local: UtcNs) -> Result<civil::DateTime, ClockError> {
    let since = SignedDuration::from_nanos(local.0);
    Timestamp::UNIX_EPOCH
        .checked_add(since)
        .map(|timestamp| TimeZone::UTC.to_datetime(timestamp))
        .map_err(|_| ClockError::Range)
}

fn in_range(ns: i128) -> Result<UtcNs, ClockError> {
    i64::try_from(ns).ok().filter(|ns| *ns >= 0).map(UtcNs).ok_or(ClockError::Range)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use super::*;

    const S: i64 = 1_000_000_000;

    fn chicago() -> TimeZone {
        TimeZone::get("America/Chicago").unwrap()
    }

    fn local(text: &str) -> i64 {
        let wall: civil::DateTime = text.parse().unwrap();
        i64::try_from(TimeZone::UTC.to_timestamp(wall).unwrap().as_nanosecond()).unwrap()
    }

    fn utc(text: &str) -> UtcNs {
        UtcNs(i64::try_from(text.parse::<Timestamp>().unwrap().as_nanosecond()).unwrap())
    }

    #[test]
    fn a_32_bit_counter_that_starts_anew_goes_on() {
        let wrap_ns = (1_i128 << 32) * 1_000_000;
        let mut clock = Clock::new(Epoch::Boot, Some(wrap_ns), TimeZone::UTC);
        assert_eq!(clock.utc(5), Err(ClockError::NoAnchor));
        clock.set_anchor(Some(UtcNs(1_000 * S)));
        let late_ms = i64::from(u32::MAX) - 999;
        let before = clock.utc(late_ms * 1_000_000).unwrap();
        let after = clock.utc(1_000 * 1_000_000).unwrap();
        assert_eq!(after.0 - before.0, 2 * S);
        // A packet from before that comes late is still of the turn before.
        assert_eq!(clock.utc((late_ms + 500) * 1_000_000).unwrap().0 - before.0, S / 2);
    }

    #[test]
    fn a_gap_of_most_of_a_turn_is_a_gap() {
        let mut clock = Clock::new(Epoch::Boot, Some((1_i128 << 32) * 1000), TimeZone::UTC);
        clock.set_anchor(Some(UtcNs(0)));
        clock.utc(4_000 * S).unwrap();
        let last = clock.utc(100 * S).unwrap(); // the counter has started anew after 4294.97 s
        assert!((last.seconds_since(UtcNs(0)) - 4_394.967).abs() < 0.001);
        assert!((clock.utc(2_500 * S).unwrap().seconds_since(last) - 2_400.0).abs() < 1e-6);
    }

    #[test]
    fn another_anchor_is_another_start() {
        let mut clock = Clock::new(Epoch::Boot, Some((1_i128 << 32) * 1000), TimeZone::UTC);
        clock.set_anchor(Some(UtcNs(0)));
        clock.utc(3000 * S).unwrap();
        clock.set_anchor(Some(UtcNs(10_000 * S)));
        assert_eq!(clock.utc(S).unwrap(), UtcNs(10_001 * S));
    }

    #[test]
    fn a_late_stamp_in_the_hour_that_exists_twice_is_still_of_the_first() {
        let mut clock = Clock::new(Epoch::Local, None, chicago());
        clock.utc(local("2026-11-01T00:59:59")).unwrap();
        clock.utc(local("2026-11-01T01:10:00.2")).unwrap();
        assert_eq!(clock.utc(local("2026-11-01T01:10:00.1")).unwrap(), utc("2026-11-01T06:10:00.1Z"));
    }

    #[test]
    fn a_recording_that_starts_in_that_hour_is_refused_whole_where_its_offset_stays() {
        let mut clock = Clock::new(Epoch::LocalAtStart, None, chicago());
        assert!(matches!(clock.utc(local("2026-11-01T01:10:00")), Err(ClockError::Twice(_))));
        assert!(matches!(clock.utc(local("2026-11-01T03:00:00")), Err(ClockError::Twice(_))));
    }

    #[test]
    fn local_time_follows_the_zone() {
        let mut clock = Clock::new(Epoch::Local, None, chicago());
        assert_eq!(clock.utc(local("2026-01-10T12:00:00")).unwrap(), utc("2026-01-10T18:00:00Z"));
        assert_eq!(clock.utc(local("2026-07-10T12:00:00")).unwrap(), utc("2026-07-10T17:00:00Z"));
    }

    #[test]
    fn an_hour_that_exists_twice_is_told_by_what_came_before() {
        let mut clock = Clock::new(Epoch::Local, None, chicago());
        assert!(matches!(clock.utc(local("2026-11-01T01:30:00")), Err(ClockError::Twice(_))));
        assert_eq!(clock.utc(local("2026-11-01T00:59:59")).unwrap(), utc("2026-11-01T05:59:59Z"));
        assert_eq!(clock.utc(local("2026-11-01T01:30:00")).unwrap(), utc("2026-11-01T06:30:00Z"));
        assert_eq!(clock.utc(local("2026-11-01T01:59:59")).unwrap(), utc("2026-11-01T06:59:59Z"));
        assert_eq!(clock.utc(local("2026-11-01T01:00:00")).unwrap(), utc("2026-11-01T07:00:00Z"));
        assert_eq!(clock.utc(local("2026-11-01T02:00:00")).unwrap(), utc("2026-11-01T08:00:00Z"));
    }

    #[test]
    fn a_device_that_knows_no_summer_time_keeps_its_offset() {
        let mut clock = Clock::new(Epoch::LocalAtStart, None, chicago());
        assert_eq!(clock.utc(local("2026-10-31T23:00:00")).unwrap(), utc("2026-11-01T04:00:00Z"));
        assert_eq!(clock.utc(local("2026-11-01T01:30:00")).unwrap(), utc("2026-11-01T06:30:00Z"));
        assert_eq!(clock.utc(local("2026-11-01T12:00:00")).unwrap(), utc("2026-11-01T17:00:00Z"));
    }

    #[test]
    fn an_hour_that_never_was_is_refused() {
        let mut clock = Clock::new(Epoch::Local, None, chicago());
        assert!(matches!(clock.utc(local("2026-03-08T02:30:00")), Err(ClockError::Skipped(_))));
        assert_eq!(clock.utc(local("2026-03-08T03:00:00")).unwrap(), utc("2026-03-08T08:00:00Z"));
    }
}
