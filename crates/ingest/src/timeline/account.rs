//! The account of one sensor's clock, kept while its blocks pass.

use model::UtcNs;

use super::block::{Block, Times};
use super::facts::{ClockJump, LISTED, Span, StreamFacts};

/// Keeps the account of one time line. Bounded: lists end at [`LISTED`].
#[derive(Debug)]
pub(super) struct Account {
    pub facts: StreamFacts,
    /// Last time and packet number of the stretch.
    last: Option<(UtcNs, Option<u32>)>,
    /// Listed gaps before this one are of earlier stretches, and say nothing of what was recorded since.
    first_gap: usize,
    /// The clock was set back before the next block.
    is_set_back: bool,
    steps: u64,
    steps_s: f64,
}

impl Account {
    pub fn new(nominal_rate_hz: f64, gap_s: f64) -> Self {
        let facts = StreamFacts { nominal_rate_hz, gap_s, ..StreamFacts::default() };
        Self { facts, last: None, first_gap: 0, is_set_back: false, steps: 0, steps_s: 0.0 }
    }

    /// Last time of the stretch.
    pub fn newest(&self) -> Option<UtcNs> {
        self.last.map(|(newest, _)| newest)
    }

    /// The next block begins a new stretch, at an earlier time.
    pub fn set_back(&mut self) {
        self.is_set_back = true;
    }

    /// Whether nothing that was accounted for overlaps these times: they lie after it, before it, or in a listed gap of the
    /// stretch.
    pub fn has_hole(&self, begin: UtcNs, end: UtcNs) -> bool {
        let is_after = self.newest().is_none_or(|newest| newest < begin);
        let is_before = self.facts.stretches.iter().all(|stretch| end < stretch.from);
        is_after || is_before || self.gap_around(begin, end).is_some()
    }

    /// The listed gap of the stretch in which these times lie.
    fn gap_around(&self, begin: UtcNs, end: UtcNs) -> Option<usize> {
        let within = |i: &usize| self.facts.listed_gaps[*i].from < begin && end < self.facts.listed_gaps[*i].to;
        (self.first_gap..self.facts.listed_gaps.len()).find(within)
    }

    /// The next block in order of time.
    pub fn add(&mut self, block: &Block) {
        let (begin, end) = (block.times.first(), block.times.last());
        match self.last {
            Some((last, sequence)) => self.between(last, sequence, block),
            None => self.begin_stretch(begin),
        }
        self.cover(block, end);
        self.steps_within(&block.times);
        self.last = Some((end, block.sequence));
    }

    /// A block that comes too late to be put in order, in a hole.
    pub fn add_late(&mut self, block: &Block) {
        let (begin, end) = (block.times.first(), block.times.last());
        if let Some(i) = self.gap_around(begin, end) {
            let gap = self.facts.listed_gaps.remove(i);
            self.facts.gaps -= 1;
            self.facts.gaps_total_s -= gap.seconds();
            for part in [Span { from: gap.from, to: begin }, Span { from: end, to: gap.to }] {
                self.step(part);
            }
        } else if let Some(first) = self.facts.stretches.iter_mut().min_by_key(|stretch| stretch.from)
            && begin < first.from
        {
            let before = Span { from: end, to: first.from };
            first.from = begin;
            self.step(before);
        }
        self.cover_span(begin, end);
        self.steps_within(&block.times);
        self.facts.samples += block.times.len() as u64;
    }

    /// A block whose time fits nothing around it.
    pub fn leave_out(&mut self, block: &Block) {
        self.facts.misplaced += 1;
        self.facts.misplaced_samples += block.times.len() as u64;
        self.facts.first_misplaced.get_or_insert(block.times.first());
    }

    pub fn finish(mut self) -> StreamFacts {
        #[expect(clippy::cast_precision_loss, reason = "2^53 samples are two million years")]
        let rate_hz = (self.steps > 0 && self.steps_s > 0.0).then(|| self.steps as f64 / self.steps_s);
        self.facts.measured_rate_hz = rate_hz;
        let (from, to) =
            (self.facts.stretches.iter().map(|s| s.from).min(), self.facts.stretches.iter().map(|s| s.to).max());
        self.facts.span = from.zip(to).map(|(from, to)| Span { from, to });
        self.facts
    }

    fn between(&mut self, last: UtcNs, sequence: Option<u32>, block: &Block) {
        let begin = block.times.first();
        let follows = sequence.zip(block.sequence).is_some_and(|(last, this)| last.wrapping_add(1) == this);
        let is_set_forward = follows && begin.seconds_since(last) > self.facts.gap_s;
        if self.is_set_back || is_set_forward {
            self.is_set_back = false;
            let jump = ClockJump { at: last, by_s: begin.seconds_since(last) };
            self.facts.jumps += 1;
            if self.facts.clock_jumps.len() < LISTED {
                self.facts.clock_jumps.push(jump);
            }
            self.begin_stretch(begin);
        } else {
            self.step(Span { from: last, to: begin });
        }
    }

