//! The fusion of several sizes of one thing into one, which keeps the errors that they have in common.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector, Vector3};

use crate::codes::coded_enum;
use crate::sigma::{InputSigma, Sensitivity, SizeSigma, proportion};
use crate::source::{PerSource, SourceCovariance};
use crate::stats::{ErrorStats, ROBUST_SD, median};

/// The part of a size that comes from one picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Part {
    /// The derivatives of the size through this picture.
    pub sensitivity: Sensitivity,
    /// The uncertainties of the picture's inputs. [`InputSigma::common`] must be the same for all pictures that are fused; it is
    /// taken from the first one.
    pub inputs: InputSigma,
    /// The number of the picture: sizes of one picture share that picture's noise.
    pub picture: usize,
}

impl Part {
    /// This part in a size that is `factor` times as large through it.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        Self { sensitivity: self.sensitivity.scaled(factor), ..self }
    }
}

/// One size that goes into a fused one: that of one picture, or one that was fused from several pictures.
#[derive(Debug, Clone, PartialEq)]
pub struct Share {
    /// The size.
    pub value_mm: f64,
    /// Its parts from each picture.
    pub parts: Vec<Part>,
    /// Its uncertainty from the disagreement of what it was itself fused from; 0 for the size of a single picture.
    pub disagreement_mm: f64,
    /// The factor by which a doubtful picture raises the variance behind the weight; at least 1.
    pub penalty: f64,
}

impl Share {
    /// The share of a size that was measured on one picture.
    #[must_use]
    pub fn of_picture(value_mm: f64, part: Part, penalty: f64) -> Self {
        Self { value_mm, parts: vec![part], disagreement_mm: 0.0, penalty }
    }

    /// This share with the uncertainty that it would have if the size were `size_mm`. Errors of pose, range and camera
    /// move a size in proportion to it, those of marks do not. Otherwise a size that is too small would look
    /// surer than the others, only because it is small.
    fn carried_to(&self, size_mm: f64) -> Self {
        let factor = proportion(self.value_mm, size_mm);
        let carried = |part: &Part| {
            let Sensitivity { by_source, marks_mm_per_px } = part.sensitivity;
            Part { sensitivity: Sensitivity { by_source: by_source * factor, marks_mm_per_px }, ..*part }
        };
        Self { parts: self.parts.iter().map(carried).collect(), ..self.clone() }
    }

    fn sigma(&self) -> SizeSigma {
        combined_sigma(&self.parts).with_disagreement(self.disagreement_mm)
    }

    /// The derivatives by the sources that all pictures have in common.
    fn by_source(&self) -> PerSource {
        self.parts.iter().map(|part| part.sensitivity.by_source).sum()
    }

    /// The variance that this share does not have in common with others: of its pictures' noise, its marks, and its own
    /// disagreement.
    fn own_variance(&self) -> f64 {
        let noise: f64 =
            noise_by_picture(&self.parts).values().map(|(by, variance)| (by.component_mul(by)).dot(variance)).sum();
        noise + marks_variance(&self.parts) + self.disagreement_mm.powi(2)
    }
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
    /// The numbers of the shares that lie too far off and count less or not at all.
    pub outliers: Vec<usize>,
    /// Whether the sizes agree; `None` for a single size, and for too many to test.
    pub consistency: Option<Consistency>,
}

/// Huber's constant: 95 % efficiency for Gaussian errors.
const HUBER: f64 = 1.345;
/// The constant of Tukey's bisquare: likewise 95 % efficiency. What is further off than this has no weight.
const BISQUARE: f64 = 4.685;
/// A share further off than this many standard uncertainties is an outlier.
const OUTLYING: f64 = 3.0;
/// With fewer shares than this nobody can say which of them is off.
const FEWEST_TO_JUDGE: usize = 3;
/// Bound of the reweighting steps. The sums settle within a few.
const STEPS: usize = 50;
/// More shares than this are fused without a consistency test, whose cost grows with the cube.
const MOST_TO_TEST: usize = 500;

