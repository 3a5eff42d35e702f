//! The account of a session's clocks.

use model::UtcNs;
use serde::{Deserialize, Serialize};

/// The time lines of a session's sensors.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Timeline {
    /// The accelerometer's, if the profile declares one.
    pub acceleration: Option<StreamFacts>,
    /// The range sensor's, if the profile declares one.
    pub range: Option<StreamFacts>,
    /// Times that exist twice, because a clock was set back: what happened then cannot be told. Sorted and disjoint.
    pub ambiguous: Vec<Span>,
}

impl Timeline {
    /// Of the sensors' accounts.
    pub(crate) fn new(acceleration: Option<StreamFacts>, range: Option<StreamFacts>) -> Self {
        let mut spans: Vec<Span> = acceleration.iter().chain(&range).flat_map(StreamFacts::overlaps).collect();
        spans.sort_by_key(|span| (span.from, span.to));
        let mut ambiguous: Vec<Span> = Vec::new();
        for span in spans {
            match ambiguous.last_mut() {
                Some(last) if span.from <= last.to => last.to = last.to.max(span.to),
                _ => ambiguous.push(span),
            }
        }
        Self { acceleration, range, ambiguous }
    }

    /// Whether a window of `half_s` around `time` touches a time that exists twice.
    #[must_use]
    pub fn is_ambiguous(&self, time: UtcNs, half_s: f64) -> bool {
        let (from, to) = (time.plus_seconds(-half_s), time.plus_seconds(half_s));
        self.ambiguous.iter().any(|span| span.from <= to && from <= span.to)
    }
}

/// From one time to a later one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Span {
    /// Its first moment.
    pub from: UtcNs,
    /// Its last moment.
    pub to: UtcNs,
}

impl Span {
    /// Whether a later span that begins there has no gap to this one.
    pub(super) fn is_near(&self, begin: UtcNs, gap_s: f64) -> bool {
        begin >= self.from && begin.seconds_since(self.to) <= gap_s
    }

    /// Its length in seconds.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.to.seconds_since(self.from)
    }
}

/// The facts about one sensor's clock, by its samples.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct StreamFacts {
    /// Samples used.
    pub samples: u64,
    /// Samples that the files mark as missing.
    pub missing_samples: u64,
    /// From the first sample to the last.
    pub span: Option<Span>,
    /// The rate that the profile declares.
    pub nominal_rate_hz: f64,
    /// Steps between samples, over the time that they take; gaps and clock jumps left out. None without two samples, and
    /// where the times come from a declared rate.
    pub measured_rate_hz: Option<f64>,
    /// Shortest step between samples, in seconds, gaps and clock jumps left out.
    pub shortest_step_s: Option<f64>,
    /// Longest step likewise.
    pub longest_step_s: Option<f64>,
    /// Steps longer than this are gaps.
    pub gap_s: f64,
    /// Gaps: how many.
    pub gaps: u64,
    /// Gaps: seconds in all.
    pub gaps_total_s: f64,
    /// The first [`LISTED`] gaps, from the sample before to the sample after.
    pub listed_gaps: Vec<Span>,
    /// Packets, or batches of rows, that came after later ones, and were put in order.
    pub reordered: u64,
    /// Packets, or rows, whose time fits nothing around them: a damaged stamp. They are left out.
    pub misplaced: u64,
    /// Samples in them.
    pub misplaced_samples: u64,
    /// The time that the first one claims.
    pub first_misplaced: Option<UtcNs>,
    /// Packets that were there twice and are used once.
    pub duplicates: u64,
    /// The number of times that the clock was set while recording went on.
    pub jumps: u64,
    /// The times at which it was; the first [`LISTED`].
    pub clock_jumps: Vec<ClockJump>,
    /// Stretches of one time line each: one more than clock jumps, at most [`LISTED`]. Gaps do not end a stretch.
    pub stretches: Vec<Span>,
    /// The times between which there were samples, by stretch: a stretch without its gaps. At most twice [`LISTED`]; kept while ingest runs.
    #[serde(skip)]
    pub covered: Vec<(u64, Span)>,
    /// Whether the times come from a declared rate or duration, and not from stamps.
    #[serde(default)]
    pub times_declared: bool,
    /// Bytes of the sensor's files that gave nothing: damage, not headers.
    pub lost_bytes: u64,
}

impl StreamFacts {
    /// Times of which two stretches have samples.
    pub(super) fn overlaps(&self) -> Vec<Span> {
        let mut spans = Vec::new();
        for (i, (stretch, a)) in self.covered.iter().enumerate() {
            for (_, b) in self.covered[i + 1..].iter().filter(|(other, _)| other != stretch) {
                let (from, to) = (a.from.max(b.from), a.to.min(b.to));
                spans.extend((from <= to).then_some(Span { from, to }));
            }
        }
        spans
    }
}

/// A clock that was set while recording went on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ClockJump {
    /// The last time before it.
    pub at: UtcNs,
    /// By how much it was set, in seconds: negative for back.
    pub by_s: f64,
}

/// Gaps, and clock jumps, that are listed; more are only counted.
pub const LISTED: usize = 1000;
