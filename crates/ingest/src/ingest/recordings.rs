//! Whether a card holds more than one recording.

use model::{Problem, ProblemCode, UtcNs};

use crate::card::Place;
use crate::parse::image_time::utc_text;

/// A longer hole than this between two images begins another recording: a night, or another wearer's day.
pub(super) const HOLE_S: f64 = 6.0 * 3600.0;
const MOST_LISTED: usize = 6;

/// The stretches of a card: first time, last time, count. Two times that are more than `hole_s` seconds apart, with none
/// between them, are in different stretches. The times may come in any order.
pub(super) fn recordings(times: &[UtcNs], hole_s: f64) -> Vec<(UtcNs, UtcNs, usize)> {
    let mut times = times.to_vec();
    times.sort_unstable();
    let stretches = times.chunk_by(|earlier, later| later.0.abs_diff(earlier.0) as f64 / 1e9 <= hole_s);
    stretches.filter_map(|stretch| Some((*stretch.first()?, *stretch.last()?, stretch.len()))).collect()
}

/// A note where the images stand in more than one stretch.
pub(super) fn note(times: &[UtcNs], place: &Place) -> Option<Problem> {
    let stretches = recordings(times, HOLE_S);
    if stretches.len() < 2 {
        return None;
    }
    let listed: Vec<String> = stretches
        .iter()
        .take(MOST_LISTED)
        .map(|(first, last, images)| {
            let plural = if *images == 1 { "" } else { "s" };
            format!("{} to {} ({images} image{plural})", utc_text(*first), utc_text(*last))
        })
        .collect();
    let and_more = if stretches.len() > MOST_LISTED { ", ..." } else { "" };
    let (count, listed) = (stretches.len(), listed.join(", "));
    let fact = format!("images in {count} stretches with more than 6 h between them, UTC: {listed}{and_more}");
    let remedy = "if they are sessions of two wearers, put each in a card folder of its own; if the device's clock was \
                  reset, correct it";
    Some(place.note(ProblemCode::TwoRecordings, "", fact, remedy))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use model::Severity;

    use super::*;

    fn times(seconds: &[i64]) -> Vec<UtcNs> {
        seconds.iter().map(|second| UtcNs(second * 1_000_000_000)).collect()
    }

    #[test]
    fn a_hole_that_is_longer_begins_another_stretch() {
        let second = |s: i64| UtcNs(s * 1_000_000_000);
        assert_eq!(recordings(&times(&[0, 10, 20]), 10.0), [(second(0), second(20), 3)]);
        assert_eq!(
            recordings(&times(&[40, 0, 10, 21, 22]), 10.0),
            [(second(0), second(10), 2), (second(21), second(22), 2), (second(40), second(40), 1)]
        );
        assert_eq!(recordings(&[], 10.0), []);
        assert_eq!(recordings(&times(&[5, 5]), 0.0), [(second(5), second(5), 2)]);
    }

    #[test]
    fn a_card_with_one_stretch_says_nothing() {
        let place = Place::of_card(Path::new("cards/P01"));
        assert_eq!(note(&[], &place), None);
        assert_eq!(note(&times(&[0, 6 * 3600]), &place), None, "6 h are not more than 6 h");
    }

    #[test]
    fn a_card_with_two_lists_them() {
        let place = Place::of_card(Path::new("cards/P01"));
        let problem = note(&times(&[0, 60, 86_400]), &place).unwrap();
        assert_eq!((problem.code.code(), problem.severity), ("two_recordings", Severity::Note));
        let stretches = "1970-01-01T00:00:00Z to 1970-01-01T00:01:00Z (2 images), 1970-01-02T00:00:00Z to 1970-01-02T00:00:00Z (1 image)";
        assert!(problem.fact.ends_with(stretches), "{}", problem.fact);
        let many: Vec<i64> = (0..10).map(|day| day * 86_400).collect();
        assert!(note(&times(&many), &place).unwrap().fact.ends_with("(1 image), ..."));
    }
}
