//! Several sizes of one thing into one, with what they have in common kept.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector, Vector3};

use crate::codes::coded_enum;
use crate::source::PerSource;
use crate::stats::{ErrorStats, median};
use crate::uncertainty::{InputSigma, Sensitivity, SizeSigma};

/// One size that goes into a fused one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Share {
    /// The size.
    pub value_mm: f64,
    /// What it changes by.
    pub sensitivity: Sensitivity,
    /// Uncertainties of its picture; what [`InputSigma::common`] gives is taken from the first share.
    pub inputs: InputSigma,
    /// Number of its picture: sizes of one picture share that picture's noise.
    pub picture: usize,
    /// At least 1: factor on its variance in the weights, for a picture of which there are doubts.
    pub penalty: f64,
}

coded_enum! {
    /// Whether sizes differ by no more than their uncertainties allow.
    Verdict {
        Consistent = "consistent": "the sizes differ by what their uncertainties allow",
        Inconsistent = "inconsistent": "chance would give such differences in fewer than 1 of 100 cases: a mark, a picture or a stated uncertainty is wrong",
    }
}

/// Chi-square of sizes about their generalised mean, all correlations counted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Consistency {
    /// Chi-square.
    pub chi_squared: f64,
    /// Degrees of freedom.
    pub degrees: usize,
    /// What it says.
    pub verdict: Verdict,
}

/// A fused size.
#[derive(Debug, Clone, PartialEq)]
pub struct Fused {
    /// The size.
    pub value_mm: f64,
    /// Its uncertainty.
    pub sigma: SizeSigma,
    /// Sample SD of what went in; none of a single one.
    pub spread_mm: Option<f64>,
    /// Weights, adding up to 1.
    pub weights: Vec<f64>,
    /// Numbers of the shares that lie too far off and count less.
    pub outliers: Vec<usize>,
    /// Whether they agree; none of a single one.
    pub consistency: Option<Consistency>,
}

/// Huber's constant: 95 % efficiency for Gaussian errors.
const HUBER: f64 = 1.345;
/// A share further off than this many standard uncertainties is an outlier.
const OUTLYING: f64 = 3.0;
/// Fewer do not tell which of them is off.
const FEWEST_TO_JUDGE: usize = 3;
/// Sums settle within a few steps; a step limit makes sure that they end.
const STEPS: usize = 50;
/// A robust SD, in median absolute deviations.
const ROBUST_SD: f64 = 1.4826;
/// More shares than this are fused without a consistency test, whose cost grows with the cube.
const MOST_TO_TEST: usize = 500;

/// Fuses sizes: weighted by inverse variance, robustly. A share off by more than [`HUBER`] of its own uncertainty about the
/// others counts less. None for no shares.
///
/// Errors from sources that the shares have in common pull them alike and do not average out: with weights w and derivatives
/// g the fused size has the derivatives sum w g, and its variance follows from those.
#[must_use]
pub fn fuse(shares: &[Share]) -> Option<Fused> {
    let covariance = shares.first()?.inputs.common();
    let base: Vec<f64> = shares
        .iter()
        .map(|share| (share.sensitivity.sigma(&share.inputs).total_mm.powi(2) * share.penalty).max(TINY).recip())
        .collect();
    let mut weights = normalised(&base);
    let mut value_mm = weighted_median(shares, &weights);
    let mut off = vec![0.0; shares.len()];
    if shares.len() >= FEWEST_TO_JUDGE {
        for _ in 0..STEPS {
            off = standardised(shares, &weights, value_mm, &covariance);
            let factors = off.iter().map(|t| if t.abs() > HUBER { HUBER / t.abs() } else { 1.0 });
            weights = normalised(&base.iter().zip(factors).map(|(w, f)| w * f).collect::<Vec<_>>());
            let next = weighted_mean(shares, &weights);
            let settled = (next - value_mm).abs() <= 1e-12 * next.abs();
            value_mm = next;
            if settled {
                break;
            }
        }
    } else {
        value_mm = weighted_mean(shares, &weights);
    }
    let outliers = (0..shares.len()).filter(|&i| off[i].abs() > OUTLYING).collect();
    let values: Vec<f64> = shares.iter().map(|share| share.value_mm).collect();
    let terms = shares.iter().zip(&weights).map(|(s, w)| (*w, &s.sensitivity, &s.inputs, s.picture));
    Some(Fused {
        value_mm,
        sigma: combined(terms),
        spread_mm: ErrorStats::from_errors(&values).and_then(|stats| stats.sample_sd),
        weights,
        outliers,
        consistency: consistency(shares),
    })
}

/// Smaller variances are nothing, in mm^2.
const TINY: f64 = 1e-18;

/// Uncertainty of a weighted sum of sizes: each term is weight, derivatives, inputs and number of its picture. What pictures
/// have in common is taken from the first term.
pub(crate) fn combined<'a>(
    terms: impl IntoIterator<Item = (f64, &'a Sensitivity, &'a InputSigma, usize)>,
) -> SizeSigma {
    let mut by_source = PerSource::zeros();
    let mut by_picture: BTreeMap<usize, (Vector3<f64>, Vector3<f64>)> = BTreeMap::new();
    let mut marks_variance = 0.0;
    let mut covariance = None;
    for (weight, sensitivity, inputs, picture) in terms {
        covariance.get_or_insert_with(|| inputs.common());
        by_source += sensitivity.by_source * weight;
        by_picture.entry(picture).or_insert((Vector3::zeros(), inputs.noise())).0 += sensitivity.by_noise() * weight;
        marks_variance += (weight * sensitivity.marks_mm_per_px * inputs.mark_px).powi(2);
    }
    let noise = by_picture.values().map(|(by, variance)| by.map(|d| d * d).component_mul(variance)).sum();
    SizeSigma::of_parts(&by_source, &covariance.unwrap_or_default(), noise, marks_variance.sqrt())
}

