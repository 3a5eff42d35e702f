//! Times as people read them: in the zone of the recording, with its offset from UTC.

use jiff::tz::TimeZone;
use jiff::{Timestamp, Zoned};
use model::UtcNs;
use serde::{Serialize, Serializer};

/// A moment in the recording's zone. In JSON: RFC 3339 with offset, such as `2021-03-01T09:00:10.25-06:00`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Moment(pub Zoned);

impl Moment {
    /// The moment of a time in a zone.
    #[must_use]
    pub fn new(time: UtcNs, zone: &TimeZone) -> Self {
        // Every i64 of ns is a timestamp.
        Self(Timestamp::from_nanosecond(i128::from(time.0)).unwrap_or_default().to_zoned(zone.clone()))
    }
}

impl Serialize for Moment {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&self.0.strftime("%Y-%m-%dT%H:%M:%S%.f%:z"))
    }
}

/// The span from one moment to a later one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LocalSpan {
    /// The first moment.
    pub from: Moment,
    /// The last moment.
    pub to: Moment,
    /// The seconds between them.
    pub duration_s: f64,
}

impl LocalSpan {
    /// The span between two times in a zone.
    #[must_use]
    pub fn new(from: UtcNs, to: UtcNs, zone: &TimeZone) -> Self {
        Self { from: Moment::new(from, zone), to: Moment::new(to, zone), duration_s: to.seconds_since(from) }
    }
}

/// A change of local time by law: from here on the zone has another offset from UTC.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LocalTimeChange {
    /// The first moment with the new offset.
    pub at: Moment,
    /// The seconds by which wall clocks go forward; negative for back.
    pub by_s: i64,
}

/// The changes of local time from one time to another.
pub(super) fn changes(from: UtcNs, to: UtcNs, zone: &TimeZone) -> Vec<LocalTimeChange> {
    let [from, to] = [from, to].map(|time| Moment::new(time, zone).0.timestamp());
    let mut offset = zone.to_offset(from);
    let mut changes = Vec::new();
    for transition in zone.following(from).take_while(|transition| transition.timestamp() <= to) {
        let by_s = i64::from(transition.offset().seconds()) - i64::from(offset.seconds());
        offset = transition.offset();
        if by_s != 0 {
            changes.push(LocalTimeChange { at: Moment(transition.timestamp().to_zoned(zone.clone())), by_s });
        }
    }
    changes
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use super::*;

    fn utc(text: &str) -> UtcNs {
        UtcNs(i64::try_from(text.parse::<Timestamp>().unwrap().as_nanosecond()).unwrap())
    }

    #[test]
    fn summer_time_is_found_where_it_falls_into_the_recording() {
        let chicago = TimeZone::get("America/Chicago").unwrap();
        let night = changes(utc("2026-03-08T02:00:00Z"), utc("2026-03-08T12:00:00Z"), &chicago);
        assert_eq!(serde_json::to_string(&night).unwrap(), r#"[{"at":"2026-03-08T03:00:00-05:00","by_s":3600}]"#);
        let autumn = changes(utc("2026-11-01T02:00:00Z"), utc("2026-11-01T12:00:00Z"), &chicago);
        assert_eq!(autumn.iter().map(|change| change.by_s).collect::<Vec<_>>(), [-3600]);
        assert!(changes(utc("2026-06-01T02:00:00Z"), utc("2026-06-02T12:00:00Z"), &chicago).is_empty());
        assert!(changes(utc("2026-03-08T02:00:00Z"), utc("2026-03-08T12:00:00Z"), &TimeZone::UTC).is_empty());
    }

    #[test]
    fn a_span_says_its_offset_and_its_length() {
        let chicago = TimeZone::get("America/Chicago").unwrap();
        let span = LocalSpan::new(utc("2026-07-01T12:00:00.25Z"), utc("2026-07-01T12:00:01Z"), &chicago);
        let json = r#"{"from":"2026-07-01T07:00:00.25-05:00","to":"2026-07-01T07:00:01-05:00","duration_s":0.75}"#;
        assert_eq!(serde_json::to_string(&span).unwrap(), json);
    }
}
