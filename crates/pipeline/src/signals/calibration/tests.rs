#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
use model::UtcNs;

use super::*;

const RATE_HZ: u32 = 32;

/// Numbers in [-1, 1) that look random, the same each time.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from((self.0 >> 33) as u32) / f64::from(1_u32 << 30) - 1.0
    }
}

/// Feeds 11 s of each of `forces`: one full window each, the rest swallowed by a pause.
fn windows(forces: &[Vector3<f64>], noise_g: f64) -> StillWindows {
    let (mut windows, mut noise, mut time_s) = (StillWindows::default(), Noise(7), 0.0);
    for force in forces {
        for i in 0..11 * RATE_HZ {
            let jitter = Vector3::from_fn(|_, _| noise_g * noise.next());
            let time = UtcNs(0).plus_seconds(time_s + f64::from(i) / f64::from(RATE_HZ));
            windows.push(time, &(force + jitter));
        }
        time_s += 15.0;
    }
    windows
}

/// Directions all over the sphere (golden spiral).
fn all_over(n: u32) -> Vec<Vector3<f64>> {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    (0..n)
        .map(|i| {
            let z = 1.0 - 2.0 * (f64::from(i) + 0.5) / f64::from(n);
            let (sin, cos) = (golden * f64::from(i)).sin_cos();
            Vector3::new(cos * (1.0 - z * z).sqrt(), sin * (1.0 - z * z).sqrt(), z)
        })
        .collect()
}

/// The reading of a sensor with these errors: the inverse of [`AxisCalibration::apply`].
fn read_by(sensor: &AxisCalibration, forces: Vec<Vector3<f64>>) -> Vec<Vector3<f64>> {
    forces.into_iter().map(|force| force.component_div(&sensor.scale) - sensor.offset_g).collect()
}

fn bad_sensor() -> AxisCalibration {
    AxisCalibration { offset_g: Vector3::new(0.035, -0.06, 0.09), scale: Vector3::new(1.03, 0.98, 0.95) }
}

#[test]
fn known_offsets_and_scales_are_found_within_1_mg() {
    let calibration = windows(&read_by(&bad_sensor(), all_over(200)), 0.005).calibration();
    assert_eq!((calibration.verdict, calibration.windows), (CalibrationVerdict::Accepted, 200));
    let (before, after) = (calibration.error_before_mg.unwrap(), calibration.error_after_mg.unwrap());
    assert!(before > 30.0 && after < 1.0, "{before} {after}");
    let fit = calibration.accepted().unwrap();
    for (calibration, true_value) in [(fit.offset_g, bad_sensor().offset_g), (fit.scale, bad_sensor().scale)] {
        assert!((calibration - true_value).amax() < 0.001, "{calibration} {true_value}");
    }
}

#[test]
fn a_night_on_a_shelf_does_not_outweigh_the_day() {
    let mut forces = all_over(100);
    forces.extend(std::iter::repeat_n(Vector3::new(0.0, 0.6, 0.8), 2000));
    let windows = windows(&read_by(&bad_sensor(), forces), 0.005);
    let calibration = windows.calibration();
    let fit = calibration.accepted().unwrap();
    assert!((fit.offset_g - bad_sensor().offset_g).amax() < 0.001 && calibration.windows == 2100, "{calibration}");
    assert!((fit.scale - bad_sensor().scale).amax() < 0.001, "{calibration}");
}

#[test]
fn few_outliers_hardly_matter() {
    let mut forces = read_by(&bad_sensor(), all_over(200));
    for i in [20, 90, 150] {
        forces[i] *= 1.3; // a lift that sets off evenly
    }
    let fit = windows(&forces, 0.005).calibration().accepted().unwrap();
    assert!((fit.offset_g - bad_sensor().offset_g).amax() < 0.004, "{}", fit.offset_g);
}

#[test]
fn glasses_that_only_look_ahead_and_down_cover_too_few_directions() {
    let ahead: Vec<_> = all_over(2000).into_iter().filter(|f| f.y < -0.5).collect();
    let calibration = windows(&read_by(&bad_sensor(), ahead), 0.005).calibration();
    assert!(calibration.windows > 400 && calibration.directions > 12);
    assert_eq!(
        (calibration.verdict, calibration.accepted(), calibration.error_after_mg),
        (CalibrationVerdict::TooFewDirections, None, None)
    );
    assert!(calibration.error_before_mg.unwrap() > 10.0);
    assert!(calibration.to_string().contains("y -"), "{calibration}");
}

