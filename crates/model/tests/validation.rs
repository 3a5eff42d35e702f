//! The statistics, compared with those of pingouin and numpy (vectors/agreement.json, made by vectors/agreement.py).
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use aim_batch_model::validation::{ErrorSummary, agreement, bootstrap, coverage, paired, quantile};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use serde_json::Value;

fn reference() -> Value {
    serde_json::from_str(include_str!("vectors/agreement.json")).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

#[track_caller]
fn assert_near(got: f64, expected: &Value) {
    let expected = expected.as_f64().unwrap();
    assert!((got - expected).abs() < 1e-9 * expected.abs().max(1.0), "{got} {expected}");
}

#[test]
fn raters_agree_as_pingouin_says() {
    let reference = reference();
    for table in ["simulated", "table_v", "table_vi"] {
        let ratings: Vec<Vec<f64>> = reference[table]["ratings"].as_array().unwrap().iter().map(numbers).collect();
        let agreed = agreement(&ratings).unwrap();
        assert_near(agreed.icc, &reference[table]["icc_2_1"]);
        assert_eq!((agreed.targets, agreed.raters), (ratings.len(), 4));
    }
}

/// The raters have offsets and noise of known variances. The SEM is the root of their sum.
#[test]
fn the_standard_error_of_measurement_is_raters_and_residual() {
    let mut random = ChaCha8Rng::seed_from_u64(4);
    let mut draw = |sigma: f64| sigma * Distribution::<f64>::sample(&StandardNormal, &mut random);
    let raters: Vec<f64> = (0..300).map(|_| draw(3.0)).collect();
    let ratings: Vec<Vec<f64>> = (0..300)
        .map(|_| {
            let target = draw(20.0);
            raters.iter().map(|rater| target + rater + draw(4.0)).collect()
        })
        .collect();
    let agreed = agreement(&ratings).unwrap();
    assert!((agreed.sem - 5.0).abs() < 0.2, "{agreed:?}");
    assert!((agreed.icc - 400.0 / 425.0).abs() < 0.01, "{agreed:?}");
    assert!(agreement(&ratings[..1]).is_none() && agreement(&[vec![1.0], vec![2.0]]).is_none());
    assert!(agreement(&[vec![1.0, 1.0], vec![1.0, 1.0]]).is_none());
}

#[test]
fn errors_in_one_line_as_numpy_says() {
    let errors = &reference()["errors"];
    let summary = ErrorSummary::from_errors(&numbers(&errors["values"])).unwrap();
    for (got, name) in [
        (summary.bias, "mean"),
        (summary.sd.unwrap(), "sd"),
        (summary.rmse, "rmse"),
        (summary.mae, "mae"),
        (summary.median, "median"),
        (summary.q95_absolute, "q95_absolute"),
        (summary.max_absolute, "max_absolute"),
    ] {
        assert_near(got, &errors[name]);
    }
    let limits = summary.limits.unwrap();
    assert_near(limits[0], &errors["loa"][0]);
    assert_near(limits[1], &errors["loa"][1]);
    assert!(ErrorSummary::from_errors(&[]).is_none() && ErrorSummary::from_errors(&[1.0]).unwrap().limits.is_none());
}

#[test]
fn student_s_t_as_pingouin_says() {
    let paired_reference = &reference()["paired"];
    let pairs: Vec<(f64, f64)> =
        numbers(&paired_reference["a"]).into_iter().zip(numbers(&paired_reference["b"])).collect();
    assert_near(paired(&[pairs], 10, 1).unwrap().t.unwrap(), &paired_reference["t_pingouin"]);
}

#[test]
fn quantiles_lie_between_neighbours() {
    assert!((quantile(vec![3.0, 1.0, 2.0], 0.75) - 2.5).abs() < 1e-15);
    assert!(quantile(vec![], 0.5).is_nan());
}

/// Each cluster has an error of its own. The interval of the mean must be as wide as the number of clusters makes it, and
/// not as narrow as the number of their members would.
#[test]
fn whole_clusters_are_drawn() {
    let mut random = ChaCha8Rng::seed_from_u64(9);
    let mut draw = |sigma: f64| sigma * Distribution::<f64>::sample(&StandardNormal, &mut random);
    let (mut covered, runs) = (0, 300);
    for run in 0..runs {
        let clusters: Vec<Vec<f64>> = (0..30)
            .map(|_| {
                let common = draw(2.0);
                (0..10).map(|_| common + draw(1.0)).collect()
            })
            .collect();
        let mean = |sample: &[f64]| ErrorSummary::from_errors(sample).map(|s| s.bias);
        let interval = bootstrap(&clusters, mean, 400, run).unwrap();
        covered += u32::from(interval.low < 0.0 && interval.high > 0.0);
        if run == 0 {
            assert_eq!(bootstrap(&clusters, mean, 400, 0), Some(interval), "seeded");
            assert!(
                (0.25..0.55).contains(&((interval.high - interval.low) / 3.92)),
                "2 / root 30 is 0.37: {interval:?}"
            );
        }
    }
    let share = f64::from(covered) / 300.0;
    assert!((0.88..=0.98).contains(&share), "{share}");
    assert_eq!(bootstrap(&[vec![1.0]], |s| Some(s[0]), 10, 1), None);
}

#[test]
fn coverage_counts() {
    let counted = coverage(&[(0.5, 1.0), (-1.5, 1.0), (3.0, 1.0), (-0.9, 1.0)]).unwrap();
    assert!((counted.within_68 - 0.5).abs() < 1e-15 && (counted.within_95 - 0.75).abs() < 1e-15);
    assert!(coverage(&[]).is_none());
}
