#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
use super::*;

/// One record for each reading, 50 ms apart.
fn of_readings(readings: &[f64]) -> Range {
    of_records(readings, 0.05)
}

fn of_records(records: &[f64], step_s: f64) -> Range {
    let times = (0..).map(|i| UtcNs(0).plus_seconds(f64::from(i) * step_s));
    let samples: Vec<_> = times.zip(records.iter().copied()).collect();
    range_from(&samples, &ReadingSettings::default())
}

/// 128 records in one second of a sensor that measures every `period_s`.
fn logged(period_s: f64, reading: impl Fn(u32) -> f64) -> Range {
    let records: Vec<f64> = (0..128).map(|i| reading((f64::from(i) / 128.0 / period_s) as u32)).collect();
    of_records(&records, 1.0 / 128.0)
}

/// Noise of a few mm whose neighbours differ.
fn noise(i: u32) -> f64 {
    f64::from(i * 7919 % 11) - 5.0
}

#[test]
fn codes_and_nonsense_are_refused() {
    let range = of_readings(&[8190.0, 580.0, 12.0, 581.0, 8191.0, 579.0, 2500.0, -1.0, f64::NAN]);
    assert_eq!(range.median_mm, Some(580.0));
    assert_eq!((range.valid_samples, range.distinct), (3, 3));
}

#[test]
fn a_hand_in_a_third_of_the_window_does_not_move_it() {
    let range = of_readings(&[580.0, 581.0, 300.0, 579.0, 310.0, 580.0, 582.0]);
    assert!((range.median_mm.unwrap() - 580.0).abs() < 1.0);
    assert!(range.spread_mm.unwrap() < 2.0);
}

#[test]
fn a_code_is_refused_even_where_the_limits_would_allow_it() {
    let samples: Vec<_> = (0..10).map(|i| (UtcNs(i * 50_000_000), 8190.0)).collect();
    let spec = ReadingSettings { range_max_mm: 9000.0, ..ReadingSettings::default() };
    assert_eq!(range_from(&samples, &spec).median_mm, None);
}

#[test]
fn a_stray_echo_among_codes_is_no_range() {
    let mut records = vec![8190.0; 120];
    records.extend([123.0; 8]);
    let range = of_records(&records, 1.0 / 128.0);
    assert_eq!((range.median_mm, range.valid_samples, range.distinct), (None, 8, 3));
}

#[test]
fn too_few_readings_give_none() {
    assert_eq!(of_readings(&[580.0, 581.0]).median_mm, None);
    assert_eq!(of_readings(&[580.0, 581.0]).valid_samples, 2);
    // Nine records, but of two readings.
    let held = [580.0, 580.0, 580.0, 581.0, 581.0];
    assert_eq!(of_records(&held, 1.0 / 128.0).median_mm, None);
    assert_eq!(range_from(&[], &ReadingSettings::default()).median_mm, None);
}

#[test]
fn held_values_count_once() {
    let range = logged(0.02, |i| 580.0 + noise(i));
    assert_eq!((range.valid_samples, range.distinct), (128, 50));
    assert!(!range.held && !range.step);
    // A slower sensor than the one declared shows it: 30.3 readings in the window.
    let range = logged(0.033, |i| 580.0 + noise(i));
    assert!((30..=32).contains(&range.distinct), "{}", range.distinct);
}

#[test]
fn equal_readings_of_a_quiet_sensor_are_not_one() {
    // Most readings are 580, as of a fixed target: readings, not runs, make the median and the count.
    let quiet = |i: u32| if i.is_multiple_of(5) { 581.0 } else { 580.0 };
    let range = logged(0.02, quiet);
    assert!((45..=50).contains(&range.distinct), "{}", range.distinct);
    assert!(range.median_mm == Some(580.0) && !range.held);
}

#[test]
fn a_sensor_logged_more_slowly_than_it_measures_gives_a_reading_per_record() {
    assert_eq!(of_records(&[580.0; 10], 0.1).distinct, 10);
}

#[test]
fn the_median_weighs_readings_not_records() {
    // Six readings, of 3 or 2 records each; the middle record is 580.
    let values = [570.0, 575.0, 580.0, 585.0, 590.0];
    let records: Vec<f64> = values.iter().flat_map(|mm| [*mm; 3]).chain([600.0, 600.0]).collect();
    assert_eq!(of_records(&records, 1.0 / 128.0).median_mm, Some(582.5));
}

#[test]
fn a_stuck_sensor_is_told() {
    assert!(logged(0.02, |_| 580.0).held);
    assert!(!logged(0.02, |i| if i == 30 { 581.0 } else { 580.0 }).held);
    assert!(!of_records(&[580.0; 20], 1.0 / 128.0).held, "8 equal readings are no proof");
}

#[test]
fn a_step_is_told_and_the_clear_majority_used() {
    let hand = |share: u32| logged(0.02, move |i| if i < share { 300.0 } else { 580.0 } + noise(i));
    let range = hand(15);
    assert!(range.step && (range.median_mm.unwrap() - 580.0).abs() < 2.0, "{range:?}");
    assert!(range.spread_mm.unwrap() < 8.0);
    assert_eq!(hand(25).median_mm, None, "half and half: neither is the table");
    assert!(hand(25).step);
    let came_and_went = logged(0.02, |i| if (20..30).contains(&i) { 420.0 } else { 580.0 } + noise(i));
    assert!(came_and_went.step && (came_and_went.median_mm.unwrap() - 580.0).abs() < 2.0);
}

#[test]
fn noise_drift_and_stray_echoes_are_no_step() {
    assert!(!logged(0.02, |i| 580.0 + 6.0 * noise(i)).step);
    assert!(!logged(0.02, |i| 500.0 + 4.0 * f64::from(i) + noise(i)).step, "a head that leans back");
    assert!(!logged(0.02, |i| if i % 10 == 4 { 420.0 } else { 580.0 } + noise(i)).step, "stray echoes");
    assert!(!logged(0.02, |i| if i < 20 { 590.0 } else { 580.0 }).step, "10 mm");
}

/// A static target, 55.6 readings a second: no step and no stuck sensor in an hour, and a reading for nearly each record.
#[test]
fn a_real_log_of_a_static_target() {
    let Some(folder) = std::env::var_os("AIM_BATCH_REAL_DATA") else { return };
    let path = std::path::Path::new(&folder).join("tof_vl53l0x/static_tof_dist_data_1_h.csv");
    let Ok(text) = std::fs::read_to_string(path) else { return };
    let readings: Vec<f64> = text.lines().skip(3).filter_map(|line| line.trim().parse().ok()).collect();
    assert!(readings.len() > 200_000);
    let windows: Vec<Range> = readings.chunks_exact(56).map(|window| of_records(window, 1.0 / 55.6)).collect();
    assert!(windows.iter().all(|range| !range.step && !range.held));
    let distinct = windows.iter().map(|range| range.distinct).sum::<u32>() as f64 / windows.len() as f64;
    let runs = readings.chunk_by(|a, b| a.total_cmp(b).is_eq()).count() as f64 / windows.len() as f64;
    println!("{} windows of 56 records: {distinct:.2} readings by the rule, {runs:.2} runs", windows.len());
    assert!(distinct > 45.0 && distinct <= 56.0, "{distinct}");
    let off = windows.iter().filter(|range| (range.median_mm.unwrap() - 75.5).abs() > 3.0).count();
    assert!(off * 50 < windows.len(), "{off} windows off by more than 3 mm");
}
