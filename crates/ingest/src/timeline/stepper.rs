//! From packets with one stamp each to samples with a time each.

use model::UtcNs;

use super::block::{Block, Times, after};
use super::clock::{Clock, ClockError};
use super::stamped::{BlockStamp, BlockTimes, SampleTimes};
use crate::parse::{RawBlock, Stamps};
use crate::profile::Step;

/// A packet reaches no further than to the next one's stamp, unless that is nearer than this part of it: then the clock was
/// set back. A stamp that comes late, or a rate that is declared too low, is far more common.
const SHORTEST_PART: f64 = 0.5;
/// No packet's true step is longer than this many nominal ones.
const LONGEST_STEP: f64 = 1.25;

/// Gives samples their times. It holds back one packet, since the stamp of the next one tells its step.
#[derive(Debug)]
pub struct Stepper {
    clock: Clock,
    step: Step,
    nominal_step_ns: f64,
    waiting: Option<(BlockStamp, RawBlock)>,
    stamped: SampleTimes,
    refused: Option<(u64, ClockError)>,
}

impl Stepper {
    /// For a stream of that nominal rate.
    #[must_use]
    pub fn new(clock: Clock, step: Step, nominal_rate_hz: f64) -> Self {
        let stamped = SampleTimes::new();
        Self { clock, step, nominal_step_ns: 1e9 / nominal_rate_hz, waiting: None, stamped, refused: None }
    }

    /// The time at which the clock of a boot-relative counter was zero, for what is pushed from now on.
    pub fn set_anchor(&mut self, anchor: Option<UtcNs>) {
        self.clock.set_anchor(anchor);
    }

    /// Takes the next packet or batch; gives what has its times now.
    ///
    /// # Errors
    /// [`ClockError`] when its stamps are no times; it is then left out.
    pub fn push(&mut self, raw: RawBlock) -> Result<Option<Block>, ClockError> {
        let step_ns = raw.declared_rate_hz.map_or(self.nominal_step_ns, |rate| 1e9 / rate);
        match &raw.stamps {
            Stamps::Packet { ns, at_sample, samples, .. } => {
                let stamp = BlockStamp {
                    sequence: raw.sequence,
                    time_ns: self.clock.utc(*ns)?.0,
                    index: *at_sample,
                    samples: *samples as usize,
                    nominal_rate_hz: 1e9 / step_ns,
                };
                let reach = stamp.samples as f64 + f64::from(stamp.index).abs();
                is_far_from_ends(UtcNs(stamp.time_ns), reach, step_ns)?;
                Ok(self.packet(stamp, raw))
            }
            Stamps::Each(stamps) => {
                let times: Vec<_> = stamps.iter().map(|ns| self.clock.utc(*ns)).collect();
                Ok(Some(self.rows(raw, times)))
            }
            Stamps::Counted { first, samples, present } => {
                let anchor = self.clock.anchor().ok_or(ClockError::NoAnchor)?;
                is_far_from_ends(anchor, *first as f64 + f64::from(*samples), step_ns)?;
                let start = after(anchor, step_ns, usize::try_from(*first).map_err(|_| ClockError::Range)?);
                let times = times_of(start, step_ns, *samples as usize, present.as_deref());
                Ok(Some(block(raw, times)))
            }
        }
    }

    /// The packet that was held back: at the end of the stream.
    pub fn finish(&mut self) -> Option<Block> {
        let (stamp, raw) = self.waiting.take()?;
        let times = match self.step {
            Step::Nominal => Some(Self::nominal(&stamp, None)),
            Step::Stamps => self.stamped.finish(),
        };
        times.map(|times| timed(&times, &stamp, raw))
    }

    /// Rows without those whose stamps are no times.
    fn rows(&mut self, mut raw: RawBlock, times: Vec<Result<UtcNs, ClockError>>) -> Block {
        if let Some(Err(error)) = times.iter().find(|time| time.is_err()) {
            let refused = times.iter().filter(|time| time.is_err()).count() as u64;
            let (count, _) = self.refused.get_or_insert((0, error.clone()));
            *count += refused;
            for column in raw.channels.iter_mut().chain(&mut raw.extra) {
                let mut is_time = times.iter().map(Result::is_ok);
                column.retain(|_| is_time.next().unwrap_or(false));
            }
        }
        block(raw, Times::Each(times.into_iter().filter_map(Result::ok).collect()))
    }

    /// Rows that were left out since the last call because their stamps are no times, and why the first one was.
    pub fn take_refused(&mut self) -> Option<(u64, ClockError)> {
        self.refused.take()
    }

    fn packet(&mut self, next: BlockStamp, raw: RawBlock) -> Option<Block> {
        let stamped = (self.step == Step::Stamps).then(|| self.stamped.push(next)).flatten();
        let (stamp, before) = self.waiting.replace((next, raw))?;
        let times = stamped.unwrap_or_else(|| Self::nominal(&stamp, Some(&next)));
        Some(timed(&times, &stamp, before))
    }

    /// The times of a packet by the nominal rate; where it would reach into the next packet, by that one's stamp.
    #[expect(clippy::cast_precision_loss, reason = "a step needs no more than 53 bits")]
    fn nominal(stamp: &BlockStamp, next: Option<&BlockStamp>) -> BlockTimes {
        let nominal_ns = 1e9 / stamp.nominal_rate_hz;
        let told_ns = next.map(|next| {
            let samples = stamp.samples as f64 - f64::from(stamp.index) + f64::from(next.index);
            (next.time_ns.saturating_sub(stamp.time_ns)) as f64 / samples
        });
        let is_shorter = |told: &f64| *told < nominal_ns && *told >= SHORTEST_PART * nominal_ns;
        let step_ns = told_ns.filter(is_shorter).unwrap_or(nominal_ns);
        let first = after(UtcNs(stamp.time_ns), -step_ns, usize::try_from(stamp.index).unwrap_or(0));
        BlockTimes { first_sample_time_ns: first.0, step_ns, contiguous: false }
    }
}

/// Whether so many steps to either side of a time, of a rate that is somewhat off the nominal one, are times as well.
#[expect(clippy::cast_precision_loss, reason = "the ends are 292 years apart")]
fn is_far_from_ends(time: UtcNs, steps: f64, step_ns: f64) -> Result<(), ClockError> {
    let reach_ns = LONGEST_STEP * steps * step_ns;
    let time_ns = time.0 as f64;
    let fits = time_ns - reach_ns >= 0.0 && time_ns + reach_ns < i64::MAX as f64;
    if fits { Ok(()) } else { Err(ClockError::Range) }
}

fn timed(times: &BlockTimes, stamp: &BlockStamp, raw: RawBlock) -> Block {
    let present = match &raw.stamps {
        Stamps::Packet { present, .. } => present.clone(),
        _ => None,
    };
    let times = times_of(UtcNs(times.first_sample_time_ns), times.step_ns, stamp.samples, present.as_deref());
    block(raw, times)
}

fn times_of(first: UtcNs, step_ns: f64, samples: usize, present: Option<&[u32]>) -> Times {
    match present {
        None => Times::Even { first, step_ns, samples },
        Some(present) => Times::Each(present.iter().map(|i| after(first, step_ns, *i as usize)).collect()),
    }
}

fn block(raw: RawBlock, times: Times) -> Block {
    Block { times, sequence: raw.sequence, channels: raw.channels, extra: raw.extra }
}