fn normalised(weights: &[f64]) -> Vec<f64> {
    let sum: f64 = weights.iter().sum();
    weights.iter().map(|w| w / sum).collect()
}

fn weighted_mean(shares: &[Share], weights: &[f64]) -> f64 {
    shares.iter().zip(weights).map(|(share, w)| share.value_mm * w).sum()
}

fn weighted_median(shares: &[Share], weights: &[f64]) -> f64 {
    let mut order: Vec<usize> = (0..shares.len()).collect();
    order.sort_by(|&a, &b| shares[a].value_mm.total_cmp(&shares[b].value_mm));
    let mut below = 0.0;
    for &i in &order {
        below += weights[i];
        if below >= 0.5 {
            return shares[i].value_mm;
        }
    }
    order.last().map_or(f64::NAN, |&i| shares[i].value_mm)
}

/// How far every share is off, in its standard uncertainties about the others: what they have in common counts only as far as
/// it moves them differently. Where the whole lot scatters more than stated, the unit is that scatter.
fn standardised(
    shares: &[Share],
    weights: &[f64],
    value_mm: f64,
    covariance: &crate::source::SourceCovariance,
) -> Vec<f64> {
    let mean: PerSource = shares.iter().zip(weights).map(|(share, w)| share.sensitivity.by_source * *w).sum();
    let off: Vec<f64> = shares
        .iter()
        .map(|share| {
            let differs = share.sensitivity.by_source - mean;
            let own = own_variance(share) * share.penalty + (covariance * differs).dot(&differs);
            (share.value_mm - value_mm) / own.max(TINY).sqrt()
        })
        .collect();
    let scale = (ROBUST_SD * median(off.iter().map(|t| t.abs()).collect())).max(1.0);
    off.into_iter().map(|t| t / scale).collect()
}

/// Variance of what a share has of its own: its picture's noise and its marks.
fn own_variance(share: &Share) -> f64 {
    let noise = share.sensitivity.by_noise().map(|d| d * d).dot(&share.inputs.noise());
    noise + (share.sensitivity.marks_mm_per_px * share.inputs.mark_px).powi(2)
}

fn consistency(shares: &[Share]) -> Option<Consistency> {
    if !(2..=MOST_TO_TEST).contains(&shares.len()) {
        return None;
    }
    let common = shares[0].inputs.common();
    let covariance = DMatrix::from_fn(shares.len(), shares.len(), |i, j| {
        let (a, b) = (&shares[i], &shares[j]);
        let mut sum = (common * b.sensitivity.by_source).dot(&a.sensitivity.by_source);
        if i == j {
            sum += own_variance(a);
        } else if a.picture == b.picture {
            sum += a.sensitivity.by_noise().component_mul(&b.sensitivity.by_noise()).dot(&a.inputs.noise());
        }
        sum
    });
    let factor = covariance.cholesky()?;
    let ones = DVector::from_element(shares.len(), 1.0);
    let values = DVector::from_iterator(shares.len(), shares.iter().map(|share| share.value_mm));
    let weights = factor.solve(&ones);
    let off = &values - &ones * (weights.dot(&values) / weights.sum());
    let chi_squared = off.dot(&factor.solve(&off));
    let degrees = shares.len() - 1;
    let verdict =
        if normal_score(chi_squared, degrees) > ONE_PER_CENT { Verdict::Inconsistent } else { Verdict::Consistent };
    chi_squared.is_finite().then_some(Consistency { chi_squared, degrees, verdict })
}

/// A Gaussian number exceeds this in 1 of 100 cases.
const ONE_PER_CENT: f64 = 2.326_347_9;

/// Wilson and Hilferty (PNAS 1931): the cube root of chi-square over its degrees of freedom is nearly Gaussian. At 1 % the
/// chi-square limits are right to 2 % for one degree of freedom and to 0.3 % for three or more.
fn normal_score(chi_squared: f64, degrees: usize) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "a count of sizes is far below 2^53")]
    let spread = 2.0 / (9.0 * degrees as f64);
    #[expect(clippy::cast_precision_loss, reason = "a count of sizes is far below 2^53")]
    let root = (chi_squared / degrees as f64).cbrt();
    (root - (1.0 - spread)) / spread.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Tables of the chi-square distribution, upper 1 %.
    #[test]
    fn limits_of_one_per_cent() {
        for (degrees, limit, tolerance) in [(1, 6.635, 0.02), (3, 11.345, 0.003), (10, 23.209, 0.003)] {
            assert!(normal_score(limit * (1.0 + tolerance), degrees) > ONE_PER_CENT, "{degrees}");
            assert!(normal_score(limit * (1.0 - tolerance), degrees) < ONE_PER_CENT, "{degrees}");
        }
    }
}
