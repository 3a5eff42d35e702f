#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::Path;

use model::{Estimate, InputSigma, Kind, Measured, Method, PerSource, Quantity, Sensitivity, Source, UtcNs, Verdict};

use super::*;

const INPUTS: InputSigma = InputSigma { range_relative: 0.03, mark_px: 2.0, ..InputSigma::NONE };

fn row(rater: &str, image: &str, predicted_mm: Option<f64>, selected: bool) -> ResultRow {
    ResultRow {
        study: "t".to_owned(),
        session: "s".to_owned(),
        rater: rater.to_owned(),
        image: Some(image.to_owned()),
        time_utc: Some(UtcNs(0)),
        pitch_deg: Some(55.0),
        roll_deg: Some(1.0),
        range_mm: Some(500.0),
        predicted_mm,
        plane_z_mm: Some(0.0),
        truth_mm: Some(200.0),
        selected,
        method_used: Some(Method::Ray),
        ..ResultRow::without_numbers("plate", Kind::Plate, Quantity::Diameter, Method::Ray)
    }
}

/// A size is wrong by 3 % in all images alike, through the range, and by 2 mm of marks in each.
fn measurement(rater: &str, image: &str, predicted_mm: f64, selected: bool) -> Measurement {
    let mut by_source = PerSource::zeros();
    by_source[Source::RangeScale.index()] = predicted_mm;
    let sensitivity = Sensitivity { by_source, marks_mm_per_px: 1.0 };
    let sigma = sensitivity.sigma(&INPUTS);
    let measured = Measured::by_one_mark(Quantity::Diameter, predicted_mm, 0.0);
    let estimate = Estimate { method: Method::Ray, measured, sensitivity, sigma, wall_slope: None, doubts: Vec::new() };
    Measurement {
        row: with_sigma(row(rater, image, Some(predicted_mm), selected), &sigma),
        estimate: Some(estimate),
        inputs: INPUTS,
        picture: usize::from(image.as_bytes()[0]),
        shared_mm: 0.0,
        penalty: 1.0,
    }
}

fn study(adjust: impl FnOnce(&mut crate::study::StudySpec)) -> Study {
    Study::load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data-samples/published-bench"), adjust).unwrap()
}

fn fused(measurements: &mut [Measurement]) -> Vec<ResultRow> {
    fuse(&study(|spec| spec.measure.methods = vec![Method::Ray]), &[], measurements)
}

#[test]
fn selected_images_with_what_is_common_kept() {
    let mut all =
        [measurement("A", "a", 204.0, true), measurement("A", "b", 208.0, true), measurement("A", "c", 300.0, false)];
    let rows = fused(&mut all);
    assert_eq!(rows.len(), 1);
    let row = &rows[0];
    assert!((row.predicted_mm.unwrap() - 206.0).abs() < 1e-9 && (row.error_pct.unwrap() - 3.0).abs() < 1e-9);
    assert_eq!((row.level, &row.image, row.time_utc, row.frames), (Level::Fused, &None, None, 2));
    assert!((row.spread_mm.unwrap() - 8.0_f64.sqrt()).abs() < 1e-12);
    assert!((row.sigma_marks_mm.unwrap() - 2.0 / 2.0_f64.sqrt()).abs() < 1e-12, "marks are independent");
    assert!((row.sigma_range_mm.unwrap() - 0.03 * 206.0).abs() < 1e-12, "the range's scale is common");
    assert_eq!((row.sigma_common_mm, row.sigma_pitch_mm), (row.sigma_range_mm, Some(0.0)));
    assert!((row.sigma_mm.unwrap() - (0.03_f64 * 206.0).hypot(2.0_f64.sqrt())).abs() < 1e-12);
    // 4 mm apart, where 2 mm of SD each are known: chi-square 16 / 8.
    assert!((row.chi_squared.unwrap() - 2.0).abs() < 1e-9 && row.chi_squared_degrees == Some(1));
    assert_eq!(row.consistency, Some(Verdict::Consistent));
    let weights: Vec<_> = all.iter().map(|m| m.row.weight.map(|w| (1000.0 * w).round())).collect();
    assert_eq!(weights, [Some(500.0), Some(500.0), None]);
}

#[test]
fn a_flag_of_one_image_is_one_of_the_fused_size() {
    let flagged = |flags: &str| {
        let plain = measurement("A", "a", 200.0, true);
        Measurement { row: ResultRow { flags: flags.to_owned(), ..plain.row }, ..plain }
    };
    let rows = fused(&mut [flagged(""), flagged("range_step,mark_outside_picture"), flagged("range_step")]);
    assert_eq!(rows[0].flags, "mark_outside_picture,range_step");
}

