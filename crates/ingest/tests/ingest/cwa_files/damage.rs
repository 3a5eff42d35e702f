//! Damaged blocks are lost and counted, and no others.

use std::io::Read;

use aim_batch_ingest::parse::cwa::{Block, CwaBlocks, CwaFacts, SequenceJump, TruncatedBlock};
use aim_batch_ingest::timeline::{BlockStamp, SampleTimes};
use proptest::prelude::*;

use super::writer::{BlockSpec, Samples, header};
use super::{read, round_trip::spec};

const BLOCKS: usize = 12;

/// Twelve blocks with different samples.
fn whole() -> Vec<u8> {
    let block = |i: u32| {
        let samples = (0..120).map(|k| ([(i * 17 + k) as i16, k as i16 - 60, 3 - i as i16], k % 4)).collect();
        BlockSpec { sequence: i, stamp_s: 40_000.0 + 1.2 * f64::from(i), ..spec(Samples::Packed(samples)) }.bytes()
    };
    let blocks = (0..BLOCKS as u32).flat_map(block);
    header(0x00).into_iter().chain(blocks).collect()
}

/// Where a block begins.
fn offset_of_block(block: usize) -> usize {
    1024 + 512 * block
}

/// The file's blocks are those of the whole one but for `lost`; the facts.
fn all_but(lost: &[u32], file: &[u8]) -> CwaFacts {
    let (blocks, facts) = read(file);
    let expected: Vec<Block> = read(&whole()).0.into_iter().filter(|block| !lost.contains(&block.sequence)).collect();
    assert_eq!(blocks, expected);
    facts
}

fn bad_kinds(facts: &CwaFacts) -> Vec<(&'static str, u64, u64)> {
    facts.bad_blocks.iter().map(|bad| (bad.first.code(), bad.blocks, bad.first_offset)).collect()
}

#[test]
fn flipped_bytes() {
    let mut file = whole();
    file[offset_of_block(3) + 77] ^= 1;
    file[offset_of_block(4)] ^= 1;
    file[offset_of_block(8) + 510] ^= 0x80;
    let facts = all_but(&[3, 4, 8], &file);
    assert_eq!(bad_kinds(&facts), [("bad_checksum", 2, offset_of_block(3) as u64)]);
    assert_eq!((facts.blocks, facts.bytes_lost, facts.sequence_jumps), (9, 3 * 512, 0));
}

#[test]
fn beginning_of_a_block_lost() {
    let mut file = whole();
    file[offset_of_block(4)..offset_of_block(6)].fill(0);
    let facts = all_but(&[4, 5], &file);
    assert_eq!(bad_kinds(&facts), [("not_a_data_block", 1, offset_of_block(4) as u64)]);
    assert_eq!((facts.bytes_lost, facts.sequence_jumps), (1024, 0));
}

#[test]
fn bytes_inserted() {
    for inserted in [1, 3, 100, 511, 512, 70_000] {
        let mut file = whole();
        file.splice(offset_of_block(5)..offset_of_block(5), vec![b'A'; inserted]);
        let facts = all_but(&[], &file);
        assert_eq!(facts.bytes_lost, inserted as u64);
        file = whole();
        file.splice(offset_of_block(5) + 200..offset_of_block(5) + 200, vec![7; inserted]);
        let facts = all_but(&[5], &file);
        assert_eq!((facts.bytes_lost, facts.blocks), (512 + inserted as u64, 11));
    }
}

#[test]
fn bytes_removed() {
    for removed in [1, 3, 200, 305] {
        let mut file = whole();
        file.drain(offset_of_block(5) + 200..offset_of_block(5) + 200 + removed);
        let facts = all_but(&[5], &file);
        assert_eq!((facts.bytes_lost, bad_kinds(&facts).len()), (512 - removed as u64, 1));
    }
}

#[test]
fn truncated() {
    let file = whole();
    for kept in [1, 3, 4, 511] {
        let facts = all_but(&[11], &file[..offset_of_block(11) + kept]);
        assert_eq!(facts.truncated, Some(TruncatedBlock { offset: offset_of_block(11) as u64, got: kept }));
        assert_eq!(facts.bytes_lost, kept as u64);
    }
    assert_eq!(all_but(&[11], &file[..offset_of_block(11)]).truncated, None);
    // The last whole block is damaged as well.
    let mut file = file;
    file[offset_of_block(10) + 99] ^= 1;
    let facts = all_but(&[10, 11], &file[..offset_of_block(11) + 300]);
    assert_eq!(facts.truncated, Some(TruncatedBlock { offset: offset_of_block(11) as u64, got: 300 }));
    assert_eq!(bad_kinds(&facts), [("bad_checksum", 1, offset_of_block(10) as u64)]);
}

