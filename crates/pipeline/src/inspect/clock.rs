//! The facts of a sensor's clock, for people and programs.

use ingest::timeline::{Span, StreamFacts, Timeline};
use jiff::tz::TimeZone;
use serde::Serialize;

use super::local_time::{LocalSpan, Moment};

/// The number of gaps, clock jumps, stretches and ambiguous spans that are listed; more are only counted.
pub const LISTED: usize = 5;

/// The facts of a sensor's clock.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ClockFacts {
    /// The number of samples that are used.
    pub samples: u64,
    /// The number of samples that the files mark as missing.
    pub missing_samples: u64,
    /// The number of bytes of the sensor's files that gave nothing: damage, not headers.
    pub lost_bytes: u64,
    /// The time from the first sample to the last.
    pub recorded: Option<LocalSpan>,
    /// The rate that the profile declares.
    pub nominal_rate_hz: f64,
    /// The rate by the stamps, without gaps and clock jumps; none where they give none.
    pub measured_rate_hz: Option<f64>,
    /// The shortest step between samples, without gaps and clock jumps.
    pub shortest_step_s: Option<f64>,
    /// The longest step between samples, without gaps and clock jumps.
    pub longest_step_s: Option<f64>,
    /// The steps that are longer than they may be.
    pub gaps: Gaps,
    /// The number of packets, or batches of rows, that were there twice and are used once.
    pub duplicate_blocks: u64,
    /// The number of packets, or batches of rows, that came after later ones and were put in order.
    pub reordered_blocks: u64,
    /// The number of packets, or rows, that are left out because their times fit nothing around them.
    pub misplaced_blocks: u64,
    /// The places where the clock was set while recording went on.
    pub clock_jumps: Jumps,
    /// The pieces of one time line each: one more than there are clock jumps.
    pub stretches: Stretches,
}

/// Gaps between samples.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Gaps {
    /// Steps longer than this are gaps.
    pub longer_than_s: f64,
    /// The number of them.
    pub count: u64,
    /// The seconds of all of them together.
    pub total_s: f64,
    /// The longest ones (of the first thousand), longest first; at most [`LISTED`].
    pub longest: Vec<LocalSpan>,
}

/// Clock jumps.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Jumps {
    /// The number of them.
    pub count: u64,
    /// The first ones; at most [`LISTED`].
    pub first: Vec<Jump>,
}

/// A clock that was set.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Jump {
    /// The last time before it.
    pub after: Moment,
    /// The seconds by which it was set; negative for back.
    pub by_s: f64,
}

/// Stretches of one time line each.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Stretches {
    /// The number of stretches; it is counted up to a thousand.
    pub count: usize,
    /// The first ones; at most [`LISTED`].
    pub first: Vec<LocalSpan>,
}

/// Times that exist twice because a clock was set back.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Ambiguous {
    /// The number of spans.
    pub count: usize,
    /// The seconds of all of them together.
    pub total_s: f64,
    /// The first spans; at most [`LISTED`].
    pub first: Vec<LocalSpan>,
}

impl ClockFacts {
    pub(super) fn new(facts: &StreamFacts, zone: &TimeZone) -> Self {
        let jump = |jump: &ingest::timeline::ClockJump| Jump { after: Moment::new(jump.at, zone), by_s: jump.by_s };
        Self {
            samples: facts.samples,
            missing_samples: facts.missing_samples,
            lost_bytes: facts.lost_bytes,
            recorded: facts.span.as_ref().map(|span| local(span, zone)),
            nominal_rate_hz: facts.nominal_rate_hz,
            measured_rate_hz: facts.measured_rate_hz,
            shortest_step_s: facts.shortest_step_s,
            longest_step_s: facts.longest_step_s,
            gaps: gaps(facts, zone),
            duplicate_blocks: facts.duplicates,
            reordered_blocks: facts.reordered,
            misplaced_blocks: facts.misplaced,
            clock_jumps: Jumps { count: facts.jumps, first: facts.clock_jumps.iter().take(LISTED).map(jump).collect() },
            stretches: Stretches { count: facts.stretches.len(), first: first(&facts.stretches, zone) },
        }
    }
}

impl Ambiguous {
    pub(super) fn new(timeline: &Timeline, zone: &TimeZone) -> Self {
        let spans = &timeline.ambiguous;
        // The iterator's own sum of nothing would be -0.
        let total_s = spans.iter().map(Span::seconds).fold(0.0, |sum, seconds| sum + seconds);
        Self { count: spans.len(), total_s, first: first(spans, zone) }
    }
}

fn gaps(facts: &StreamFacts, zone: &TimeZone) -> Gaps {
    let mut longest: Vec<&Span> = facts.listed_gaps.iter().collect();
    longest.sort_by(|a, b| b.seconds().total_cmp(&a.seconds()).then(a.from.cmp(&b.from)));
    let longest = longest.into_iter().take(LISTED).map(|span| local(span, zone)).collect();
    Gaps { longer_than_s: facts.gap_s, count: facts.gaps, total_s: facts.gaps_total_s, longest }
}

fn first(spans: &[Span], zone: &TimeZone) -> Vec<LocalSpan> {
    spans.iter().take(LISTED).map(|span| local(span, zone)).collect()
}

fn local(span: &Span, zone: &TimeZone) -> LocalSpan {
    LocalSpan::new(span.from, span.to, zone)
}

#[cfg(test)]
mod tests {
    use model::UtcNs;

    use super::*;

    #[test]
    fn the_longest_gaps_come_first_and_no_more_than_five() {
        let utc = |s: f64| UtcNs(0).plus_seconds(s);
        let lengths_s = [2.0, 9.0, 3.0, 9.0, 4.0, 5.0, 6.0];
        let listed_gaps: Vec<Span> = (0..)
            .zip(lengths_s)
            .map(|(i, s)| Span { from: utc(f64::from(i) * 20.0), to: utc(f64::from(i) * 20.0 + s) })
            .collect();
        let facts = |mut facts: StreamFacts| {
            (facts.gaps, facts.listed_gaps) = (7, listed_gaps);
            facts
        };
        let clock = ClockFacts::new(&facts(StreamFacts::default()), &TimeZone::UTC);
        let longest_s: Vec<i64> = clock.gaps.longest.iter().map(|span| span.duration_s as i64).collect();
        assert_eq!((longest_s, clock.gaps.count), (vec![9, 9, 6, 5, 4], 7));
        assert!(clock.gaps.longest[0].from.0 < clock.gaps.longest[1].from.0);
        let nothing = Ambiguous::new(&Timeline::default(), &TimeZone::UTC);
        assert!(nothing.total_s.is_sign_positive() && nothing.count == 0);
    }
}
