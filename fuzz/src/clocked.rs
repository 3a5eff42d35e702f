//! From what a parser gives to samples in order of true time, as ingest goes, with everything that must hold on the way.

use std::sync::LazyLock;

use ingest::parse::{RawBlock, Stamps};
use ingest::profile::{Epoch, Step};
use ingest::timeline::{Block, Clock, LISTED, Line, Span, Stepper, StreamFacts, Times};
use jiff::tz::TimeZone;
use model::UtcNs;

/// Blocks that a time line may hold back, as large as the largest one.
const MOST_HELD: usize = 32;
/// Zones with quarters of hours, summer time of half an hour, skipped days, and none of that.
const ZONES: [&str; 6] =
    ["UTC", "America/Chicago", "Australia/Lord_Howe", "Pacific/Apia", "Asia/Kathmandu", "Africa/Casablanca"];

/// The zone of a byte.
pub(crate) fn zone(byte: u8) -> TimeZone {
    static ALL: LazyLock<[TimeZone; ZONES.len()]> =
        LazyLock::new(|| ZONES.map(|name| TimeZone::get(name).unwrap_or(TimeZone::UTC)));
    ALL[usize::from(byte) % ALL.len()].clone()
}

/// How stamps become times.
pub(crate) struct Setting {
    pub epoch: Epoch,
    pub wrap_ns: Option<i128>,
    pub zone: TimeZone,
    pub anchor: Option<UtcNs>,
    pub step: Step,
    pub rate_hz: f64,
    pub gap_s: f64,
}

/// One sensor's way from stamps to the MCAP file.
pub(crate) struct Clocked {
    stepper: Stepper,
    line: Line,
    /// Samples taken by the stepper, and given by it.
    taken: usize,
    timed: Tally,
    out: Tally,
    largest: usize,
    last: Option<UtcNs>,
    went_back: u64,
    span: Option<Span>,
}

/// Samples, and the sum of their first channel's bits.
#[derive(Default, PartialEq, Debug, Clone, Copy)]
struct Tally {
    samples: usize,
    sum: u64,
}

impl Tally {
    fn add(&mut self, block: &Block) {
        self.samples += block.times.len();
        let bits = block.channels.iter().take(1).flatten().map(|value| u64::from(value.to_bits()));
        self.sum = bits.fold(self.sum, u64::wrapping_add);
    }
}

impl Clocked {
    pub fn new(setting: Setting) -> Self {
        let Setting { epoch, wrap_ns, zone, anchor, step, rate_hz, gap_s } = setting;
        let mut stepper = Stepper::new(Clock::new(epoch, wrap_ns, zone), step, rate_hz);
        stepper.set_anchor(anchor);
        Self {
            stepper,
            line: Line::new(rate_hz, gap_s),
            taken: 0,
            timed: Tally::default(),
            out: Tally::default(),
            largest: 0,
            last: None,
            went_back: 0,
            span: None,
        }
    }

    /// The clock's zero is another from now on: a new file.
    pub fn set_anchor(&mut self, anchor: Option<UtcNs>) {
        self.stepper.set_anchor(anchor);
    }

    /// The next block of the parser.
    pub fn push(&mut self, raw: RawBlock) {
        check_raw(&raw);
        let samples = raw.len();
        match self.stepper.push(raw) {
            Ok(block) => {
                let refused = self.stepper.take_refused().map_or(0, |(refused, _)| refused);
                self.taken += samples - usize::try_from(refused).expect("counts fit");
                block.into_iter().for_each(|block| self.pass_on(block));
            }
            Err(error) => assert!(!error.to_string().is_empty()),
        }
    }

