//! The lag between a session's images and its sensors, where the study asks for it.

use ingest::{ImageEntry, ReadError, SessionReader, Thumbnail};
use model::{Problem, ProblemCode, Severity, Stage};

use crate::signals::lag::{self, LagEstimate, LagVerdict, PairMotion};

/// At most this many pairs of pictures are decoded, spread over the session.
const MAX_PAIRS: usize = 300;
/// Pictures further apart in time than this have little in common.
const MAX_APART_S: f64 = 30.0;
/// The larger side of the reduced pictures that are compared.
const THUMBNAIL_PX: u32 = 64;

/// Estimates the lag from pairs of consecutive images, which must be in the order of time.
pub(super) fn estimate(reader: &mut SessionReader, images: &[ImageEntry]) -> Result<LagEstimate, ReadError> {
    let firsts = chosen(images);
    let mut needed: Vec<usize> = firsts.iter().flat_map(|first| [*first, first + 1]).collect();
    needed.dedup();
    let mut thumbnails = Vec::with_capacity(needed.len());
    for image in &needed {
        thumbnails.push(thumbnail(reader, &images[*image].file)?);
    }
    let times: Vec<_> = needed.iter().map(|image| images[*image].time).collect();
    let directions = lag::directions(reader, &times)?;
    let position = |image: usize| needed.binary_search(&image).ok();
    let pair = |first: &usize| {
        let (a, b) = (position(*first)?, position(first + 1)?);
        let change = lag::change(thumbnails[a].as_ref()?, thumbnails[b].as_ref()?)?;
        Some(PairMotion { change, from: &directions[a], to: &directions[b] })
    };
    Ok(lag::estimate(&firsts.iter().filter_map(pair).collect::<Vec<_>>()))
}

/// The numbers of the images that begin a pair.
fn chosen(images: &[ImageEntry]) -> Vec<usize> {
    let near = |i: &usize| images[i + 1].time.seconds_since(images[*i].time) <= MAX_APART_S;
    let all: Vec<usize> = (0..images.len().saturating_sub(1)).filter(near).collect();
    let step = all.len().div_ceil(MAX_PAIRS).max(1);
    all.into_iter().step_by(step).collect()
}

/// The reduced picture; none where it cannot be decoded, and its pairs are then left out.
fn thumbnail(reader: &mut SessionReader, file: &str) -> Result<Option<Thumbnail>, ReadError> {
    let bytes = reader.image_bytes(file)?;
    let decoded = ingest::thumbnail(&bytes, THUMBNAIL_PX);
    if let Err(error) = &decoded {
        tracing::debug!(file, "left out of the lag: {error}");
    }
    Ok(decoded.ok())
}

/// The note for the session's status; `declared_s` is the lag with which the signals were looked up.
pub(super) fn note(session: &str, estimate: &LagEstimate, declared_s: f64) -> Problem {
    let facts = facts(estimate);
    let (code, fact, remedy) = match estimate.verdict {
        LagVerdict::Known => (
            ProblemCode::ImageLagEstimated,
            format!("{facts}; declared and used: {declared_s:.1} s"),
            "if it differs from the declared one and is alike in other sessions, set [time] image_lag_s to it",
        ),
        _ => (
            ProblemCode::ImageLagUnknown,
            format!("the lag between images and sensors cannot be told: {}{facts}", why(estimate.verdict)),
            "nothing was changed; a session with more motion, or a nod in front of the camera, tells more",
        ),
    };
    Problem {
        severity: Severity::Note,
        stage: Stage::Signals,
        code,
        place: format!("cards/{session}"),
        fact,
        remedy: remedy.to_owned(),
    }
}

fn why(verdict: LagVerdict) -> &'static str {
    match verdict {
        LagVerdict::Known => "",
        LagVerdict::TooFewPairs => "fewer than 30 pairs of pictures with acceleration around both; ",
        LagVerdict::NoAgreement => "pictures and gravity agree no better than by chance; ",
        LagVerdict::NotSharp => "they agree nearly as well at other lags; ",
        LagVerdict::AtTheEnd => "they agree best at the end of the search, 10 s; ",
    }
}

fn facts(estimate: &LagEstimate) -> String {
    let pairs = estimate.pairs;
    match (estimate.lag_s, estimate.half_width_s, estimate.correlation) {
        (Some(lag_s), Some(half_s), Some(correlation)) => format!(
            "sensor time minus image time is {lag_s:.2} +- {half_s:.2} s, rank correlation {correlation:.2}, {pairs} pairs"
        ),
        _ => format!("{pairs} pairs"),
    }
}

#[cfg(test)]
mod tests {
    use model::UtcNs;

    use super::*;

    fn images(times_s: impl Iterator<Item = f64>) -> Vec<ImageEntry> {
        let image = |s| ImageEntry {
            file: format!("{s}"),
            time: UtcNs(0).plus_seconds(s),
            bytes: 1,
            width_px: 1,
            height_px: 1,
            orientation: model::Orientation::Upright,
        };
        times_s.map(image).collect()
    }

    #[test]
    fn pairs_are_near_in_time_and_spread_over_the_session() {
        assert_eq!(chosen(&images([0.0, 10.0, 20.0, 90.0, 100.0].into_iter())), [0, 1, 3]);
        let week = chosen(&images((0..60_480).map(|i| f64::from(i) * 10.0)));
        assert!(week.len() <= MAX_PAIRS && week.len() > MAX_PAIRS / 2 && week.last() > Some(&60_000));
        assert!(chosen(&[]).is_empty() && chosen(&images([0.0].into_iter())).is_empty());
    }

    #[test]
    fn the_note_says_what_was_found_and_what_was_used() {
        let estimated = LagEstimate {
            verdict: LagVerdict::Known,
            lag_s: Some(-1.52),
            correlation: Some(0.71),
            half_width_s: Some(0.35),
            pairs: 250,
        };
        let problem = note("P01", &estimated, 0.0);
        assert_eq!((problem.code, problem.severity), (ProblemCode::ImageLagEstimated, Severity::Note));
        assert!(
            problem.fact.contains("-1.52 +- 0.35 s") && problem.fact.contains("declared and used: 0.0 s"),
            "{}",
            problem.fact
        );
        let unknown = note("P01", &LagEstimate { verdict: LagVerdict::NotSharp, ..estimated }, 0.0);
        assert_eq!(unknown.code, ProblemCode::ImageLagUnknown);
    }
}
