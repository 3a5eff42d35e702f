//! The weights of the confidence of found rims, from files that the example `laid` wrote, or `squares` (docs/rims.md).
//!
//! ```text
//! cargo run -p aim-batch-rims --example confidence -- FILE.csv ...
//! ```
//!
//! Logistic regression with a normal prior on each weight, by Newton's method with steps that are halved until the fit gets
//! better. The prior says what must hold whatever few hundred pictures show: more of a rim is better than less.

use std::error::Error;

use aim_batch_rims::{FEATURES, SQUARE_FEATURES};
use nalgebra::{DMatrix, DVector};

type Vector = DVector<f64>;

/// Mean and standard deviation of the weights before any picture is seen, in the order of `Evidence::features`; those of
/// rectangles are only held from running away.
const PRIOR: [(f64, f64); FEATURES] = [
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
const OF_SQUARES: (f64, f64) = (0.0, 5.0);
const STEPS: usize = 100;

fn main() -> Result<(), Box<dyn Error>> {
    let mut rims = Vec::new();
    for file in std::env::args().skip(1) {
        for line in std::fs::read_to_string(&file)?.lines() {
            rims.push(parsed(line).ok_or_else(|| format!("{file}: not a line of the example laid: {line}"))?);
        }
    }
    let count = rims.first().ok_or("no rims")?.0.len();
    if rims.iter().any(|(features, _)| features.len() != count) {
        return Err("round rims and rectangles: each has weights of its own".into());
    }
    let prior = if count == FEATURES { PRIOR.to_vec() } else { vec![OF_SQUARES; count] };
    let weights = fitted(&rims, &prior);
    #[expect(clippy::print_stdout, reason = "an example prints what it found")]
    {
        println!("{} rims, {} right", rims.len(), rims.iter().filter(|(_, is_right)| *is_right).count());
        println!("{:?}", weights.iter().map(|weight| (weight * 100.0).round() / 100.0).collect::<Vec<_>>());
    }
    Ok(())
}

/// picture, confidence, right or not, features
fn parsed(line: &str) -> Option<(Vector, bool)> {
    let fields: Vec<&str> = line.split(',').collect();
    let features: Vec<f64> = fields.get(3..)?.iter().filter_map(|field| field.parse().ok()).collect();
    [FEATURES, SQUARE_FEATURES].contains(&features.len()).then(|| (Vector::from_vec(features), fields[2] == "1"))
}

fn fitted(rims: &[(Vector, bool)], prior: &[(f64, f64)]) -> Vector {
    let mean = Vector::from_fn(prior.len(), |i, _| prior[i].0);
    let precision = Vector::from_fn(prior.len(), |i, _| prior[i].1.powi(-2));
    let cost = |weights: &Vector| {
        let off = weights - &mean;
        let misfit: f64 = rims
            .iter()
            .map(|(features, is_right)| {
                let score = if *is_right { features.dot(weights) } else { -features.dot(weights) };
                // ln(1 + exp(-score)), without overflow
                (-score).max(0.0) + (-score.abs()).exp().ln_1p()
            })
            .sum();
        misfit + 0.5 * off.component_mul(&off).dot(&precision)
    };
    let mut weights = mean.clone();
    for _ in 0..STEPS {
        let mut slope = precision.component_mul(&(&mean - &weights));
        let mut curvature = DMatrix::from_diagonal(&precision);
        for (features, is_right) in rims {
            let likely = 1.0 / (1.0 + (-features.dot(&weights)).exp());
            slope += features * (f64::from(u8::from(*is_right)) - likely);
            curvature += features * features.transpose() * (likely * (1.0 - likely));
        }
        let Some(inverse) = curvature.try_inverse() else { break };
        let mut step = inverse * slope;
        let before = cost(&weights);
        while cost(&(&weights + &step)) > before && step.norm() > 1e-12 {
            step *= 0.5;
        }
        weights += step;
    }
    weights
}
