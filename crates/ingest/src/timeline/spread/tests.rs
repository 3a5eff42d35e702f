//! Rows that share stamps, against true times and by hand.

use super::*;

const MS: i64 = 1_000_000;

fn block(stamps: &[i64]) -> RawBlock {
    let values = (0..stamps.len()).map(|i| i as f32).collect();
    let stamps = Stamps::Each(stamps.iter().map(|ms| ms * MS).collect());
    RawBlock {
        stamps,
        sequence: None,
        channels: vec![values],
        extra: vec![],
        missing: 0,
        impossible: None,
        declared_rate_hz: None,
    }
}

/// Times in ms of all rows, and how many were left out; stamps in ms, given in blocks of `size` rows.
fn spread(stamps: &[i64], rate_hz: f64, size: usize) -> (Vec<f64>, u64) {
    let mut counts = StampCounts::default();
    counts.add(&stamps.iter().map(|ms| ms * MS).collect::<Vec<_>>());
    let mut spreader = Spreader::new(counts.shared(rate_hz).unwrap());
    let mut blocks: Vec<RawBlock> = stamps.chunks(size).map(|rows| spreader.push(block(rows))).collect();
    blocks.extend(spreader.finish());
    let mut times = Vec::new();
    for block in blocks {
        let Stamps::Each(ns) = &block.stamps else { panic!() };
        assert_eq!(ns.len(), block.channels[0].len());
        times.extend(ns.iter().map(|ns| *ns as f64 / MS as f64));
    }
    (times, spreader.left_out)
}

/// True times in ms of a sensor of that rate, and its stamps, cut off to multiples of `resolution_ms`.
fn cut_off(rate_hz: f64, from_ms: f64, rows: usize, resolution_ms: i64) -> (Vec<f64>, Vec<i64>) {
    let times: Vec<f64> = (0..rows).map(|i| from_ms + i as f64 * 1000.0 / rate_hz).collect();
    let stamps = times.iter().map(|ms| (*ms / resolution_ms as f64).floor() as i64 * resolution_ms).collect();
    (times, stamps)
}

#[test]
fn seconds_half_seconds_and_minutes_are_right_to_one_row() {
    for (rate_hz, resolution_ms) in
        [(128.0, 1000), (100.0, 500), (12.8, 1000), (50.0, 60_000), (99.3, 1000), (10.0, 500)]
    {
        let (expected, stamps) = cut_off(rate_hz, 1_700_000_123_456.7, 20_000, resolution_ms);
        for size in [7, 1024, 20_000] {
            let (times, left_out) = spread(&stamps, rate_hz, size);
            assert_eq!((times.len(), left_out), (expected.len(), 0), "{rate_hz} Hz, {resolution_ms} ms");
            let worst_ms = times.iter().zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(worst_ms <= 1100.0 / rate_hz, "{rate_hz} Hz, {resolution_ms} ms: {worst_ms} ms");
            assert!(times.is_sorted());
        }
    }
}

#[test]
fn four_rows_per_second_by_hand() {
    // Recording begins at 0.5 s and ends at 3.5 s, 4 Hz.
    let stamps = [0, 0, 1000, 1000, 1000, 1000, 2000, 2000, 2000, 2000, 3000, 3000];
    let (times, left_out) = spread(&stamps, 4.0, 5);
    let expected = [625.0, 875.0, 1125.0, 1375.0, 1625.0, 1875.0, 2125.0, 2375.0, 2625.0, 2875.0, 3125.0, 3375.0];
    assert_eq!((times, left_out), (expected.to_vec(), 0));
}

#[test]
fn a_hole_within_a_second_costs_that_second_and_a_missing_second_none() {
    let second = |s: i64, rows: usize| vec![1000 * s; rows];
    let stamps = [second(1, 100), second(2, 100), second(3, 60), second(4, 100), second(9, 100), second(10, 100)];
    let (times, left_out) = spread(&stamps.concat(), 100.0, 64);
    assert_eq!(left_out, 60);
    assert_eq!(times.len(), 500);
    assert_eq!((times[0], times[200], times[300], times[499]), (1005.0, 4005.0, 9005.0, 10_995.0));
}

#[test]
fn counts_that_show_no_rate_give_no_times() {
    let rows = [20, 90, 45, 70, 10, 110, 33, 61];
    let stamps: Vec<i64> = rows.iter().enumerate().flat_map(|(s, rows)| vec![1000 * s as i64; *rows]).collect();
    let (times, left_out) = spread(&stamps, 100.0, 1024);
    assert_eq!((times.len(), left_out), (0, 439));
    let stuck = vec![5000; 400_000];
    let mut counted: Vec<i64> = (0..10).flat_map(|s| vec![1000 * s; 100]).collect();
    counted.splice(600..600, stuck);
    assert_eq!(spread(&counted, 100.0, 1024).1, 400_100, "a clock that stood still");
}

#[test]
fn batches_of_a_radio_link_fill_their_time() {
    let stamps = [0, 0, 0, 23, 23, 23, 47, 47, 70, 70, 70, 70];
    let (times, left_out) = spread(&stamps, 128.0, 1024);
    assert_eq!((left_out, times.is_sorted()), (0, true));
    assert!((times[7] - 64.25).abs() < 1e-6, "{times:?}");
}

#[test]
fn rows_with_times_of_their_own_are_left_alone() {
    let mut counts = StampCounts::default();
    counts.add(&[1, 2, 3, 3, 4, 5, 6, 7, 8]);
    assert_eq!(counts.shared(100.0), None);
}