#[test]
fn headers_lost() {
    let file = whole();
    let facts = all_but(&[], &file[1024..]);
    assert_eq!((facts.header.is_none(), facts.bytes_lost), (true, 0));
    let facts = all_but(&[], &file[100..]);
    assert_eq!((facts.header.is_none(), facts.bytes_lost, facts.bad_blocks.len()), (true, 924, 0));
    assert_eq!(read(&[]).1, CwaFacts::default());
}

#[test]
fn sequence_jumps() {
    let mut file = whole();
    file.drain(offset_of_block(4)..offset_of_block(7));
    let facts = all_but(&[4, 5, 6], &file);
    let jump = SequenceJump { offset: offset_of_block(4) as u64, expected: 4, got: 7 };
    assert_eq!((facts.sequence_jumps, facts.first_jumps), (1, vec![jump]));
    assert_eq!(facts.bytes_lost, 0);

    let twice: Vec<u8> = (0..150).flat_map(|_| whole().split_off(1024)).collect();
    let facts = read(&twice).1;
    assert_eq!((facts.sequence_jumps, facts.first_jumps.len()), (149, CwaFacts::JUMPS_KEPT));
}

/// A block that is whole but cannot be used is one lost block.
#[test]
fn impossible_date() {
    let mut file = whole();
    let mut block: [u8; 512] = *file[offset_of_block(2)..].first_chunk().unwrap();
    block[14..18].fill(0);
    super::writer::seal(&mut block);
    file[offset_of_block(2)..offset_of_block(3)].copy_from_slice(&block);
    let facts = all_but(&[2], &file);
    assert_eq!(bad_kinds(&facts), [("impossible_date", 1, offset_of_block(2) as u64)]);
    assert_eq!((facts.bytes_lost, facts.sequence_jumps), (512, 0));
}

/// Gives a file in pieces of 7 bytes, and an error at its end.
struct Failing<'a>(&'a [u8]);

impl Read for Failing<'_> {
    fn read(&mut self, out: &mut [u8]) -> std::io::Result<usize> {
        if self.0.is_empty() {
            return Err(std::io::Error::other("the card is gone"));
        }
        let room = out.len().min(7);
        self.0.read(&mut out[..room])
    }
}

#[test]
fn unreadable() {
    let file = whole();
    let mut blocks = CwaBlocks::new(Failing(&file[..offset_of_block(6) + 10]));
    let mut count = 0;
    while blocks.next_block().is_some() {
        count += 1;
    }
    let (facts, _) = blocks.finish();
    let failure = facts.unreadable.unwrap();
    assert_eq!(
        (count, failure.offset, failure.message.as_str()),
        (6, offset_of_block(6) as u64 + 10, "the card is gone")
    );
    assert_eq!(facts.truncated, None);
}

fn check_any(bytes: &[u8]) -> Result<(), TestCaseError> {
    let (blocks, facts) = read(bytes);
    prop_assert!(blocks.len() <= bytes.len() / 512);
    prop_assert!(blocks.iter().all(|block| block.samples.len() <= 120));
    let header = if facts.header.is_some() { 1024 } else { 0 };
    prop_assert_eq!(header + 512 * facts.blocks + facts.bytes_lost, bytes.len() as u64);
    Ok(())
}

proptest! {
    #[test]
    fn arbitrary_bytes(bytes in prop::collection::vec(any::<u8>(), 0..3000)) {
        check_any(&bytes)?;
    }

    #[test]
    fn altered_files(
        changes in prop::collection::vec((0..offset_of_block(BLOCKS), any::<u8>()), 0..20),
        cut in (0..offset_of_block(BLOCKS), 0..2000_usize),
    ) {
        let mut file = whole();
        for (at, byte) in changes {
            file[at] = byte;
        }
        let end = (cut.0 + cut.1).min(file.len());
        file.drain(cut.0..end);
        check_any(&file)?;
    }

    #[test]
    fn arbitrary_blocks(mut bytes in prop::array::uniform32(any::<u8>()), count in 0_u16..200) {
        let mut block = [0x5a; 512];
        bytes[..4].copy_from_slice(&[b'A', b'X', 0xfc, 1]);
        block[..32].copy_from_slice(&bytes);
        block[28..30].copy_from_slice(&count.to_le_bytes());
        super::writer::seal(&mut block);
        if let Ok(block) = Block::parse(&block) {
            prop_assert!(block.samples.len() <= 120);
        }
    }

    /// Whatever the stamps, no block's samples run backwards.
    #[test]
    fn arbitrary_stamps(stamps in prop::collection::vec((0_u32..6, any::<i64>(), -400_i32..400, 0..121_usize), 0..20)) {
        let mut times = SampleTimes::new();
        for (sequence, time_ns, index, samples) in stamps {
            let stamp = BlockStamp { sequence: Some(sequence), time_ns, index, samples, nominal_rate_hz: 100.0 };
            for times in [times.push(stamp), times.clone().finish()].into_iter().flatten() {
                prop_assert!(times.step_ns >= 0.0 && times.time_ns(samples) >= times.first_sample_time_ns);
            }
        }
    }
}