    /// The end of the stream: samples that came out.
    pub fn finish(mut self) -> usize {
        let last = self.stepper.finish();
        last.into_iter().for_each(|block| self.pass_on(block));
        assert_eq!(self.taken, self.timed.samples, "the stepper gives times to all samples that it took");
        self.line.end();
        self.drain();
        let Self { line, timed, out, largest, went_back, span, .. } = self;
        let facts = line.finish();
        let twice = usize::try_from(facts.duplicates).expect("counts fit");
        let misplaced = usize::try_from(facts.misplaced_samples).expect("counts fit");
        let lost = timed.samples - out.samples - misplaced;
        assert!((twice..=twice * largest).contains(&lost), "{lost} samples gone for {twice} duplicates");
        assert!(twice > 0 || misplaced > 0 || timed == out, "samples out are those that went in: {timed:?}, {out:?}");
        check_facts(&facts, out.samples, went_back, span);
        out.samples
    }

    fn pass_on(&mut self, block: Block) {
        check_block(&block);
        self.timed.add(&block);
        self.largest = self.largest.max(block.times.len());
        self.line.push(block);
        self.drain();
        let facts = self.line.facts_mut();
        let twice = usize::try_from(facts.duplicates).expect("counts fit") * self.largest;
        let misplaced = usize::try_from(facts.misplaced_samples).expect("counts fit");
        let held = self.timed.samples - self.out.samples - misplaced;
        assert!(held <= twice + MOST_HELD * self.largest, "{held} samples held back");
    }

    fn drain(&mut self) {
        while let Some(block) = self.line.pop() {
            check_block(&block);
            let times: Vec<UtcNs> = block.times.each().collect();
            assert!(!times.is_empty() && times.is_sorted(), "a block's times are in order: {times:?}");
            assert!(times[0].0 >= 0, "no time is before 1970: {times:?}");
            let (from, to) = (times[0], times[times.len() - 1]);
            self.went_back += u64::from(self.last.is_some_and(|last| from < last));
            self.last = Some(to);
            let before = self.span.unwrap_or(Span { from, to });
            self.span = Some(Span { from: before.from.min(from), to: before.to.max(to) });
            self.out.add(&block);
        }
    }
}

fn check_raw(raw: &RawBlock) {
    let samples = raw.len();
    assert!(raw.channels.iter().chain(&raw.extra).all(|column| column.len() == samples), "columns of one length");
    let (all, present) = match &raw.stamps {
        Stamps::Packet { samples, present, .. } | Stamps::Counted { samples, present, .. } => (*samples, present),
        Stamps::Each(stamps) => return assert_eq!(stamps.len(), samples, "a stamp for each sample"),
    };
    match present {
        None => assert_eq!(all as usize, samples, "samples as the packet says"),
        Some(present) => {
            assert!(present.is_sorted_by(|a, b| a < b) && present.last().is_none_or(|last| *last < all));
            assert_eq!(present.len(), samples, "a place for each sample");
        }
    }
}

fn check_block(block: &Block) {
    let samples = block.times.len();
    assert!(block.channels.iter().chain(&block.extra).all(|column| column.len() == samples), "a time for each value");
    if let Times::Even { step_ns, .. } = block.times {
        assert!(step_ns > 0.0, "a step is positive: {step_ns}");
    }
}

fn check_facts(facts: &StreamFacts, samples: usize, went_back: u64, span: Option<Span>) {
    assert_eq!(facts.samples, samples as u64, "all samples are in the account");
    assert!(went_back <= facts.jumps + facts.reordered, "{went_back} steps back are accounted for: {facts:?}");
    assert_eq!(facts.span, span, "the account spans what came out");
    let steps = [facts.shortest_step_s, facts.longest_step_s, facts.measured_rate_hz];
    assert!(steps.into_iter().flatten().all(|step| step >= 0.0), "no step is negative: {facts:?}");
    assert!(facts.longest_step_s.is_none_or(|step| step <= facts.gap_s), "longer steps are gaps: {facts:?}");
    assert!(facts.gaps_total_s >= -1e-6 && facts.gaps >= facts.listed_gaps.len() as u64, "{facts:?}");
    assert!(facts.listed_gaps.iter().all(|gap| gap.seconds() > facts.gap_s), "a gap is long: {facts:?}");
    assert!(facts.stretches.iter().all(|stretch| stretch.from <= stretch.to), "{facts:?}");
    assert!(facts.listed_gaps.len().max(facts.stretches.len()).max(facts.clock_jumps.len()) <= LISTED);
}
