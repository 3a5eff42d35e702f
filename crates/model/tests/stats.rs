//! The error statistics, compared with the published tables. Where a printed statistic does not follow from the printed
//! rows, the test expects the value that does, and a comment at the line gives the printed one.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use aim_batch_model::ErrorStats;

/// An object with its true size and nine predictions, in cm.
type Setups = (&'static str, f64, [f64; 9]);

const TABLE_II: [Setups; 5] = [
    ("circular plate (small)", 18.0, [16.95, 16.56, 19.07, 17.13, 17.37, 18.92, 17.61, 18.23, 18.04]),
    ("circular plate (medium)", 22.0, [20.59, 21.14, 23.36, 22.51, 21.47, 23.73, 22.01, 22.79, 22.33]),
    ("circular plate (large)", 26.0, [25.71, 25.91, 28.41, 27.81, 26.99, 29.39, 27.21, 27.53, 27.39]),
    ("square plate (small)", 18.0, [17.31, 17.86, 19.37, 18.33, 18.34, 19.88, 18.92, 18.03, 18.35]),
    ("square plate (medium)", 23.0, [21.98, 22.14, 24.83, 23.93, 23.09, 25.18, 24.07, 23.21, 23.54]),
];
const TABLE_III: [Setups; 3] = [
    ("circular bowl (small)", 3.0, [1.96, 3.04, 4.44, 1.69, 2.13, 4.31, 1.65, 2.26, 3.53]),
    ("circular bowl (medium)", 7.0, [6.13, 7.83, 1.01, 5.70, 5.74, 10.77, 3.69, 5.31, 8.95]),
    ("circular bowl (large)", 6.0, [5.17, 7.95, 10.32, 4.43, 5.57, 9.85, 4.61, 5.57, 6.84]),
];
const TABLE_IV: [Setups; 3] = [
    ("circular bowl (small)", 7.0, [6.90, 6.97, 7.59, 7.02, 7.55, 7.79, 7.35, 7.18, 7.27]),
    ("circular bowl (medium)", 11.0, [10.28, 10.26, 11.94, 10.26, 11.64, 12.66, 11.53, 11.49, 11.44]),
    ("circular bowl (large)", 15.0, [14.62, 14.41, 17.44, 15.11, 16.92, 17.55, 15.97, 16.00, 16.49]),
];
/// The printed mean and sample SD of each object, in the order of the rows.
const SUMMARY_II: [(f64, f64); 5] = [(-1.31, 4.82), (0.96, 4.66), (5.28, 4.39), (2.71, 4.38), (2.40, 4.73)];
const SUMMARY_III: [(f64, f64); 3] = [(-7.40, 36.45), (-12.50, 40.90), (11.67, 36.81)];
const SUMMARY_IV: [(f64, f64); 3] = [(4.16, 4.38), (2.52, 7.66), (7.04, 7.73)];

/// A true size with those of four raters, in cm.
type Raters = (f64, [f64; 4]);

const TABLE_V: [Raters; 3] = [
    (24.5, [25.7, 25.18, 7.17, 26.37]),  // white box
    (14.2, [15.1, 15.75, 15.1, 15.39]),  // pink bowl
    (14.9, [14.83, 15.2, 15.41, 15.25]), // green bowl
];
/// The truths are those that the printed errors imply. The table prints the raters' means as truths.
const TABLE_VI: [Raters; 3] = [
    (3.8, [3.46, 1.563, 5.66, 2.98]), // white box
    (6.0, [6.185, 9.62, 6.7, 5.841]), // pink bowl
    (7.0, [5.792, 8.3, 8.06, 7.556]), // green bowl
];

fn error_pct(predicted: f64, truth: f64) -> f64 {
    100.0 * (predicted - truth) / truth
}

fn setup_errors(table: &[Setups]) -> Vec<Vec<f64>> {
    table.iter().map(|(_, truth, predicted)| predicted.iter().map(|p| error_pct(*p, *truth)).collect()).collect()
}

fn rater_errors(table: &[Raters]) -> Vec<f64> {
    table.iter().map(|(truth, raters)| error_pct(raters.iter().sum::<f64>() / 4.0, *truth)).collect()
}

/// Asserts that mean and SD agree with values of two decimals. `tolerance` covers their rounding and that of the predictions.
fn assert_mean_sd(got: (f64, f64), expected: (f64, f64), tolerance: f64, place: &str) {
    let close = (got.0 - expected.0).abs() <= tolerance && (got.1 - expected.1).abs() <= tolerance;
    assert!(close, "{place}: {:.3} +- {:.3}, expected {} +- {}", got.0, got.1, expected.0, expected.1);
}

fn mean_and_sample_sd(errors: &[f64]) -> (f64, f64) {
    let stats = ErrorStats::from_errors(errors).unwrap();
    (stats.mean, stats.sample_sd.unwrap())
}

#[test]
fn tables_of_setups_have_sample_sd() {
    let overall = |table: &[Setups]| mean_and_sample_sd(&setup_errors(table).concat());
    assert_mean_sd(overall(&TABLE_II), (2.01, 4.90), 0.006, "II"); // printed: 2.01 +- 4.10
    assert_mean_sd(overall(&TABLE_III), (-2.73, 38.11), 0.006, "III"); // printed: +2.75 +- 38.11
    assert_mean_sd(overall(&TABLE_IV), (4.58, 6.78), 0.006, "IV");
}

#[test]
fn objects_of_setup_tables_have_the_printed_statistics() {
    for (table, summary, tolerance) in [
        (TABLE_II.as_slice(), SUMMARY_II.as_slice(), 0.02),
        (&TABLE_III, &SUMMARY_III, 0.1), // 0.005 cm is 0.17 % of the small bowl's 3 cm
        (&TABLE_IV, &SUMMARY_IV, 0.02),
    ] {
        for (((object, ..), errors), printed) in table.iter().zip(setup_errors(table)).zip(summary) {
            assert_mean_sd(mean_and_sample_sd(&errors), *printed, tolerance, object);
        }
    }
}

#[test]
fn tables_of_raters_have_population_sd() {
    let overall = |table: &[Raters]| {
        let stats = ErrorStats::from_errors(&rater_errors(table)).unwrap();
        (stats.mean, stats.population_sd)
    };
    assert_mean_sd(overall(&TABLE_V), (-1.34, 9.20), 0.006, "V"); // printed: -7.89 +- 4.71, two signs wrong
    assert_mean_sd(overall(&TABLE_VI), (4.70, 11.56), 0.006, "VI");
}

/// Mean absolute errors of the plates by pitch band and by height: 55 degrees is best, and so is 50 cm, although the paper says
/// the opposite of the latter.
#[test]
fn plates_by_pitch_and_by_height() {
    let errors = setup_errors(&TABLE_II);
    let mean_absolute = |setups: [usize; 3]| {
        let chosen: Vec<f64> = errors.iter().flat_map(|object| setups.map(|i| object[i])).collect();
        format!("{:.2}", ErrorStats::from_errors(&chosen).unwrap().mean_absolute)
    };
    // Setups in the order of the rows: 20, 35, 50 cm, each near 40, 55, 70 degrees.
    assert_eq!(mean_absolute([0, 3, 6]), "3.88");
    assert_eq!(mean_absolute([1, 4, 7]), "2.71");
    assert_eq!(mean_absolute([2, 5, 8]), "6.28");
    assert_eq!(mean_absolute([0, 1, 2]), "5.02");
    assert_eq!(mean_absolute([3, 4, 5]), "5.19");
    assert_eq!(mean_absolute([6, 7, 8]), "2.65");
}
