//! The least-squares fit behind a calibration.

use std::collections::BTreeMap;

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::storage::Owned;
use nalgebra::{DMatrix, DVector, Dyn};

use super::bench_size::BenchSize;
use super::correction::Correction;
use super::{CorrectionError, prior_sd};
use crate::sigma::{InputSigma, LEARNED};
use crate::stats::{ROBUST_SD, median};

/// The solution of a fit.
pub(super) struct Solution {
    pub correction: Correction,
    /// The covariance of the free parameters; not finite where the data do not determine them.
    pub covariance: DMatrix<f64>,
}

/// Huber's constant, in robust SDs.
const HUBER: f64 = 1.7;
/// Number of fits, each with weights from the residuals of the one before.
const REWEIGHTINGS: usize = 10;
/// Where the sizes do not determine a direction, a fence of this many prior SDs keeps the search among poses that exist. It
/// moves a parameter that is better determined than beforehand by less than a hundredth of its SD, and does not count for SDs.
const FENCE: f64 = 10.0;

/// The robust fit of the free parameters, given by their numbers; the others stay at zero.
///
/// # Errors
/// [`CorrectionError::Unmeasurable`] when a size cannot be measured under some correction.
pub(super) fn solve(sizes: &[&BenchSize], free: &[usize], prior: &InputSigma) -> Result<Solution, CorrectionError> {
    let start = Correction::default();
    let own: Option<Vec<f64>> = sizes.iter().map(|size| Some(size.predicted(&start)?.own_sd.recip())).collect();
    let own = own.ok_or(CorrectionError::Unmeasurable)?;
    let mut weights = DVector::from_vec(own.clone());
    let mut parameters = DVector::zeros(free.len());
    if free.is_empty() {
        return Ok(Solution { correction: start, covariance: DMatrix::zeros(0, 0) });
    }
    let fence =
        DVector::from_iterator(free.len(), free.iter().map(|&i| UNITS[i] / (FENCE * prior_sd(prior, LEARNED[i]))));
    let mut problem =
        LogSizes { sizes, free, fence: fence.clone(), weights: weights.clone(), parameters: parameters.clone() };
    for _ in 0..REWEIGHTINGS {
        problem = LogSizes { sizes, free, fence: fence.clone(), weights: weights.clone(), parameters };
        let (solved, _) = LevenbergMarquardt::new().minimize(problem);
        problem = solved;
        parameters = problem.parameters.clone();
        let off = problem.unweighted().ok_or(CorrectionError::Unmeasurable)?;
        let standardised: Vec<f64> = off.iter().zip(&own).map(|(r, w)| (r * w).abs()).collect();
        let limit = HUBER * (ROBUST_SD * median(standardised.clone())).max(f64::MIN_POSITIVE);
        let factor = |t: f64| if t > limit { (limit / t).sqrt() } else { 1.0 };
        weights = DVector::from_iterator(own.len(), own.iter().zip(&standardised).map(|(w, t)| w * factor(*t)));
    }
    problem.weights = weights;
    Ok(Solution { correction: problem.correction(), covariance: problem.covariance() })
}

/// The least-squares problem whose residuals are the weighted logarithms of predicted over true sizes, and the fence.
struct LogSizes<'a> {
    sizes: &'a [&'a BenchSize],
    free: &'a [usize],
    /// The weight of each parameter's own departure from zero.
    fence: DVector<f64>,
    weights: DVector<f64>,
    parameters: DVector<f64>,
}

impl LogSizes<'_> {
    /// The correction with the current parameters.
    fn correction(&self) -> Correction {
        let mut values = [0.0; 4];
        for (row, &i) in self.free.iter().enumerate() {
            values[i] = self.parameters[row] * UNITS[i];
        }
        Correction::from_values(&values)
    }

    /// The logarithms of predicted over true sizes, without weights; `None` where a size cannot be measured.
    fn unweighted(&self) -> Option<Vec<f64>> {
        let correction = self.correction();
        self.sizes.iter().map(|size| Some(size.predicted(&correction)?.log_ratio)).collect()
    }

    /// The covariance of the free parameters; not finite where J'J is singular. It follows from the stated errors of marks and
    /// pictures, or from the scatter of the sizes where that is larger. An SD is raised where errors that the sizes of a setup
    /// share make it larger: they give the covariance (J'J)^-1 (sum of s s') (J'J)^-1, with the scores s of a setup, times the
    /// usual factor for few setups.
    fn covariance(&self) -> DMatrix<f64> {
        let n = self.free.len();
        let unknown = || DMatrix::from_element(n, n, f64::INFINITY);
        let (Some(jacobian), Some(residuals)) = (self.jacobian(), self.residuals()) else { return unknown() };
        let (jacobian, residuals) = (jacobian.rows(0, self.sizes.len()), residuals.rows(0, self.sizes.len()));
        let normal = jacobian.tr_mul(&jacobian);
        let eigenvalues = normal.symmetric_eigenvalues();
        if eigenvalues.min() <= 1e-10 * eigenvalues.max() {
            return unknown();
        }
        let Some(inverse) = normal.try_inverse() else { return unknown() };
        let mut scores: BTreeMap<&str, DVector<f64>> = BTreeMap::new();
        for (i, size) in self.sizes.iter().enumerate() {
            let score = jacobian.row(i).transpose() * residuals[i];
            *scores.entry(&size.setup).or_insert_with(|| DVector::zeros(n)) += score;
        }
        #[expect(clippy::cast_precision_loss, reason = "a count of setups is far below 2^53")]
        let (setups, free) = (scores.len() as f64, n as f64);
        // With no more setups than parameters, nothing shows the scatter of the setups.
        if setups <= free {
            return unknown();
        }
        let mut meat = DMatrix::zeros(n, n);
        scores.values().for_each(|s| meat += s * s.transpose());
        let shared = &inverse * meat * &inverse * (setups / (setups - free));
        let scatter = ROBUST_SD * median(residuals.iter().map(|r| r.abs()).collect());
        let stated = &inverse * scatter.max(1.0).powi(2);
        // A sandwich over few setups may be far too small by chance, so no SD is smaller than the marks alone make it.
        let larger = |i: usize| (shared[(i, i)] / stated[(i, i)]).sqrt().max(1.0) * UNITS[self.free[i]];
        DMatrix::from_fn(n, n, |i, j| stated[(i, j)] * larger(i) * larger(j))
    }
}

/// The units in which parameters are fitted, so that a step of 1 has about the same effect for each.
const UNITS: [f64; 4] = [0.02, 0.03, 5.0, 0.01];

impl LeastSquaresProblem<f64, Dyn, Dyn> for LogSizes<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, parameters: &DVector<f64>) {
        self.parameters.copy_from(parameters);
    }

    fn params(&self) -> DVector<f64> {
        self.parameters.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let sizes = DVector::from_vec(self.unweighted()?).component_mul(&self.weights);
        let fence = self.parameters.component_mul(&self.fence);
        Some(DVector::from_iterator(sizes.len() + fence.len(), sizes.iter().chain(&fence).copied()))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let correction = self.correction();
        let mut jacobian = DMatrix::zeros(self.sizes.len() + self.free.len(), self.free.len());
        jacobian.view_mut((self.sizes.len(), 0), (self.free.len(), self.free.len())).set_diagonal(&self.fence);
        for (row, size) in self.sizes.iter().enumerate() {
            let predicted = size.predicted(&correction)?;
            for (column, &i) in self.free.iter().enumerate() {
                jacobian[(row, column)] = predicted.by_parameter[i] * UNITS[i] * self.weights[row];
            }
        }
        Some(jacobian)
    }
}