#[test]
fn six_sides_of_a_box_leave_nothing_to_be_wrong_about() {
    let sides = [Vector3::x(), Vector3::y(), Vector3::z()].into_iter().flat_map(|axis| [axis, -axis]);
    let forces: Vec<_> = sides.cycle().take(60).collect();
    let calibration = windows(&read_by(&bad_sensor(), forces), 0.001).calibration();
    assert_eq!((calibration.verdict, calibration.windows), (CalibrationVerdict::TooFewDirections, 60));
}

#[test]
fn noise_that_no_calibration_mends_is_refused() {
    // Lengths off by up to 8 % at random: no offset or scale explains that.
    let mut noise = Noise(3);
    let forces: Vec<_> = all_over(200).into_iter().map(|force| force * (1.0 + 0.08 * noise.next())).collect();
    let calibration = windows(&forces, 0.002).calibration();
    assert!(
        matches!(calibration.verdict, CalibrationVerdict::StillLarge | CalibrationVerdict::NotBetter),
        "{calibration}"
    );
    assert!(calibration.accepted().is_none() && calibration.error_after_mg.unwrap() > 10.0);
}

#[test]
fn what_makes_it_worse_is_refused() {
    let fit = AxisCalibration::NONE;
    assert_eq!(verdict(&fit, Some(2.0), Some(3.0)), CalibrationVerdict::NotBetter);
    assert_eq!(verdict(&fit, Some(2.0), Some(2.0)), CalibrationVerdict::NotBetter);
    assert_eq!(verdict(&fit, Some(30.0), Some(20.0)), CalibrationVerdict::StillLarge);
    let shrunk = AxisCalibration { scale: Vector3::new(0.1, 1.0, 1.0), ..fit };
    assert_eq!(verdict(&shrunk, Some(30.0), Some(1.0)), CalibrationVerdict::Implausible);
}

#[test]
fn a_perfect_sensor_without_noise_is_left_alone() {
    let calibration = windows(&all_over(200), 0.0).calibration();
    assert!(calibration.error_before_mg.unwrap() < 0.05);
    let fit = calibration.fit.unwrap();
    assert!(fit.offset_g.amax() < 1e-4 && (fit.scale - AxisCalibration::NONE.scale).amax() < 1e-4);
}

#[test]
fn moving_clipped_short_and_broken_windows_do_not_count() {
    let still = Vector3::new(0.0, -1.0, 0.0);
    assert_eq!(windows(&[still; 40], 0.01).calibration().windows, 40);
    assert_eq!(windows(&[still; 40], 0.05).calibration().windows, 0, "SD 29 mg");
    assert_eq!(windows(&[still * 2.5; 40], 0.0).calibration().windows, 0);
    assert_eq!(windows(&[still * f64::NAN; 40], 0.0).calibration().windows, 0);
    let mut with_gaps = StillWindows::default();
    for i in 0..40 * RATE_HZ {
        // 9.4 s of samples, then 0.6 s without.
        if i % 320 < 301 {
            with_gaps.push(UtcNs(0).plus_seconds(f64::from(i) / f64::from(RATE_HZ)), &still);
        }
    }
    assert_eq!(with_gaps.calibration().verdict, CalibrationVerdict::TooFewWindows);
    assert_eq!(with_gaps.calibration().windows, 0);
    assert_eq!(with_gaps.calibration().error_before_mg, None);
}

#[test]
fn memory_does_not_grow_with_nights() {
    let mut points = Points::default();
    let (mut noise, forces) = (Noise(1), all_over(20_000));
    for i in 0..1_000_000 {
        let jitter = Vector3::from_fn(|_, _| 0.004 * noise.next());
        points.push(&(forces[i % forces.len()] + jitter));
    }
    assert_eq!(points.windows(), 1_000_000);
    assert!(points.cells() < 100_000, "{} cells", points.cells());
}

