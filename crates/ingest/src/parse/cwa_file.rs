//! A CWA file as a stream of packets.

use std::io::Read;

use jiff::tz::TimeZone;

use super::cwa::{BLOCK_BYTES, Block, CwaBlocks, CwaFacts, HEADER_BYTES};
use super::raw::{RawBlock, Stamps};
use super::{Converter, Fault};

/// Names under which the gyroscope's channels can be carried along.
const GYROSCOPE: [&str; 3] = ["gyro_x", "gyro_y", "gyro_z"];

/// The samples to take from a CWA file.
#[derive(Debug, Clone)]
pub struct CwaLayout {
    /// To the device frame.
    pub converter: Converter,
    /// Channels to carry along: `gyro_x`, `gyro_y`, `gyro_z`, in degrees per second.
    pub extra: Vec<String>,
}

/// Streams the blocks of a CWA file.
pub struct CwaSamples<R> {
    blocks: CwaBlocks<R>,
    layout: CwaLayout,
}

impl<R: Read> CwaSamples<R> {
    /// The blocks in `reader`.
    pub fn new(reader: R, layout: CwaLayout) -> Self {
        Self { blocks: CwaBlocks::new(reader), layout }
    }

    /// The next block that can be used. None at the end of the file.
    pub fn next_block(&mut self) -> Option<RawBlock> {
        let block = self.blocks.next_block()?;
        Some(self.raw(&block))
    }

    /// Returns the faults of the file, and the reader.
    pub fn finish(self) -> (Vec<Fault>, R) {
        let (facts, reader) = self.blocks.finish();
        (faults(&facts), reader)
    }

    fn raw(&self, block: &Block) -> RawBlock {
        let axis = |i: usize| block.samples.iter().map(|sample| f64::from(sample[i])).collect();
        let extra = self.layout.extra.iter().map(|name| gyroscope(block, name)).collect();
        // The logger's clock counts as if it were UTC; what it means is the profile's to say.
        let ns = TimeZone::UTC.to_timestamp(block.stamp).ok().and_then(|t| i64::try_from(t.as_nanosecond()).ok());
        RawBlock {
            stamps: Stamps::Packet {
                ns: ns.unwrap_or(-1),
                at_sample: block.stamp_index,
                samples: u32::try_from(block.samples.len()).unwrap_or(u32::MAX),
                present: None,
            },
            sequence: Some(block.sequence),
            channels: self.layout.converter.convert(&[axis(0), axis(1), axis(2)]),
            extra,
            missing: 0,
            impossible: None, // the file itself says what its counts mean
            declared_rate_hz: Some(block.nominal_rate_hz),
        }
    }
}

/// A channel of the gyroscope; NaN where the logger has none.
fn gyroscope(block: &Block, name: &str) -> Vec<f32> {
    let axis = GYROSCOPE.iter().position(|known| *known == name);
    match (&block.gyro_deg_per_s, axis) {
        (Some(samples), Some(axis)) => samples.iter().map(|sample| sample[axis]).collect(),
        _ => vec![f32::NAN; block.samples.len()],
    }
}

fn faults(facts: &CwaFacts) -> Vec<Fault> {
    let mut faults = Vec::new();
    // The block that the file ends in is told by itself.
    let cut_bytes = facts.truncated.map_or(0, |cut| cut.got as u64);
    if let Some(first) = facts.bad_blocks.iter().min_by_key(|bad| bad.first_offset) {
        faults.push(Fault::BadBlocks {
            blocks: facts.bad_blocks.iter().map(|bad| bad.blocks).sum(),
            bytes: facts.bytes_lost.saturating_sub(cut_bytes),
            first_offset: first.first_offset,
            first: first.first.to_string(),
        });
    }
    let told = !facts.bad_blocks.is_empty() || facts.truncated.is_some();
    if facts.bytes_lost > 0 && !told {
        let first_offset = (HEADER_BYTES as u64) + facts.blocks * BLOCK_BYTES as u64;
        faults.push(Fault::LostAlignment { bytes: facts.bytes_lost, places: 1, first_offset });
    }
    if let Some(jump) = facts.first_jumps.first() {
        faults.push(Fault::SequenceJumps {
            jumps: facts.sequence_jumps,
            first_offset: jump.offset,
            expected: jump.expected,
            got: jump.got,
        });
    }
    if let Some(cut) = facts.truncated {
        let expected = BLOCK_BYTES;
        faults.push(Fault::TruncatedPacket { offset: cut.offset, expected, got: cut.got, samples: 0 });
    }
    if let Some(failure) = &facts.unreadable {
        faults.push(Fault::Unreadable { offset: failure.offset, message: failure.message.clone() });
    }
    if facts.header.is_none() && facts.blocks > 0 {
        faults.push(Fault::NoHeader);
    }
    faults
}
