//! From a stream of samples to the signals at images.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::convert::Infallible;

use ingest::timeline::Span;
use model::FrameReason;

use super::*;

const RATE_HZ: f64 = 32.0;

fn seconds(s: f64) -> UtcNs {
    UtcNs(0).plus_seconds(s)
}

fn settings(gravity_calibration: GravityCalibrate) -> ReadingSettings {
    ReadingSettings { gravity_calibration, ..ReadingSettings::default() }
}

fn judged(sensed: &SessionReadings) -> Vec<FrameSignals> {
    let settings = PoseSettings::with_mount(21_f64.to_radians());
    sensed.readings.iter().map(|reading| reading.judge(&settings)).collect()
}

fn readings_of(
    samples: &[Sample],
    timeline: &Timeline,
    images: &[UtcNs],
    settings: &ReadingSettings,
) -> SessionReadings {
    let stream = |each: &mut dyn FnMut(Sample)| -> Result<(), Infallible> {
        samples.iter().for_each(|sample| each(*sample));
        Ok(())
    };
    evaluate(stream, timeline, images, settings).unwrap()
}

/// The device lies still in many directions, 12 s each, then looks 34 degrees down for a minute from `worn_s`; its x axis
/// reads 50 mg too much. All acceleration comes before all ranges.
fn recording() -> (Vec<Sample>, f64) {
    let rest = |time_s: f64| {
        let turn = (time_s / 12.0).floor();
        let z = 1.0 - 2.0 * ((turn * 0.618_034) % 1.0);
        let (sin, cos) = (turn * 2.4).sin_cos();
        Vector3::new(cos * (1.0 - z * z).sqrt(), sin * (1.0 - z * z).sqrt(), z)
    };
    let worn_s = 12.0 * 150.0;
    let worn = Vector3::new(0.0, -(34_f64.to_radians().cos()), -(34_f64.to_radians().sin()));
    let times = || (0..((worn_s + 60.0) * RATE_HZ) as u32).map(|i| f64::from(i) / RATE_HZ);
    let acceleration = times().map(|s| {
        let force = if s < worn_s { rest(s) } else { worn } + Vector3::new(0.05, 0.0, 0.0);
        Sample::Acceleration { time: seconds(s), g: force.into() }
    });
    let range = times().map(|s| Sample::Range { time: seconds(s), mm: 580.0 + (s * RATE_HZ) % 7.0 });
    (acceleration.chain(range).collect(), worn_s)
}

#[test]
fn an_accepted_calibration_is_applied_only_when_asked_for() {
    let (samples, worn_s) = recording();
    let roll_deg = |gravity_calibration| {
        let settings = settings(gravity_calibration);
        let sensed = readings_of(&samples, &Timeline::default(), &[seconds(worn_s + 30.0)], &settings);
        let frames = judged(&sensed);
        assert_eq!(frames[0].reason, FrameReason::Selected);
        (frames[0].pitch_roll_rad.unwrap().1.to_degrees(), sensed.calibration)
    };
    let (off, reported, applied) =
        (roll_deg(GravityCalibrate::Off), roll_deg(GravityCalibrate::Report), roll_deg(GravityCalibrate::Apply));
    assert!(off.0.abs() > 4.0 && (off.0 - reported.0).abs() < 1e-12);
    assert!(applied.0.abs() < 0.05, "{}", applied.0);
    assert_eq!(off.1, None);
    assert_eq!(reported.1, applied.1);
    let offset_g = applied.1.unwrap().accepted().unwrap().offset_g;
    assert!((offset_g.x + 0.05).abs() < 0.001, "{offset_g}");
}

#[test]
fn how_the_sensors_alternate_does_not_matter() {
    let (mut samples, worn_s) = recording();
    let images = [seconds(100.0), seconds(worn_s + 1.0), seconds(worn_s + 30.0), seconds(worn_s + 60.0)];
    let apart = readings_of(&samples, &Timeline::default(), &images, &ReadingSettings::default());
    samples.sort_by_key(Sample::time);
    assert_eq!(readings_of(&samples, &Timeline::default(), &images, &ReadingSettings::default()), apart);
    assert_eq!(judged(&apart)[3].flags, [FrameFlag::GravityEdge], "the recording ends there");
}

#[test]
fn an_image_near_a_time_that_exists_twice_has_no_pose() {
    let (samples, worn_s) = recording();
    let span = Span { from: seconds(worn_s + 20.0), to: seconds(worn_s + 25.0) };
    let timeline = Timeline { ambiguous: vec![span], ..Timeline::default() };
    let images = [15.0, 19.0, 22.0, 26.0, 30.0].map(|s| seconds(worn_s + s));
    let sensed = readings_of(&samples, &timeline, &images, &ReadingSettings::default());
    let frames = judged(&sensed);
    let reasons: Vec<_> = frames.iter().map(|frame| frame.reason).collect();
    let (good, twice) = (FrameReason::Selected, FrameReason::AmbiguousTime);
    assert_eq!(reasons, [good, twice, twice, twice, good]);
    assert!(frames[2].pose.is_none() && frames[2].range_mm.is_none());
}
