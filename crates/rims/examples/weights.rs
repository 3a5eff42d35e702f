//! Fits a set of weights.toml anew, from files of cases that the examples `laid`, `squares` or `rings` wrote (docs/rims-evaluation.md).
//!
//! ```text
//! cargo run -p aim-batch-rims --example weights -- SET FILE.csv ... [--write YYYY-MM-DD]
//! ```
//!
//! Prints the numbers of today and the new ones with their standard errors. With --write the file gets the new ones and that date;
//! where the files are of other seeds than those of the set, correct `seeds` and `cases_from` in it.
//!
//! Logistic regression with a normal prior on each weight, by Newton's method with steps that are halved until the fit gets
//! better. The prior of round rims says what must hold whatever few hundred pictures show: more of a rim is better than less. The
//! others are only held from running away. The set `kind` has one number: the factor by which a logarithm of odds is too large is
//! one over its weight.

use std::error::Error;

use aim_batch_rims::{FEATURES, FittedSet, fitted_sets, weights_toml};
use nalgebra::{DMatrix, DVector};

type Vector = DVector<f64>;

/// A normal prior of a weight.
#[derive(Clone, Copy)]
struct Prior {
    mean: f64,
    sd: f64,
}

/// The priors of the weights of round rims, in the order of `Evidence::features`: mean and standard deviation.
const ROUND: [(f64, f64); FEATURES] = [
    (-17.0, 10.0),
    (12.0, 4.0),
    (1.2, 0.4),
    (3.0, 1.5),
    (-8.0, 3.0),
    (-8.0, 3.0),
    (-10.0, 4.0),
    (8.0, 4.0),
    (0.5, 0.5),
    (1.0, 1.0),
];
/// The prior of every other weight.
const WEAK: Prior = Prior { mean: 0.0, sd: 5.0 };
/// Newton's steps at most.
const STEPS: usize = 100;

/// A case: its features, and whether it is what is asked for.
type Case = (Vector, bool);

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments: Vec<String> = std::env::args().skip(1).collect();
    let date = arguments.iter().position(|argument| argument == "--write").map(|at| arguments.split_off(at));
    let (name, files) = arguments.split_first().ok_or("give the name of a set, and files of cases")?;
    let mut sets = fitted_sets();
    if name == "mistaken" {
        return Err("the set mistaken was chosen, not fitted: the example laid prints what it is judged by".into());
    }
    let known = sets.keys().cloned().collect::<Vec<_>>().join(", ");
    let set = sets.get_mut(name).ok_or_else(|| format!("'{name}' is no set of weights.toml, which has: {known}"))?;
    let cases = read(files, set.features.len())?;
    let priors: Vec<Prior> = if name == "round_confidence" {
        ROUND.iter().map(|&(mean, sd)| Prior { mean, sd }).collect()
    } else {
        vec![WEAK; set.features.len()]
    };
    let (weights, errors) = fitted(&cases, &priors);
    let number = |weight: f64| if name == "kind" { 1.0 / weight } else { weight };
    print(set, &cases, &weights, &errors, number);
    if let Some(date) = date {
        set.date = date.get(1).ok_or("--write needs the date, YYYY-MM-DD")?.clone();
        set.cases = cases.len();
        set.refit = "none since".to_owned();
        set.weights = weights.iter().map(|weight| (number(*weight) * 100.0).round() / 100.0).collect();
        let head: String =
            weights_toml().lines().take_while(|line| line.starts_with('#')).map(|l| format!("{l}\n")).collect();
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/weights.toml");
        std::fs::write(file, format!("{head}\n{}", toml::to_string(&sets)?))?;
    }
    Ok(())
}

#[expect(clippy::print_stdout, reason = "an example prints what it found")]
fn print(set: &FittedSet, cases: &[Case], weights: &Vector, errors: &Vector, number: impl Fn(f64) -> f64) {
    println!("{} cases, {} of them so", cases.len(), cases.iter().filter(|(_, is_so)| *is_so).count());
    println!("{:<14} {:>8} {:>8} {:>8}", "feature", "today", "new", "error");
    for (at, feature) in set.features.iter().enumerate() {
        let (today, new) = (set.weights[at], number(weights[at]));
        // The error of one over a weight, where that is the number.
        let error = errors[at] * (new / weights[at]).abs();
        println!("{feature:<14} {today:>8.2} {new:>8.2} {error:>8.2}");
    }
}

/// The cases of all files.
fn read(files: &[String], features: usize) -> Result<Vec<Case>, Box<dyn Error>> {
    let mut cases = Vec::new();
    for file in files {
        for line in std::fs::read_to_string(file)?.lines() {
            let case =
                parsed(line, features).ok_or_else(|| format!("{file}: not a case of {features} features: {line}"))?;
            cases.push(case);
        }
    }
    if cases.is_empty() { Err("no cases".into()) } else { Ok(cases) }
}

/// A line: picture, confidence, 1 where it is so, features.
fn parsed(line: &str, features: usize) -> Option<Case> {
    let fields: Vec<&str> = line.split(',').collect();
    let values: Vec<f64> = fields.get(3..)?.iter().filter_map(|field| field.parse().ok()).collect();
    (values.len() == features).then(|| (Vector::from_vec(values), fields[2] == "1"))
}

/// The weights, and their standard errors.
fn fitted(cases: &[Case], priors: &[Prior]) -> (Vector, Vector) {
    let mean = Vector::from_fn(priors.len(), |i, _| priors[i].mean);
    let precision = Vector::from_fn(priors.len(), |i, _| priors[i].sd.powi(-2));
    let mut weights = mean.clone();
    let mut errors = Vector::zeros(priors.len());
    for _ in 0..STEPS {
        let mut slope = precision.component_mul(&(&mean - &weights));
        let mut curvature = DMatrix::from_diagonal(&precision);
        for (features, is_so) in cases {
            let likely = 1.0 / (1.0 + (-features.dot(&weights)).exp());
            slope += features * (f64::from(u8::from(*is_so)) - likely);
            curvature += features * features.transpose() * (likely * (1.0 - likely));
        }
        let Some(inverse) = curvature.try_inverse() else { break };
        errors = inverse.diagonal().map(f64::sqrt);
        let mut step = inverse * slope;
        let before = cost(cases, &weights, &mean, &precision);
        while cost(cases, &(&weights + &step), &mean, &precision) > before && step.norm() > 1e-12 {
            step *= 0.5;
        }
        weights += step;
    }
    (weights, errors)
}

/// Minus the logarithm of how likely the cases and the weights are.
fn cost(cases: &[Case], weights: &Vector, mean: &Vector, precision: &Vector) -> f64 {
    let off = weights - mean;
    let misfit: f64 = cases
        .iter()
        .map(|(features, is_so)| {
            let score = if *is_so { features.dot(weights) } else { -features.dot(weights) };
            // ln(1 + exp(-score)), without overflow
            (-score).max(0.0) + (-score.abs()).exp().ln_1p()
        })
        .sum();
    misfit + 0.5 * off.component_mul(&off).dot(precision)
}
