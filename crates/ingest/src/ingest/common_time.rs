//! Whether the images and the sensors of a card have times in common, and the likely cause where they have not.

use model::{Problem, ProblemCode, UtcNs};

use crate::card::Place;
use crate::profile::{Anchor, Epoch, Profile};
use crate::timeline::{Span, Timeline};

/// Zones are apart by whole multiples of this.
const QUARTER_S: f64 = 900.0;
/// Two zones are at most 26 h apart: from UTC-12 to UTC+14.
const MOST_ZONE_S: f64 = 26.0 * 3600.0;
/// The parts of a device do not start and end in the same moment.
const START_TOLERANCE_S: f64 = 150.0;
/// Where two spans overlap, both their ends must show the distance, and more sharply, to tell of a zone.
const SHIFT_TOLERANCE_S: f64 = 60.0;
/// No recording lasts so long: a clock that was never set, or another epoch.
const EPOCH_S: f64 = 300.0 * 86_400.0;

/// The images or the samples of a sensor: name, first and last time.
type Stream = (&'static str, Span);

/// The problems of images, accelerometer and range sensor that have no time in common, or lie apart by a zone.
pub(super) fn problems(images: &[UtcNs], timeline: &Timeline, profile: &Profile, place: &Place) -> Vec<Problem> {
    let of_images = images.iter().min().zip(images.iter().max()).map(|(from, to)| Span { from: *from, to: *to });
    let span = |facts: &Option<crate::timeline::StreamFacts>| facts.as_ref().and_then(|facts| facts.span);
    let images = of_images.map(|span| ("images", span));
    let acceleration = span(&timeline.acceleration).map(|span| ("accelerometer", span));
    let range = span(&timeline.range).map(|span| ("range sensor", span));
    let pairs = [(images, acceleration), (images, range), (acceleration, range)];
    let apart = pairs.into_iter().filter_map(|(a, b)| Some((a?, b?))).filter_map(|(a, b)| apart(a, b));
    apart.map(|apart| apart.problem(profile, place)).collect()
}

/// Two streams that do not fit each other.
struct Apart {
    first: Stream,
    second: Stream,
    /// From the start of the first to that of the second.
    by_s: f64,
    overlaps: bool,
}

fn apart(first: Stream, second: Stream) -> Option<Apart> {
    let (a, b) = (first.1, second.1);
    let overlaps = a.from <= b.to && b.from <= a.to;
    let by_s = b.from.seconds_since(a.from);
    let ends_s = b.to.seconds_since(a.to);
    let is_shifted =
        zone_shift_s(by_s, SHIFT_TOLERANCE_S).is_some_and(|shift_s| (ends_s - shift_s).abs() <= SHIFT_TOLERANCE_S);
    (!overlaps || is_shifted).then_some(Apart { first, second, by_s, overlaps })
}

/// The distance of two zones that is nearest to a distance of two starts, if it is near enough and not 0.
fn zone_shift_s(by_s: f64, tolerance_s: f64) -> Option<f64> {
    let shift_s = (by_s / QUARTER_S).round() * QUARTER_S;
    let is_near = (by_s - shift_s).abs() <= tolerance_s;
    (is_near && shift_s.abs() > 0.0 && shift_s.abs() <= MOST_ZONE_S).then_some(shift_s)
}

impl Apart {
    fn problem(&self, profile: &Profile, place: &Place) -> Problem {
        let tolerance_s = if self.overlaps { SHIFT_TOLERANCE_S } else { START_TOLERANCE_S };
        let zone_s = zone_shift_s(self.by_s, tolerance_s);
        let (distance, cause) = match zone_s {
            Some(shift_s) => (duration(shift_s.abs()), "the distance of two zones"),
            None if self.by_s.abs() > EPOCH_S => {
                (duration(self.by_s.abs()), "another epoch, or a clock that was never set")
            }
            None => (duration(self.by_s.abs()), "a clock that was not set, or files of two recordings"),
        };
        let has = if self.overlaps { "begin and end at different times" } else { "have no time in common" };
        let fact = format!(
            "{} {}, {} {} (UTC): {distance} apart; they {has}. The likely cause is {cause}",
            self.first.0,
            span_text(self.first.1),
            self.second.0,
            span_text(self.second.1),
        );
        place.problem(ProblemCode::NoCommonTime, "", fact, self.remedy(zone_s.is_some(), profile))
    }

    /// The keys that decide the times of the two.
    fn remedy(&self, is_zone: bool, profile: &Profile) -> String {
        let mut keys = Vec::new();
        if is_zone {
            keys.push("time_zone of study.toml".to_owned());
        }
        if self.first.0 == "images" {
            keys.push(match profile.images.as_ref().and_then(|images| images.time.pattern()) {
                Some(pattern) => format!("images.time.pattern = \"{pattern}\" (UTC only if it ends in Z)"),
                None => "images.time".to_owned(),
            });
        }
        for sensor in [self.first.0, self.second.0] {
            match sensor {
                "accelerometer" => keys.push(format!("the epoch of [acceleration] ({})", acceleration_epoch(profile))),
                "range sensor" => keys.push(format!("the epoch of [range] ({})", range_epoch(profile))),
                _ => {}
            }
        }
        match profile.clock.as_ref().map(|clock| &clock.anchor) {
            Some(Anchor::Session {}) => keys.push("clock_zero_utc of session.toml".to_owned()),
            Some(Anchor::Name { pattern }) => keys.push(format!("clock.anchor.pattern = \"{pattern}\"")),
            None => {}
        }
        format!("find out which of the two is right, and correct the other's: {}", keys.join(", "))
    }
}

fn acceleration_epoch(profile: &Profile) -> String {
    let stream = profile.acceleration.as_ref();
    let packets = stream.and_then(|stream| stream.packets.as_ref()).map(|packets| packets.stamp.epoch);
    let cwa = stream.and_then(|stream| stream.cwa.as_ref()).map(|cwa| cwa.epoch);
    let csv = stream.and_then(|stream| stream.csv.as_ref()).map(|csv| &csv.time);
    epoch_text(packets.or(cwa), csv)
}

fn range_epoch(profile: &Profile) -> String {
    let stream = profile.range.as_ref();
    let packets = stream.and_then(|stream| stream.packets.as_ref()).map(|packets| packets.stamp.epoch);
    epoch_text(packets, stream.and_then(|stream| stream.csv.as_ref()).map(|csv| &csv.time))
}

fn epoch_text(binary: Option<Epoch>, csv: Option<&crate::profile::RowTime>) -> String {
    if let Some(format) = csv.and_then(|time| time.format.as_ref()) {
        return format!("now by csv.time.format = \"{format}\", in time_zone unless it gives a zone or ends in Z");
    }
    let now = match binary.or(csv.map(|time| time.epoch)).unwrap_or_default() {
        Epoch::Unix => "unix",
        Epoch::Local => "local",
        Epoch::LocalAtStart => "local_at_start",
        Epoch::Boot => "boot",
    };
    format!("now {now}; unix, local or boot")
}

/// `2025-06-01 09:00:00 to 09:05:00`, with the second date where it is another.
fn span_text(span: Span) -> String {
    let text = |time: UtcNs| {
        let seconds = jiff::Timestamp::from_second(time.0.div_euclid(1_000_000_000)).unwrap_or_default();
        let text = seconds.strftime("%Y-%m-%d %H:%M:%S").to_string();
        text.split_once(' ').map(|(day, time)| (day.to_owned(), time.to_owned())).unwrap_or_default()
    };
    let ((from_day, from), (to_day, to)) = (text(span.from), text(span.to));
    if from_day == to_day {
        format!("{from_day} {from} to {to}")
    } else {
        format!("{from_day} {from} to {to_day} {to}")
    }
}

/// `7 h`, `5 h 45 min`, `12 min`, `19723 days`.
fn duration(seconds: f64) -> String {
    let minutes = (seconds / 60.0).round();
    let (hours, minutes) = ((minutes / 60.0).floor(), minutes % 60.0);
    match (hours, minutes) {
        (72.0.., _) => format!("{:.0} days", seconds / 86_400.0),
        (1.0.., 0.0) => format!("{hours} h"),
        (1.0.., _) => format!("{hours} h {minutes} min"),
        (_, 1.0..) => format!("{minutes} min"),
        _ => format!("{seconds:.0} s"),
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::timeline::StreamFacts;

    const NOON_S: i64 = 1_748_779_200;

    fn span(from_s: i64, to_s: i64) -> Span {
        Span { from: UtcNs(from_s * 1_000_000_000), to: UtcNs(to_s * 1_000_000_000) }
    }

    /// Facts of the problems of images from noon on for that long, and of the two sensors.
    fn told(images_s: i64, acceleration: (i64, i64), range: (i64, i64)) -> Vec<String> {
        let images = [UtcNs(NOON_S * 1_000_000_000), UtcNs((NOON_S + images_s) * 1_000_000_000)];
        let facts =
            |(from, to)| Some(StreamFacts { span: Some(span(NOON_S + from, NOON_S + to)), ..StreamFacts::default() });
        let timeline = Timeline::new(facts(acceleration), facts(range));
        let profile = Profile::load("aim2-packets", Path::new("none")).unwrap();
        let place = Place::of_card(Path::new("cards/P01"));
        let problems = problems(&images, &timeline, &profile, &place);
        assert!(problems.iter().all(|problem| problem.code == ProblemCode::NoCommonTime));
        problems.into_iter().map(|problem| format!("{}; {}", problem.fact, problem.remedy)).collect()
    }

    #[test]
    fn spans_that_fit_say_nothing() {
        assert!(told(300, (-5, 310), (-5, 310)).is_empty());
        assert!(told(300, (-3600, 7200), (0, 290)).is_empty(), "a sensor that runs longer");
        assert!(told(7200, (-900, 7300), (-900, 7300)).is_empty(), "a sensor that was started 15 minutes before");
    }

    #[test]
    fn seven_hours_are_a_zone() {
        let told = told(300, (-7 * 3600 - 5, -7 * 3600 + 310), (-5, 310));
        assert_eq!(told.len(), 2, "{told:?}");
        let spans =
            "images 2025-06-01 12:00:00 to 12:05:00, accelerometer 2025-06-01 04:59:55 to 05:05:10 (UTC): 7 h apart";
        assert!(told[0].starts_with(spans), "{}", told[0]);
        assert!(told[0].contains("two zones") && told[0].contains("time_zone of study.toml"), "{}", told[0]);
        assert!(told[1].contains("accelerometer") && told[1].contains("range sensor"), "{}", told[1]);
    }

    #[test]
    fn an_hour_is_a_zone_where_the_spans_overlap_too() {
        let told = told(7200, (-3605, 3610), (-5, 7210));
        assert!(told[0].contains("1 h apart; they begin and end at different times"), "{}", told[0]);
        let nepal = apart(("images", span(0, 36_000)), ("accelerometer", span(20_700, 56_700)));
        assert!(nepal.is_some_and(|apart| duration(apart.by_s) == "5 h 45 min"));
    }

    #[test]
    fn years_are_an_epoch() {
        let told = told(300, (-NOON_S, -NOON_S + 310), (-NOON_S, -NOON_S + 310));
        assert_eq!(told.len(), 2, "the two sensors lie together: {told:?}");
        assert!(told[0].contains("20240 days apart") && told[0].contains("another epoch"), "{}", told[0]);
        assert!(told[0].contains("the epoch of [acceleration] (now unix"), "{}", told[0]);
    }

    #[test]
    fn twenty_minutes_are_two_recordings() {
        let told = told(300, (1200, 1500), (1200, 1500));
        assert!(told[0].contains("20 min apart") && told[0].contains("two recordings"), "{}", told[0]);
    }
}
