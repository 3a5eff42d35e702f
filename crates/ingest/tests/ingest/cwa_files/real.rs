//! A recording of an AX3 at nominally 100 Hz, against the decoding of a reader that shares no code with this one.

use std::collections::BTreeMap;
use std::path::PathBuf;

use aim_batch_ingest::parse::cwa::Hardware;
use jiff::tz::TimeZone;

use super::{measured_rate_hz, read, read_timed};

/// A block as the foreign reader gives it.
#[derive(Default)]
struct Decoded {
    time_s: f64,
    stamp_index: i32,
    samples: Vec<[f32; 3]>,
}

/// A file of the recording's folder in AIM_BATCH_REAL_DATA (default ../shared/real), or none with a word about it.
#[expect(clippy::print_stdout, reason = "a test that is passed over says so")]
fn real_file(name: &str) -> Option<PathBuf> {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..");
    let parent = std::env::var_os("AIM_BATCH_REAL_DATA").map_or_else(|| root.join("../shared/real"), PathBuf::from);
    let file = parent.join("imu_axivity_adxl345").join(name);
    if file.is_file() {
        return Some(file);
    }
    println!("skipped: no {} (AIM_BATCH_REAL_DATA)", file.display());
    None
}

/// By sequence number.
fn decoded() -> Option<BTreeMap<u32, Decoded>> {
    let mut blocks = BTreeMap::<u32, Decoded>::new();
    let mut table = csv::Reader::from_path(real_file("ax3_testfile_decoded.csv")?).unwrap();
    for row in table.records() {
        let row = row.unwrap();
        let block = blocks.entry(row[1].parse().unwrap()).or_default();
        block.time_s = row[2].parse().unwrap();
        block.stamp_index = row[3].parse().unwrap();
        block.samples.push([7, 8, 9].map(|column| row[column].parse().unwrap()));
    }
    Some(blocks)
}

#[test]
fn equals_the_foreign_decoding() {
    let (Some(file), Some(decoded)) = (real_file("ax3_testfile.cwa"), decoded()) else { return };
    let (blocks, facts) = read(&std::fs::read(file).unwrap());
    assert_eq!((blocks.len(), decoded.len()), (145, 145));
    assert_eq!((facts.blocks, facts.bytes_lost, facts.sequence_jumps), (145, 0, 0));
    assert!(facts.bad_blocks.is_empty() && facts.truncated.is_none() && facts.unreadable.is_none());
    let header = facts.header.unwrap();
    assert_eq!((header.hardware, header.device_id, header.session_id), (Hardware::Ax3, 39434, 26));
    assert_eq!((header.nominal_rate_hz, header.range_g), (Some(100.0), 8));
    for (block, (sequence, foreign)) in blocks.iter().zip(&decoded) {
        let time_s = TimeZone::UTC.to_timestamp(block.stamp).unwrap().as_nanosecond() as f64 * 1e-9;
        assert_eq!((block.sequence, block.stamp_index), (*sequence, foreign.stamp_index));
        assert!((time_s - foreign.time_s).abs() < 0.5e-4 + 1e-6, "{time_s} {}", foreign.time_s); // printed to 0.1 ms
        assert_eq!(block.samples.len(), foreign.samples.len());
        for (sample, foreign) in block.samples.iter().flatten().zip(foreign.samples.iter().flatten()) {
            assert!((sample - foreign).abs() < 0.5e-5 + 1e-6, "{sample} {foreign}"); // printed to 0.00001 g
        }
    }
    assert_eq!(blocks.iter().map(|block| block.samples.len()).sum::<usize>(), 17400);
}

#[test]
fn measures_the_true_rate() {
    let Some(file) = real_file("ax3_testfile.cwa") else { return };
    let blocks = read_timed(&std::fs::read(file).unwrap());
    let rate_hz = measured_rate_hz(&blocks);
    assert!((rate_hz - 98.86).abs() < 0.02, "{rate_hz}");
    for (block, times) in &blocks {
        let block_rate_hz = 1e9 / times.step_ns;
        assert!((block_rate_hz - 98.86).abs() < 0.03, "{block_rate_hz} in block {}", block.sequence);
    }
    for pair in blocks.windows(2) {
        let [(block, times), (_, next)] = pair else { unreachable!() };
        let gap_ns = next.first_sample_time_ns - times.time_ns(block.samples.len());
        assert!(next.contiguous && gap_ns.abs() <= 1, "{gap_ns}");
    }
}

/// A hole of three blocks and six altered ones, as real files have them.
#[test]
fn damaged_copy() {
    let Some(file) = real_file("ax3_testfile.cwa") else { return };
    let whole = std::fs::read(file).unwrap();
    let expected = read_timed(&whole);
    let mut damaged = whole;
    let altered = [5, 17, 18, 44, 90, 143];
    for block in altered {
        damaged[1024 + 512 * block + 200] ^= 0x10;
    }
    damaged.drain(1024 + 512 * 60..1024 + 512 * 63);
    let (_, facts) = read(&damaged);
    assert_eq!((facts.blocks, facts.bytes_lost), (136, 6 * 512));
    assert_eq!((facts.bad_blocks.len(), facts.bad_blocks[0].blocks), (1, 6));
    assert_eq!((facts.sequence_jumps, facts.first_jumps[0].expected, facts.first_jumps[0].got), (1, 60, 63));
    for (block, times) in read_timed(&damaged) {
        let (original, original_times) = &expected[block.sequence as usize];
        assert_eq!(block.samples, original.samples);
        for i in [0, block.samples.len() - 1] {
            let error_ms = (times.time_ns(i) - original_times.time_ns(i)) as f64 * 1e-6;
            assert!(error_ms.abs() < 0.5, "{error_ms} ms in block {}", block.sequence);
        }
    }
}
