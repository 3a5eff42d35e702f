//! Axivity CWA files. Input: the file.

use ingest::parse::cwa::{BLOCK_BYTES, CwaBlocks, HEADER_BYTES};
use ingest::parse::{Converter, CwaLayout, CwaSamples};
use ingest::profile::{Axis, Epoch, Step};
use jiff::tz::TimeZone;

use crate::clocked::{Clocked, Setting, zone};
use crate::cursor::Pieces;
use crate::mend;

/// CWA: bytes are used or told as lost. Read as it is, and with the blocks' checksums made right.
pub fn cwa(input: &[u8]) -> usize {
    read(input, TimeZone::UTC, 0);
    let fineness = input.last().copied().unwrap_or(0);
    read(&mend::cwa(input), zone(fineness), fineness)
}

fn read(file: &[u8], zone: TimeZone, fineness: u8) -> usize {
    let told = check_account(file);
    let axes = [Axis::PlusX, Axis::MinusZ, Axis::PlusY];
    let converter = Converter::Acceleration { g_per_count: 1.0, zero_g_counts: [0.0; 3], axes, full_scale_g: None };
    let extra = ["gyro_x", "gyro_z"].map(str::to_owned).to_vec();
    let mut clocked = Clocked::new(Setting {
        epoch: Epoch::LocalAtStart,
        wrap_ns: None,
        zone,
        anchor: None,
        step: Step::Stamps,
        rate_hz: 100.0,
        gap_s: 0.5,
    });
    let mut samples = CwaSamples::new(Pieces::new(file, fineness), CwaLayout { converter, extra });
    while let Some(block) = samples.next_block() {
        clocked.push(block);
    }
    let lost: u64 = samples.finish().0.iter().map(ingest::parse::Fault::lost_bytes).sum();
    assert!(lost <= told, "{lost} bytes lost, of {told}");
    clocked.finish()
}

/// Every byte is of the header, of a block that was used, or told as lost: how many are lost.
fn check_account(file: &[u8]) -> u64 {
    let mut reader = CwaBlocks::new(file);
    let mut used = 0;
    while let Some(block) = reader.next_block() {
        used += 1;
        let room = BLOCK_BYTES / 4;
        assert!(block.samples.len() <= room && block.nominal_rate_hz > 0.0);
        assert!(block.gyro_deg_per_s.is_none_or(|gyro| gyro.len() == block.samples.len()));
    }
    let facts = reader.finish().0;
    assert_eq!(facts.blocks, used);
    let header = if facts.header.is_some() { HEADER_BYTES as u64 } else { 0 };
    assert_eq!(header + used * BLOCK_BYTES as u64 + facts.bytes_lost, file.len() as u64, "{facts:?}");
    assert!(facts.bad_blocks.iter().all(|bad| bad.first_offset < file.len() as u64), "{facts:?}");
    facts.bytes_lost
}
