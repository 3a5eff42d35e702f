//! Sample times follow the stamps, not the nominal rate.

use super::writer::{BlockSpec, Samples, header};
use super::{measured_rate_hz, read_timed, round_trip::spec};

/// Blocks with those numbers of a logger that takes `rate_hz` samples per second, the first one at 40000 s.
fn recording(hardware: u8, rate_hz: f64, per_block: usize, sequences: impl IntoIterator<Item = u32>) -> Vec<u8> {
    let mut file = header(hardware);
    for sequence in sequences {
        let index = per_block + 5 * (sequence as usize % 5);
        let sample = sequence as usize * per_block + index;
        let samples = match per_block {
            40 => Samples::GyroAccel(vec![[1, 2, 3, 4, 5, 6]; 40]),
            _ => Samples::Packed(vec![([1, 2, 3], 0); per_block]),
        };
        let stamp_s = 40_000.0 + sample as f64 / rate_hz;
        file.extend(BlockSpec { sequence, stamp_s, index: index as i16, ..spec(samples) }.bytes());
    }
    file
}

/// ms from the true time of the sample; blocks are numbered from 40000 s on.
fn error_ms(time_ns: i64, sample: usize, rate_hz: f64) -> f64 {
    let midnight_ns = jiff::civil::date(2024, 5, 17).to_zoned(jiff::tz::TimeZone::UTC).unwrap().timestamp();
    let seconds = (i128::from(time_ns) - midnight_ns.as_nanosecond()) as f64 * 1e-9;
    (seconds - 40_000.0 - sample as f64 / rate_hz) * 1e3
}

#[test]
fn ax6_at_its_true_rate() {
    let blocks = read_timed(&recording(0x64, 99.04, 40, 0..200));
    assert_eq!(blocks.len(), 200);
    assert!((measured_rate_hz(&blocks) - 99.04).abs() < 0.01);
    for (block, times) in &blocks {
        assert_eq!(times.contiguous, block.sequence > 0);
        for i in 0..block.samples.len() {
            let error_ms = error_ms(times.time_ns(i), block.sequence as usize * 40 + i, 99.04);
            assert!(error_ms.abs() < 0.1, "{error_ms} ms at sample {i} of block {}", block.sequence);
        }
    }
}

/// After a hole of three blocks, and in a block alone, times start from the block's own stamp.
#[test]
fn holes() {
    let blocks = read_timed(&recording(0x00, 98.86, 120, [0, 1, 2, 6, 7, 11]));
    let contiguous: Vec<bool> = blocks.iter().map(|(_, times)| times.contiguous).collect();
    assert_eq!(contiguous, [false, true, true, false, true, false]);
    for (block, times) in &blocks {
        for i in [0, 119] {
            let error_ms = error_ms(times.time_ns(i), block.sequence as usize * 120 + i, 98.86);
            assert!(error_ms.abs() < 0.1, "{error_ms} ms in block {}", block.sequence);
        }
    }
    let end_ns = blocks[2].1.time_ns(120);
    let hole_s = (blocks[3].1.first_sample_time_ns - end_ns) as f64 * 1e-9;
    assert!((hole_s - 3.64).abs() < 0.01, "{hole_s}");
}

/// A single block has nothing but the nominal rate.
#[test]
fn one_block() {
    let blocks = read_timed(&recording(0x00, 98.86, 120, [3]));
    assert!((blocks[0].1.step_ns - 1e7).abs() < 1.0);
}

/// A clock that was set while recording: the rate does not become absurd, and a gap is told.
#[test]
fn clock_set_while_recording() {
    let mut file = recording(0x00, 98.86, 120, [0, 1]);
    for sequence in [2_u32, 3] {
        let index = 120 + 5 * (sequence as usize % 5);
        let stamp_s = 30_000.0 + (sequence as usize * 120 + index) as f64 / 98.86;
        let samples = Samples::Packed(vec![([1, 2, 3], 0); 120]);
        file.extend(BlockSpec { sequence, stamp_s, index: index as i16, ..spec(samples) }.bytes());
    }
    let blocks = read_timed(&file);
    let contiguous: Vec<bool> = blocks.iter().map(|(_, times)| times.contiguous).collect();
    assert_eq!(contiguous, [false, true, false, true]);
    assert!(blocks.iter().all(|(_, times)| (1e9 / times.step_ns - 98.86).abs() < 0.05));
}