/// The robust mean of sizes, weighted by their inverse variances; `None` when there are no shares. It lies within the range of
/// the sizes. One absurd size among three or more hardly moves it.
///
/// The variances are those that the sizes would have if all of them were as large as their median, since a small size is not
/// surer for being small. From the middle of the shortest half, Huber's weights lead to a start and Tukey's to the result (an
/// MM-estimate, Yohai, Ann. Stat. 1987), which gives no weight to what is far off. Errors from sources that the shares have in common move
/// them alike and do not average out: with weights w and derivatives g the fused size has the derivatives sum(w g), and its
/// variance follows from those. Where the sizes differ by more than their uncertainties allow, the scatter of those with weight
/// is a part of the uncertainty.
#[must_use]
pub fn fuse(shares: &[Share]) -> Option<Fused> {
    let values: Vec<f64> = shares.iter().map(|share| share.value_mm).collect();
    let (smallest, largest) = (values.iter().copied().reduce(f64::min)?, values.iter().copied().reduce(f64::max)?);
    let middle_mm = median(values.clone());
    let alike: Vec<Share> = shares.iter().map(|share| share.carried_to(middle_mm)).collect();
    let (weights, off) = robust_weights(&alike);
    let value_mm = weighted_mean(shares, &weights).clamp(smallest, largest);
    let outliers: Vec<usize> = (0..shares.len()).filter(|&i| off[i].abs() > OUTLYING).collect();
    let consistency = consistency(&alike);
    let disagrees = !outliers.is_empty()
        || shares.len() > MOST_TO_TEST
        || consistency.is_some_and(|c| c.verdict == Verdict::Inconsistent);
    let sigma = combined_sigma(&parts_of_sum(shares, &weights));
    let inherited = shares.iter().zip(&weights).map(|(s, w)| (w * s.disagreement_mm).powi(2)).sum::<f64>();
    let unexplained = if disagrees { unexplained_variance(&alike, &weights, value_mm) } else { 0.0 };
    Some(Fused {
        value_mm,
        sigma: sigma.with_disagreement((inherited + unexplained).sqrt()),
        spread_mm: ErrorStats::from_errors(&values).and_then(|stats| stats.sample_sd),
        weights,
        outliers,
        consistency,
    })
}

/// The weights of the shares, which add up to 1, and how far each is off from the others: in its own standard uncertainties, or in
/// the scatter of all where that is larger than stated.
fn robust_weights(shares: &[Share]) -> (Vec<f64>, Vec<f64>) {
    let variance = |share: &Share| (share.sigma().total_mm.powi(2) * share.penalty).max(TINY);
    let base: Vec<f64> = shares.iter().map(|share| variance(share).recip()).collect();
    let mut weights = normalised(&base);
    let mut off = vec![0.0; shares.len()];
    if shares.len() < FEWEST_TO_JUDGE {
        return (weights, off);
    }
    let covariance = common_of(shares);
    let mut value_mm = middle_of_shortest_half(shares.iter().map(|share| share.value_mm).collect());
    // The scatter about the start is the unit of all steps: one that followed the steps would grow with what is far off.
    let at_start = standardised_residuals(shares, &weights, value_mm, &covariance);
    let scale = (ROBUST_SD * median(at_start.iter().map(|t| t.abs()).collect())).max(1.0);
    for factor in [huber, bisquare] {
        for _ in 0..STEPS {
            off = standardised_residuals(shares, &weights, value_mm, &covariance);
            off.iter_mut().for_each(|t| *t /= scale);
            let reweighted: Vec<f64> = base.iter().zip(&off).map(|(w, t)| w * factor(t.abs())).collect();
            // Between two groups of sizes all may be far off; then the start stands.
            if reweighted.iter().sum::<f64>() <= 0.0 {
                break;
            }
            weights = normalised(&reweighted);
            let next = weighted_mean(shares, &weights);
            let settled = (next - value_mm).abs() <= 1e-12 * next.abs();
            value_mm = next;
            if settled {
                break;
            }
        }
    }
    (weights, off)
}

/// The middle of the shortest interval that holds more than half of the values; the mean of the middles where several are
/// equally short. It stays with the others when any one of three or more values is absurd.
fn middle_of_shortest_half(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let half = values.len() / 2 + 1;
    let length = |window: &[f64]| window[half - 1] - window[0];
    let shortest = values.windows(half).map(length).fold(f64::INFINITY, f64::min);
    let equally_short = values.windows(half).filter(|window| length(window) <= shortest * (1.0 + 1e-9));
    let middles: Vec<f64> = equally_short.map(|window| 0.5 * (window[0] + window[half - 1])).collect();
    ErrorStats::from_errors(&middles).map_or(f64::NAN, |stats| stats.mean)
}

/// Huber's weight of what is off by `t` of its own uncertainties.
fn huber(t: f64) -> f64 {
    if t > HUBER { HUBER / t } else { 1.0 }
}

/// Tukey's weight likewise.
fn bisquare(t: f64) -> f64 {
    (1.0 - (t / BISQUARE).powi(2)).max(0.0).powi(2)
}