    /// Samples from there to there, of the current stretch. The list is bounded, and errs towards times that exist twice: a
    /// stretch that has many gaps loses them, and beyond twice the bound two spans that grow together cover each other.
    fn cover_span(&mut self, from: UtcNs, to: UtcNs) {
        let (stretch, gap_s) = (self.facts.jumps, self.facts.gap_s);
        let covered = &mut self.facts.covered;
        let spans = covered.len();
        if spans >= 2 * LISTED {
            for ((of, span), own) in covered.iter_mut().rev().zip([u64::MAX, u64::MAX - 1]) {
                *of = own;
                *span = Span { from: span.from.min(from), to: span.to.max(to) };
            }
            return;
        }
        match covered.last_mut() {
            Some((of, last)) if *of == stretch && (spans >= LISTED || last.is_near(from, gap_s)) => {
                *last = Span { from: last.from.min(from), to: last.to.max(to) };
            }
            _ => covered.push((stretch, Span { from, to })),
        }
    }

    /// Stretches beyond the list's end grow its last one, so that nothing that exists twice passes for unique.
    fn begin_stretch(&mut self, begin: UtcNs) {
        self.first_gap = self.facts.listed_gaps.len();
        if self.facts.stretches.len() < LISTED {
            self.facts.stretches.push(Span { from: begin, to: begin });
        } else if let Some(last) = self.facts.stretches.last_mut() {
            last.from = last.from.min(begin);
        }
    }

    fn cover(&mut self, block: &Block, end: UtcNs) {
        self.facts.samples += block.times.len() as u64;
        self.cover_span(block.times.first(), end);
        if let Some(stretch) = self.facts.stretches.last_mut() {
            stretch.to = stretch.to.max(end);
        }
    }

    fn steps_within(&mut self, times: &Times) {
        match times {
            Times::Even { step_ns, samples, .. } if *samples > 1 => {
                let step_s = step_ns / 1e9;
                if step_s > self.facts.gap_s {
                    times.each().zip(times.each().skip(1)).for_each(|(from, to)| self.step(Span { from, to }));
                    return;
                }
                #[expect(clippy::cast_precision_loss, reason = "a block has far fewer than 2^53 samples")]
                let total_s = (samples - 1) as f64 * step_s;
                self.steps += *samples as u64 - 1;
                self.steps_s += total_s;
                self.note_step(step_s);
            }
            Times::Even { .. } => {}
            Times::Each(times) => {
                for pair in times.windows(2) {
                    self.step(Span { from: pair[0], to: pair[1] });
                }
            }
        }
    }

    fn step(&mut self, step: Span) {
        let seconds = step.seconds();
        if seconds > self.facts.gap_s {
            self.facts.gaps += 1;
            self.facts.gaps_total_s += seconds;
            if self.facts.listed_gaps.len() < LISTED {
                self.facts.listed_gaps.push(step);
            }
            return;
        }
        self.steps += 1;
        self.steps_s += seconds;
        self.note_step(seconds);
    }

    fn note_step(&mut self, seconds: f64) {
        let facts = &mut self.facts;
        facts.shortest_step_s = Some(facts.shortest_step_s.map_or(seconds, |shortest| shortest.min(seconds)));
        facts.longest_step_s = Some(facts.longest_step_s.map_or(seconds, |longest| longest.max(seconds)));
    }
}

#[cfg(test)]
mod tests {
    use super::super::Timeline;
    use super::*;

    fn block(from_s: i64) -> Block {
        let times = Times::Even { first: UtcNs(from_s * 1_000_000_000), step_ns: 1e8, samples: 10 };
        Block { times, sequence: None, channels: vec![vec![0.0; 10]], extra: vec![] }
    }

    /// Times that exist twice, of a session in blocks of 1 s.
    fn ambiguous(stretches: &[&[i64]]) -> Vec<Span> {
        let mut account = Account::new(10.0, 0.5);
        for (i, stretch) in stretches.iter().enumerate() {
            if i > 0 {
                account.set_back();
            }
            stretch.iter().for_each(|from_s| account.add(&block(*from_s)));
        }
        Timeline::new(Some(account.finish()), None).ambiguous
    }

    #[test]
    fn what_lies_in_a_gap_of_another_stretch_exists_once() {
        assert_eq!(ambiguous(&[&[0, 1, 100, 101], &[50, 51]]), []);
        assert_eq!(ambiguous(&[&[0, 1, 100, 101], &[50, 100]]).len(), 1);
    }

    #[test]
    fn many_gaps_hide_no_time_that_exists_twice() {
        let gappy: Vec<i64> = (0..1_500).map(|i| 10 * i).collect();
        let back = [14_990];
        let found = ambiguous(&[&gappy, &back]);
        assert!(
            found.iter().any(|span| span.from.0 <= 14_990_000_000_000 && span.to.0 >= 14_990_900_000_000),
            "{found:?}"
        );
    }

    #[test]
    fn many_jumps_hide_no_time_that_exists_twice() {
        let stretches: Vec<Vec<i64>> = (0..2_500).map(|i| vec![1_000_000 - 2 * i]).chain([vec![995_001]]).collect();
        let stretches: Vec<&[i64]> = stretches.iter().map(Vec::as_slice).chain([&[995_002_i64][..]]).collect();
        let found = ambiguous(&stretches);
        assert!(found.iter().any(|span| span.from.0 <= 995_002_000_000_000 && span.to.0 >= 995_002_900_000_000));
    }
}
