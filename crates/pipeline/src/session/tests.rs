//! One session of the shipped sample, card to rows, with settings that it does not ship with.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::Path;

use model::{Method, Severity};

use super::*;
use crate::reporter::Silent;
use crate::study::{GravityCalibrate, RangeCone, StudySpec};

/// Without losses.
fn run(adjust: impl FnOnce(&mut StudySpec)) -> SessionOutput {
    let output = run_with(adjust);
    assert!(!output.status.has_losses(), "{:?}", output.status.problems);
    output
}

fn run_with(adjust: impl FnOnce(&mut StudySpec)) -> SessionOutput {
    let bench = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data-samples/published-bench");
    let study = Study::load(&bench, adjust).unwrap();
    let dir = study.sessions.iter().find(|dir| dir.name == "bench-35cm-38deg").unwrap();
    let mcap_dir = tempfile::tempdir().unwrap();
    let options = SessionOptions {
        mcap_dir: mcap_dir.path().to_owned(),
        survey: false,
        program: "test".to_owned(),
        stop: Stop::default(),
    };
    run_session(&study, dir, &options, &Silent)
}

fn codes(output: &SessionOutput) -> Vec<&str> {
    assert!(output.status.problems.iter().all(|problem| problem.severity == Severity::Note));
    output.status.problems.iter().map(|problem| problem.code.as_str()).collect()
}

#[test]
fn readings_behind_the_records_are_counted_and_nothing_is_flagged() {
    let output = run(|_| ());
    assert!(codes(&output).is_empty());
    for frame in &output.frames {
        // The sample's sensor holds a reading for 33 ms; equal ones in a row count for what they may have been.
        assert!((110..=129).contains(&frame.range_samples) && (25..=36).contains(&frame.range_distinct), "{frame:?}");
        assert_eq!(frame.flags, "");
    }
    assert!(
        output
            .results
            .iter()
            .all(|row| row.flags.split(',').all(|flag| flag.is_empty() || flag == "pitch_outside_target"))
    );
}

#[test]
fn what_was_asked_for_is_told_and_nothing_is_lost_by_it() {
    let asked = run(|spec| {
        spec.signals.gravity_calibration = GravityCalibrate::Apply;
        spec.time.estimate_lag = true;
    });
    assert_eq!(codes(&asked), ["gravity_calibration_refused", "image_lag_unknown"]);
    let facts: Vec<_> = asked.status.problems.iter().map(|problem| problem.fact.as_str()).collect();
    assert!(facts[0].contains("still windows of 10 s in") && facts[1].contains("pairs"), "{facts:?}");
    let plain = run(|_| ());
    assert_eq!((asked.results, asked.frames), (plain.results, plain.frames), "refused and unknown: nothing changes");
}

#[test]
fn the_cone_moves_the_range_of_ray_and_not_of_paper() {
    let output = run(|spec| spec.signals.range_cone = RangeCone::TiltedPlane);
    let rows = output.results.iter().filter(|row| row.level == model::Level::Frame);
    let mut seen = 0;
    for row in rows {
        let frame = output.frames.iter().find(|frame| Some(&frame.image) == row.image.as_ref()).unwrap();
        let ratio = frame.range_mm.unwrap() / row.range_mm.unwrap();
        // At 38 degrees the reading is 2.5 % short.
        let expected = if row.method == Method::Paper { 1.0 } else { 0.975 };
        assert!((ratio - expected).abs() < 0.003, "{} {ratio}", row.method);
        seen += 1;
    }
    assert!(seen > 0);
}

#[test]
fn a_declared_lag_moves_where_signals_are_looked_up() {
    let run_frames = |lag_s| run_with(|spec| spec.time.image_lag_s = lag_s).frames;
    let far = run_frames(3600.0);
    assert!(far.iter().all(|frame| frame.reason == model::FrameReason::NoAcceleration));
    let (near, plain) = (run_frames(2.0), run_frames(0.0));
    assert!(near.iter().zip(&plain).all(|(near, plain)| near.time_utc == plain.time_utc));
    assert!(near.iter().zip(&plain).any(|(near, plain)| near.pitch_deg != plain.pitch_deg));
}