/// The part of the variance of a weighted mean that its shares' own uncertainties do not explain: the variance by the scatter of
/// the shares about the mean, less the stated one.
fn unexplained_variance(shares: &[Share], weights: &[f64], value_mm: f64) -> f64 {
    let squares = weights.iter().map(|w| w * w).sum::<f64>();
    if squares >= 1.0 {
        return 0.0;
    }
    let scatter: f64 = shares.iter().zip(weights).map(|(s, w)| (w * (s.value_mm - value_mm)).powi(2)).sum();
    let stated: f64 = shares.iter().zip(weights).map(|(s, w)| w * w * s.own_variance()).sum();
    (scatter / (1.0 - squares) - stated).max(0.0)
}

/// Smaller variances than this count as this, in mm^2.
const TINY: f64 = 1e-18;

/// The parts of the sum of shares, each times its weight.
#[must_use]
pub fn parts_of_sum(shares: &[Share], weights: &[f64]) -> Vec<Part> {
    let weighted = |(share, w): (&Share, &f64)| share.parts.iter().map(|part| part.scaled(*w)).collect::<Vec<_>>();
    shares.iter().zip(weights).flat_map(weighted).collect()
}

/// The uncertainty of a size with these parts.
#[must_use]
pub fn combined_sigma(parts: &[Part]) -> SizeSigma {
    let by_source: PerSource = parts.iter().map(|part| part.sensitivity.by_source).sum();
    let covariance = parts.first().map(|part| part.inputs.common()).unwrap_or_default();
    let noise =
        noise_by_picture(parts).values().map(|(by, variance)| by.component_mul(by).component_mul(variance)).sum();
    SizeSigma::from_parts(&by_source, &covariance, noise, marks_variance(parts).sqrt())
}

/// The derivatives of a size by pitch, tilt and range offset through each picture, and the variances of their noise.
type NoiseByPicture = BTreeMap<usize, (Vector3<f64>, Vector3<f64>)>;

fn noise_by_picture(parts: &[Part]) -> NoiseByPicture {
    let mut by_picture = NoiseByPicture::new();
    for part in parts {
        by_picture.entry(part.picture).or_insert((Vector3::zeros(), part.inputs.noise())).0 +=
            part.sensitivity.by_noise();
    }
    by_picture
}

fn marks_variance(parts: &[Part]) -> f64 {
    parts.iter().map(|part| (part.sensitivity.marks_mm_per_px * part.inputs.mark_px).powi(2)).sum()
}

/// The covariance of the sources that all pictures share.
fn common_of(shares: &[Share]) -> SourceCovariance {
    shares.iter().flat_map(|share| &share.parts).next().map(|part| part.inputs.common()).unwrap_or_default()
}

/// The weights, scaled to add up to 1.
fn normalised(weights: &[f64]) -> Vec<f64> {
    let sum: f64 = weights.iter().sum();
    weights.iter().map(|w| w / sum).collect()
}

fn weighted_mean(shares: &[Share], weights: &[f64]) -> f64 {
    shares.iter().zip(weights).map(|(share, w)| share.value_mm * w).sum()
}

/// How far each share is off from the others, in its own standard uncertainties. Sources that they have in common count only as
/// far as they move the shares differently.
fn standardised_residuals(shares: &[Share], weights: &[f64], value_mm: f64, covariance: &SourceCovariance) -> Vec<f64> {
    let mean: PerSource = shares.iter().zip(weights).map(|(share, w)| share.by_source() * *w).sum();
    let residual = |share: &Share| {
        let difference = share.by_source() - mean;
        let own = share.own_variance() * share.penalty + (covariance * difference).dot(&difference);
        (share.value_mm - value_mm) / own.max(TINY).sqrt()
    };
    shares.iter().map(residual).collect()
}

/// The test of agreement; `None` for fewer than 2 or more than [`MOST_TO_TEST`] shares, or where it has no finite value.
fn consistency(shares: &[Share]) -> Option<Consistency> {
    if !(2..=MOST_TO_TEST).contains(&shares.len()) {
        return None;
    }
    let common = common_of(shares);
    let by_source: Vec<PerSource> = shares.iter().map(Share::by_source).collect();
    let noise: Vec<_> = shares.iter().map(|share| noise_by_picture(&share.parts)).collect();
    let covariance = DMatrix::from_fn(shares.len(), shares.len(), |i, j| {
        let own = if i == j { shares[i].own_variance() } else { shared_noise(&noise[i], &noise[j]) };
        (common * by_source[j]).dot(&by_source[i]) + own
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

/// The covariance of two sizes through the noise of the pictures that both were measured on.
fn shared_noise(a: &NoiseByPicture, b: &NoiseByPicture) -> f64 {
    let both = a.iter().filter_map(|(picture, (by_a, variance))| Some((by_a, b.get(picture)?.0, variance)));
    both.map(|(by_a, by_b, variance)| by_a.component_mul(&by_b).dot(variance)).sum()
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