#[test]
fn raters_stay_apart_and_are_joined_in_a_consensus_that_names_who_is_off() {
    let mut all: Vec<_> = [("A", 200.0), ("B", 201.0), ("C", 60.0), ("D", 199.0)]
        .into_iter()
        .map(|(rater, mm)| measurement(rater, "a", mm, true))
        .collect();
    let without = measurement("A", "b", 1.0, true);
    all.push(Measurement { estimate: None, row: row("A", "b", None, true), ..without });
    let rows = fused(&mut all);
    let values: Vec<_> = rows.iter().map(|row| (row.rater.as_str(), row.level)).collect();
    let fused = |rater| (rater, Level::Fused);
    assert_eq!(values, [fused("A"), fused("B"), fused("C"), fused("D"), ("all", Level::Consensus)]);
    let consensus = &rows[4];
    assert!((consensus.predicted_mm.unwrap() - 200.0).abs() < 4.0, "{consensus:?}");
    assert_eq!((consensus.flags.as_str(), consensus.frames), ("inconsistent,outlier_rater:C", 1));
    assert_eq!(consensus.consistency, Some(Verdict::Inconsistent));
    let problems = disagreements("s", &rows);
    assert_eq!(problems.len(), 1);
    assert!(problems[0].fact.contains("off: C") && problems[0].severity == model::Severity::Note, "{problems:?}");
}

/// A rater with many images has one vote, as a rater with one image has.
#[test]
fn raters_count_alike_in_a_consensus() {
    let mut all: Vec<_> = ["a", "b", "c", "d"].map(|image| measurement("A", image, 200.0, true)).into_iter().collect();
    all.push(measurement("B", "a", 203.0, true));
    let consensus = fused(&mut all).pop().unwrap();
    // 3 % of 201.5 mm are common, 36.5 mm^2; of its own A has 1 mm of marks, B 2 mm.
    let (a, b) = (1.0 / 37.5, 1.0 / 40.5);
    assert!((consensus.predicted_mm.unwrap() - (200.0 * a + 203.0 * b) / (a + b)).abs() < 0.01);
    assert_eq!((consensus.level, consensus.frames), (Level::Consensus, 4));
}

/// The ray puts A's size at 100 with a doubt, the coaxial method at 200 without; B has the ray's without a doubt.
#[test]
fn the_best_of_all_is_of_the_methods_that_are_the_best_of_each() {
    let by = |rater: &str, method: Method, mm: f64, doubts: Vec<Doubt>| {
        let plain = measurement(rater, "a", mm, true);
        let estimate = plain.estimate.map(|estimate| Estimate { method, doubts, ..estimate });
        Measurement { row: ResultRow { method, method_used: Some(method), ..plain.row }, estimate, ..plain }
    };
    let mut all = [
        by("A", Method::Ray, 100.0, vec![Doubt::WallSloped]),
        by("A", Method::Coaxial, 200.0, Vec::new()),
        by("B", Method::Ray, 202.0, Vec::new()),
    ];
    let rows = fuse(&study(|spec| spec.measure.methods = vec![Method::Ray, Method::Best]), &[], &mut all);
    let consensus: Vec<&ResultRow> = rows.iter().filter(|row| row.level == Level::Consensus).collect();
    let [ray, best] = consensus.as_slice() else { panic!("{consensus:?}") };
    assert!((ray.predicted_mm.unwrap() - 151.0).abs() < 2.0 && ray.flags == "inconsistent", "{ray:?}");
    assert_eq!((best.method, best.flags.as_str(), best.doubts.as_str()), (Method::Best, "mixed_methods", ""));
    assert!((best.predicted_mm.unwrap() - 201.0).abs() < 0.1, "{best:?}");
}

#[test]
fn an_image_that_is_off_is_named() {
    let mut all: Vec<_> = [("a", 200.0), ("b", 201.0), ("c", 140.0), ("d", 199.0)]
        .into_iter()
        .map(|(image, mm)| measurement("A", image, mm, true))
        .collect();
    assert_eq!(fused(&mut all)[0].flags, "inconsistent,outlier:c");
    assert!(all[2].row.weight.unwrap() < 0.1);
}

#[test]
fn doubtful_images_rank_last_and_the_best_ones_can_be_asked_for() {
    let mut all: Vec<_> = ["a", "b", "c"].into_iter().map(|image| measurement("A", image, 200.0, true)).collect();
    all[0].penalty = 4.0;
    all[1].penalty = 2.0;
    assert_eq!(fused(&mut all)[0].frames, 3);
    assert_eq!(all.iter().map(|m| m.row.rank).collect::<Vec<_>>(), [Some(3), Some(2), Some(1)]);
    let two = study(|spec| {
        spec.measure.methods = vec![Method::Ray];
        spec.select.best_images = std::num::NonZeroUsize::new(2);
    });
    for m in &mut all {
        m.row.weight = None;
    }
    assert_eq!(fuse(&two, &[], &mut all)[0].frames, 2);
    assert_eq!(all[0].row.weight, None);
}

#[test]
fn nothing_selected_gives_nothing() {
    assert!(fused(&mut [measurement("A", "a", 1.0, false)]).is_empty());
}
