//! Stamps of any kind and order on their way to true time.
//!
//! Input: 5 bytes of settings, then blocks of a few bytes each (both in the order in which they are taken below).

use ingest::parse::{RawBlock, Stamps};
use ingest::profile::{Epoch, Step};
use model::UtcNs;

use crate::clocked::{Clocked, Setting, zone};
use crate::cursor::Cursor;

/// 2025-06-01T12:00:00Z.
const NOON_NS: i64 = 1_748_779_200_000_000_000;

/// Time lines: samples out are samples in without duplicates, in order, with a true account and bounded memory.
pub fn timeline(input: &[u8]) -> usize {
    let mut cursor = Cursor::new(input);
    let flags = cursor.u8();
    let epoch = cursor.pick(&[Epoch::Unix, Epoch::Boot, Epoch::Local, Epoch::LocalAtStart]);
    let wrap_ns = Some(cursor.u8()).filter(|bits| (10..=63).contains(bits)).map(|bits| (1 << bits) * 1_000_000);
    let zone = zone(cursor.u8());
    let rate_hz = cursor.pick(&[100.0, 128.0, 1.0, 1e-3, 1e4]);
    let mut clocked = Clocked::new(Setting {
        epoch,
        wrap_ns,
        zone,
        anchor: (flags & 1 == 0).then_some(UtcNs(NOON_NS)),
        step: if flags & 2 == 0 { Step::Nominal } else { Step::Stamps },
        rate_hz,
        gap_s: 0.5_f64.max(3.0 / rate_hz),
    });
    let mut maker = Maker { stamp_ns: NOON_NS, sequence: 0, next_value: 0, last: None };
    while !cursor.is_empty() {
        if let Some(block) = maker.next(&mut cursor) {
            clocked.push(block);
        } else {
            clocked.set_anchor(Some(UtcNs(maker.stamp_ns.max(0))));
        }
    }
    clocked.finish()
}

/// Makes blocks; a sample's value is its number, so that a lost one shows.
struct Maker {
    stamp_ns: i64,
    sequence: u32,
    next_value: u32,
    last: Option<RawBlock>,
}

impl Maker {
    /// The next block; none for a new file.
    fn next(&mut self, cursor: &mut Cursor<'_>) -> Option<RawBlock> {
        let form = cursor.u8();
        let steps = i64::from(cursor.i16());
        let unit_ns = [1_000_000, 10_000_000, 1_000_000_000, 60_000_000_000][usize::from(form >> 3) % 4];
        self.stamp_ns = if form & 0x80 != 0 { cursor.i64() } else { self.stamp_ns.saturating_add(steps * unit_ns) };
        self.sequence = self.sequence.wrapping_add(if form & 0x40 == 0 { 1 } else { u32::from(cursor.u8()) });
        let samples = u32::from(cursor.u8());
        let sequence = (form & 0x20 == 0).then_some(self.sequence);
        let (stamps, len) = match form & 7 {
            0 | 1 => {
                let present = (form & 1 == 1).then(|| present(samples, cursor.u8()));
                let len = present.as_ref().map_or(samples as usize, Vec::len);
                let at_sample = i32::from(cursor.i16());
                (Stamps::Packet { ns: self.stamp_ns, at_sample, samples, present }, len)
            }
            2 | 3 => {
                let step = |cursor: &mut Cursor<'_>| i64::from(cursor.u8().cast_signed()) * unit_ns;
                let stamps: Vec<i64> = (0..samples % 16).map(|_| self.stamp_ns.saturating_add(step(cursor))).collect();
                let len = stamps.len();
                (Stamps::Each(stamps), len)
            }
            4 | 5 => {
                let present = (form & 1 == 1).then(|| present(samples, cursor.u8()));
                let len = present.as_ref().map_or(samples as usize, Vec::len);
                (Stamps::Counted { first: steps.unsigned_abs(), samples, present }, len)
            }
            6 => return self.last.clone().or_else(|| Some(self.block(Stamps::Each(Vec::new()), sequence, 0))),
            _ => return None,
        };
        let block = self.block(stamps, sequence, len);
        self.last = Some(block.clone());
        Some(block)
    }

    fn block(&mut self, stamps: Stamps, sequence: Option<u32>, len: usize) -> RawBlock {
        let from = self.next_value;
        self.next_value += u32::try_from(len).expect("a block is small");
        let values = (from..self.next_value).map(|value| f32::from_bits(0x3f80_0000 + value)).collect();
        RawBlock {
            stamps,
            sequence,
            channels: vec![values],
            extra: Vec::new(),
            missing: 0,
            impossible: None,
            declared_rate_hz: None,
        }
    }
}

/// Which of the samples are there: all but every `hole`th.
fn present(samples: u32, hole: u8) -> Vec<u32> {
    (0..samples).filter(|i| !(i + 1).is_multiple_of(u32::from(hole).max(1))).collect()
}
