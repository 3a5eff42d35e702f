//! The fusion of several sizes of one thing into one, which keeps the errors that they have in common.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector, Vector3};

use crate::codes::coded_enum;
use crate::source::PerSource;
use crate::stats::{ErrorStats, ROBUST_SD, median};
use crate::uncertainty::{InputSigma, Sensitivity, SizeSigma};

/// One size that goes into a fused one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Share {
    /// The size.
    pub value_mm: f64,
    /// The derivatives of the size.
    pub sensitivity: Sensitivity,
    /// The uncertainties of its picture's inputs. The part of [`InputSigma::common`] is taken from the first share.
    pub inputs: InputSigma,
    /// The number of its picture: sizes of one picture share that picture's noise.
    pub picture: usize,
    /// The factor by which a doubtful picture raises the variance behind the weight; at least 1.
    pub penalty: f64,
}

coded_enum! {
    /// Whether sizes differ by no more than their uncertainties allow.
    Verdict {
        Consistent = "consistent": "the sizes differ by what their uncertainties allow",
        Inconsistent = "inconsistent": "chance would give such differences in fewer than 1 of 100 cases: a mark, a picture or a stated uncertainty is wrong",
    }
}

/// The test whether sizes agree: chi-square about their generalised mean, with all correlations counted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Consistency {
    /// The value of chi-square.
    pub chi_squared: f64,
    /// The degrees of freedom: one less than the number of sizes.
    pub degrees: usize,
    /// The result of the test, at the 1 % level.
    pub verdict: Verdict,
}

/// A fused size.
#[derive(Debug, Clone, PartialEq)]
pub struct Fused {
    /// The size.
    pub value_mm: f64,
    /// Its standard uncertainty.
    pub sigma: SizeSigma,
    /// Sample SD of the sizes that were fused; `None` for a single one.
    pub spread_mm: Option<f64>,
    /// The weights of the shares, which add up to 1.
    pub weights: Vec<f64>,
    /// The numbers of the shares that lie too far off and count less.
    pub outliers: Vec<usize>,
    /// Whether the sizes agree; `None` for a single size, and for too many to test.
    pub consistency: Option<Consistency>,
}

/// Huber's constant: 95 % efficiency for Gaussian errors.
const HUBER: f64 = 1.345;
/// A share further off than this many standard uncertainties is an outlier.
const OUTLYING: f64 = 3.0;
/// With fewer shares than this nobody can say which of them is off.
const FEWEST_TO_JUDGE: usize = 3;
/// Bound of the reweighting steps. The sums settle within a few.
const STEPS: usize = 50;
/// More shares than this are fused without a consistency test, whose cost grows with the cube.
const MOST_TO_TEST: usize = 500;

/// The robust mean of sizes, weighted by their inverse variances; `None` when there are no shares. A share that is off from
/// the others by more than `HUBER` of its own uncertainties counts less.
///
/// Errors from sources that the shares have in common move them alike and do not average out: with weights w and derivatives
/// g the fused size has the derivatives sum(w g), and its variance follows from those.
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
            off = standardised_residuals(shares, &weights, value_mm, &covariance);
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
        sigma: combined_sigma(terms),
        spread_mm: ErrorStats::from_errors(&values).and_then(|stats| stats.sample_sd),
        weights,
        outliers,
        consistency: consistency(shares),
    })
}

/// Smaller variances than this count as this, in mm^2.
const TINY: f64 = 1e-18;

/// The uncertainty of a weighted sum of sizes. Each term is a weight, the derivatives of a size, the inputs of its picture and
/// the number of that picture. The covariance that pictures have in common is taken from the first term.
pub(crate) fn combined_sigma<'a>(
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
    SizeSigma::from_parts(&by_source, &covariance.unwrap_or_default(), noise, marks_variance.sqrt())
}

/// The weights, scaled to add up to 1.
fn normalised(weights: &[f64]) -> Vec<f64> {
    let sum: f64 = weights.iter().sum();
    weights.iter().map(|w| w / sum).collect()
}

fn weighted_mean(shares: &[Share], weights: &[f64]) -> f64 {
    shares.iter().zip(weights).map(|(share, w)| share.value_mm * w).sum()
}

/// The smallest size below or at which at least half of the weight lies.
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

/// How far each share is off from the others, in its own standard uncertainties. Sources that they have in common count only as
/// far as they move the shares differently. Where all shares scatter more than stated, the unit is that scatter.
fn standardised_residuals(
    shares: &[Share],
    weights: &[f64],
    value_mm: f64,
    covariance: &crate::source::SourceCovariance,
) -> Vec<f64> {
    let mean: PerSource = shares.iter().zip(weights).map(|(share, w)| share.sensitivity.by_source * *w).sum();
    let off: Vec<f64> = shares
        .iter()
        .map(|share| {
            let difference = share.sensitivity.by_source - mean;
            let own = own_variance(share) * share.penalty + (covariance * difference).dot(&difference);
            (share.value_mm - value_mm) / own.max(TINY).sqrt()
        })
        .collect();
    let scale = (ROBUST_SD * median(off.iter().map(|t| t.abs()).collect())).max(1.0);
    off.into_iter().map(|t| t / scale).collect()
}

/// The variance that a share does not have in common with other pictures: that of its picture's noise and of its marks.
fn own_variance(share: &Share) -> f64 {
    let noise = share.sensitivity.by_noise().map(|d| d * d).dot(&share.inputs.noise());
    noise + (share.sensitivity.marks_mm_per_px * share.inputs.mark_px).powi(2)
}

/// The test of agreement; `None` for fewer than 2 or more than [`MOST_TO_TEST`] shares, or where it has no finite value.
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

/// A number of a standard normal distribution exceeds this in 1 of 100 cases.
const ONE_PER_CENT: f64 = 2.326_347_9;

/// The number of a standard normal distribution that is exceeded as seldom as this chi-square, by Wilson and Hilferty (PNAS
/// 1931): the cube root of chi-square over its degrees of freedom is nearly Gaussian. At 1 % the limits of chi-square are right to 2 % for one degree of freedom
/// and to 0.3 % for three or more.
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

    /// The limits are those in tables of the chi-square distribution, upper 1 %.
    #[test]
    fn limits_of_one_per_cent() {
        for (degrees, limit, tolerance) in [(1, 6.635, 0.02), (3, 11.345, 0.003), (10, 23.209, 0.003)] {
            assert!(normal_score(limit * (1.0 + tolerance), degrees) > ONE_PER_CENT, "{degrees}");
            assert!(normal_score(limit * (1.0 - tolerance), degrees) < ONE_PER_CENT, "{degrees}");
        }
    }
}