/// Windows of a good sensor, and among them some in which x stands at its rail, whatever the sensor feels.
fn with_stuck_windows(rail_g: f64, noise_g: f64) -> GravityCalibration {
    let mut forces = read_by(&bad_sensor(), all_over(95));
    forces.extend(all_over(16).into_iter().map(|force| Vector3::new(rail_g, force.y, force.z)));
    let (mut windows, mut noise, mut time_s) = (StillWindows::default(), Noise(7), 0.0);
    for force in &forces {
        for i in 0..11 * RATE_HZ {
            let mut value = force + Vector3::from_fn(|_, _| noise_g * noise.next());
            if (force.x - rail_g).abs() < 1e-12 {
                value.x = rail_g;
            }
            windows.push(UtcNs(0).plus_seconds(time_s + f64::from(i) / f64::from(RATE_HZ)), &value);
        }
        time_s += 15.0;
    }
    windows.calibration()
}

#[test]
fn windows_at_a_rail_do_not_spoil_the_fit() {
    // The end of a sensor of +-2 g, the same below, and the ends of sensors of +-1.5 g and +-1.2 g with and without noise.
    for (rail_g, noise_g) in [(1.984, 0.0), (1.984, 0.005), (-2.0, 0.005), (1.5, 0.0), (1.5, 0.005), (-1.25, 0.005)] {
        let calibration = with_stuck_windows(rail_g, noise_g);
        assert_eq!(
            (calibration.verdict, calibration.windows, calibration.at_rail),
            (CalibrationVerdict::Accepted, 95, 16)
        );
        let fit = calibration.accepted().unwrap();
        assert!((fit.offset_g - bad_sensor().offset_g).amax() < 0.002, "{rail_g}: {calibration}");
        assert!((fit.scale - bad_sensor().scale).amax() < 0.002, "{rail_g}: {calibration}");
        assert!(calibration.to_string().contains("(16 more, with an axis at the sensor's rail, are left out)"));
    }
}

/// A large offset makes the sides of a good sensor its extremes; they are what the calibration lives on.
#[test]
fn the_sides_of_a_sensor_with_a_large_offset_are_no_rail() {
    let sensor = AxisCalibration { offset_g: Vector3::new(-0.25, 0.0, 0.0), scale: Vector3::new(1.0, 1.0, 1.0) };
    let mut forces = all_over(100);
    forces.extend([Vector3::x(); 20]);
    let calibration = windows(&read_by(&sensor, forces), 0.004).calibration();
    assert_eq!((calibration.verdict, calibration.at_rail), (CalibrationVerdict::Accepted, 0));
    assert!((calibration.fit.unwrap().offset_g - sensor.offset_g).amax() < 0.001);
}

/// A real ADXL345 log of three minutes (Axivity AX3), at its declared 100 Hz.
#[test]
fn a_real_log_that_is_too_short_is_refused() {
    let Some(folder) = std::env::var_os("AIM_BATCH_REAL_DATA") else { return };
    let path = std::path::Path::new(&folder).join("imu_axivity_adxl345/ax3_testfile_decoded.csv");
    let Ok(text) = std::fs::read_to_string(path) else { return };
    let mut windows = StillWindows::default();
    for (i, line) in text.lines().skip(1).enumerate() {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        windows.push(UtcNs(0).plus_seconds(i as f64 / 100.0), &Vector3::new(cells[7], cells[8], cells[9]));
    }
    let calibration = windows.calibration();
    println!("{} {calibration}", calibration.verdict.code());
    assert_eq!((calibration.verdict, calibration.fit), (CalibrationVerdict::TooFewWindows, None));
}

/// `cargo test --release -p aim-batch-pipeline -- --ignored seven_days --nocapture`
#[test]
#[ignore = "a measurement of time, not a test"]
fn seven_days_take_seconds() {
    let (mut windows, start) = (StillWindows::default(), std::time::Instant::now());
    for i in 0..7 * 86_400 * 128_i64 {
        windows.push(UtcNs(i * 7_812_500), &Vector3::new(0.001 * (i % 7) as f64, -1.0, 0.0));
    }
    println!("{} in {:.2} s", windows.calibration(), start.elapsed().as_secs_f64());
    assert!(start.elapsed().as_secs_f64() < 10.0);
}
