//! From packets with one stamp each to samples with a time each.

use model::UtcNs;

use super::block::{Block, Times, after};
use super::clock::{Clock, ClockError};
use crate::parse::{RawBlock, Stamps};
use crate::profile::Step;

/// Two packets' stamps tell the step between samples when it is within this of the nominal one; otherwise there is a gap.
const RATE_TOLERANCE: f64 = 0.05;

/// Gives samples their times. It holds back one packet, since the stamp of the next one tells its step.
#[derive(Debug)]
pub struct Stepper {
    clock: Clock,
    step: Step,
    nominal_step_ns: f64,
    waiting: Option<Waiting>,
    /// Step of the last packet that the next one's stamp told.
    told_step_ns: Option<f64>,
}

/// A packet whose step is not yet known.
#[derive(Debug)]
struct Waiting {
    stamp: UtcNs,
    at_sample: f64,
    samples: u32,
    present: Option<Vec<u32>>,
    nominal_step_ns: f64,
    block: RawBlock,
}

impl Stepper {
    /// For a stream of that nominal rate.
    pub fn new(clock: Clock, step: Step, nominal_rate_hz: f64) -> Self {
        Self { clock, step, nominal_step_ns: 1e9 / nominal_rate_hz, waiting: None, told_step_ns: None }
    }

    /// Where the clock of a boot-relative counter was zero, for what is pushed from now on.
    pub fn set_anchor(&mut self, anchor: Option<UtcNs>) {
        self.clock.anchor = anchor;
    }

    /// Takes the next packet or batch; gives what has its times now.
    ///
    /// # Errors
    /// [`ClockError`] when its stamps are no times; it is then left out.
    pub fn push(&mut self, raw: RawBlock) -> Result<Option<Block>, ClockError> {
        match &raw.stamps {
            Stamps::Packet { ns, at_sample, samples, present } => {
                let nominal_step_ns = raw.declared_rate_hz.map_or(self.nominal_step_ns, |rate| 1e9 / rate);
                let next = Waiting {
                    stamp: self.clock.utc(*ns)?,
                    at_sample: *at_sample,
                    samples: *samples,
                    present: present.clone(),
                    nominal_step_ns,
                    block: raw,
                };
                let before = self.waiting.take();
                let done = before.map(|before| self.timed(before, Some(&next)));
                self.waiting = Some(next);
                Ok(done)
            }
            Stamps::Each(stamps) => {
                let times = stamps.iter().map(|ns| self.clock.utc(*ns)).collect::<Result<Vec<_>, _>>()?;
                Ok(Some(block(raw, Times::Each(times))))
            }
            Stamps::Counted { first, samples, present } => {
                let step_ns = raw.declared_rate_hz.map_or(self.nominal_step_ns, |rate| 1e9 / rate);
                let anchor = self.clock.anchor.ok_or(ClockError::NoAnchor)?;
                let start = after(anchor, step_ns, usize::try_from(*first).map_err(|_| ClockError::Range)?);
                let times = times_of(start, step_ns, *samples, present.as_deref());
                Ok(Some(block(raw, times)))
            }
        }
    }

    /// The packet that was held back: at the end of the stream.
    pub fn finish(&mut self) -> Option<Block> {
        let last = self.waiting.take()?;
        Some(self.timed(last, None))
    }

    fn timed(&mut self, packet: Waiting, next: Option<&Waiting>) -> Block {
        let told = next.and_then(|next| told_step_ns(&packet, next));
        let is_close = |step: &f64| (step / packet.nominal_step_ns - 1.0).abs() <= RATE_TOLERANCE;
        let step_ns = match (self.step, told.filter(is_close)) {
            (Step::Stamps, Some(told)) => {
                self.told_step_ns = Some(told);
                told
            }
            (Step::Stamps, None) => self.told_step_ns.unwrap_or(packet.nominal_step_ns),
            (Step::Nominal, Some(told)) => told.min(packet.nominal_step_ns),
            (Step::Nominal, None) => packet.nominal_step_ns,
        };
        #[expect(clippy::cast_possible_truncation, reason = "a packet is far shorter than 292 years")]
        let first = UtcNs(packet.stamp.0.saturating_sub((packet.at_sample * step_ns).round() as i64));
        let times = times_of(first, step_ns, packet.samples, packet.present.as_deref());
        block(packet.block, times)
    }
}

/// The step between samples that two stamps tell, if the packets follow each other.
fn told_step_ns(packet: &Waiting, next: &Waiting) -> Option<f64> {
    let follows = match (packet.block.sequence, next.block.sequence) {
        (Some(this), Some(next)) => this.wrapping_add(1) == next,
        _ => true,
    };
    let samples = f64::from(packet.samples) - packet.at_sample + next.at_sample;
    #[expect(clippy::cast_precision_loss, reason = "a step needs no more than 53 bits")]
    let ns = (next.stamp.0 - packet.stamp.0) as f64;
    (follows && samples > 0.0 && ns > 0.0).then_some(ns / samples)
}

fn times_of(first: UtcNs, step_ns: f64, samples: u32, present: Option<&[u32]>) -> Times {
    match present {
        None => Times::Even { first, step_ns, samples: samples as usize },
        Some(present) => Times::Each(present.iter().map(|i| after(first, step_ns, *i as usize)).collect()),
    }
}

fn block(raw: RawBlock, times: Times) -> Block {
    Block { times, sequence: raw.sequence, channels: raw.channels, extra: raw.extra }
}
