//! One session of the shipped sample, card to rows, with settings that it does not ship with.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::Path;

use model::{Method, ResultRow, Severity};

use super::{SessionOptions, SessionOutput, run_session};
use crate::reporter::Silent;
use crate::signals::{GravityCalibrate, RangeCone};
use crate::stop::Stop;
use crate::study::{Study, StudySpec};

/// The output of a session that must not have losses.
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
        is_bench: false,
        program: "test".to_owned(),
        stop: Stop::default(),
    };
    run_session(&study, dir, &options, &Silent)
}

fn codes(output: &SessionOutput) -> Vec<&str> {
    assert!(output.status.problems.iter().all(|problem| problem.severity == Severity::Note));
    output.status.problems.iter().map(|problem| problem.code.code()).collect()
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
        let expected = if row.method_used == Some(Method::Paper) { 1.0 } else { 0.975 };
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

/// Every size comes with the parts of its uncertainty, and the best of the methods says which it took.
#[test]
fn the_best_is_one_of_the_others_and_says_which() {
    let output = run(|_| ());
    let frames: Vec<_> = output.results.iter().filter(|row| row.level == model::Level::Frame).collect();
    let best: Vec<_> = frames.iter().filter(|row| row.method == Method::Best).collect();
    assert!(!best.is_empty() && best.len() * 3 == frames.len(), "paper, ray and best; no base is outlined");
    for row in best {
        let same = |other: &&&ResultRow| {
            (&other.image, &other.object, &other.rater, other.quantity)
                == (&row.image, &row.object, &row.rater, row.quantity)
                && other.method == row.method_used.unwrap()
        };
        let taken = frames.iter().find(same).unwrap();
        assert_eq!((taken.predicted_mm, taken.sigma_mm, &taken.doubts), (row.predicted_mm, row.sigma_mm, &row.doubts));
        assert!(row.sigma_common_mm.unwrap() < row.sigma_mm.unwrap());
    }
    // Nobody said how the walls of these bowls stand.
    let heights = frames.iter().filter(|row| row.quantity == model::Quantity::Height && row.method == Method::Ray);
    assert!(heights.clone().count() > 0);
    assert!(heights.into_iter().all(|row| row.doubts == "wall_assumed_vertical"));
}

#[test]
fn only_what_was_asked_for_is_given() {
    let output = run(|spec| spec.measure.methods = vec![Method::Best]);
    assert!(!output.results.is_empty() && output.results.iter().all(|row| row.method == Method::Best));
    assert!(output.results.iter().all(|row| row.method_used.is_some_and(|used| used != Method::Best)));
}

/// Ranks need no marks, and the rank says which image is the surest.
#[test]
fn selected_images_are_ranked_before_they_are_marked() {
    let output = run(|spec| spec.select.target_pitch_deg = 38.0);
    let mut selected: Vec<_> =
        output.frames.iter().filter(|frame| frame.reason == model::FrameReason::Selected).collect();
    assert!(selected.len() > 3);
    selected.sort_by_key(|frame| frame.rank);
    let ranks: Vec<_> = selected.iter().map(|frame| frame.rank.unwrap() as usize).collect();
    assert_eq!(ranks, (1..=selected.len()).collect::<Vec<_>>());
    assert!(selected.windows(2).all(|pair| pair[0].plate_sigma_mm <= pair[1].plate_sigma_mm));
    assert!(selected[0].plate_sigma_mm.unwrap() > 6.0, "3 % of range alone are 6 mm");
    let others = output.frames.iter().filter(|frame| frame.reason != model::FrameReason::Selected);
    assert!(others.into_iter().all(|frame| frame.rank.is_none()));
}
