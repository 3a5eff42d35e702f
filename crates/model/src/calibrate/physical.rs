//! What mount, range sensor and focal length are off by, from sizes that are known.

use std::collections::{BTreeMap, BTreeSet};

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::storage::Owned;
use nalgebra::{DMatrix, DVector, Dyn, Matrix4, Rotation3, Vector3};

use super::held_out::{HeldOut, leave_one_out};
use crate::camera::Camera;
use crate::container::{Method, Quantity};
use crate::marks::ObjectMarks;
use crate::measure::Container;
use crate::pose::Pose;
use crate::source::Source;
use crate::stats::median;
use crate::uncertainty::{Estimate, InputSigma, LEARNED, estimate};
use crate::view::View;

/// Corrections of readings. All zero: none.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Correction {
    /// Added to the angle of the camera on the device. It holds what the accelerometer's pitch is off by, too: a bench cannot
    /// tell the two apart, and nothing needs to.
    pub mount_rad: f64,
    /// true range = reading (1 + this) + [`Self::range_offset_mm`].
    pub range_scale: f64,
    /// See there.
    pub range_offset_mm: f64,
    /// True focal length = the camera's (1 + this).
    pub focal_share: f64,
}

impl Correction {
    /// The view as it is after the correction. None where no such pose or camera exists.
    #[must_use]
    pub fn apply(&self, view: &View) -> Option<View> {
        let (pose, camera) = (view.pose(), view.camera());
        let turn = Rotation3::from_axis_angle(&Vector3::x_axis(), self.mount_rad);
        let (pitch_rad, roll_rad) = Pose::pitch_roll_of_down(&(turn * pose.down_in_camera())).ok()?;
        let range_mm = pose.range_mm() * (1.0 + self.range_scale) + self.range_offset_mm;
        let focal_px = camera.focal_px().map(|f| f * (1.0 + self.focal_share));
        let camera =
            Camera::new(camera.size_px(), focal_px, camera.principal_px(), camera.skew_px(), *camera.lens()).ok()?;
        Some(View::new(camera, Pose::new(pitch_rad, roll_rad, range_mm).ok()?))
    }

    fn of(values: &[f64; 4]) -> Self {
        let [mount_rad, range_scale, range_offset_mm, focal_share] = *values;
        Self { mount_rad, range_scale, range_offset_mm, focal_share }
    }

    /// In the order of [`LEARNED`].
    #[must_use]
    pub fn values(&self) -> [f64; 4] {
        [self.mount_rad, self.range_scale, self.range_offset_mm, self.focal_share]
    }
}

/// A known size as it was seen.
#[derive(Debug, Clone, PartialEq)]
pub struct BenchSize {
    /// What was measured.
    pub object: String,
    /// The setup or session: sizes of one share its errors.
    pub setup: String,
    /// The view that the readings give.
    pub view: View,
    /// An exact method whose assumptions hold.
    pub method: Method,
    /// What is known of the container.
    pub container: Container,
    /// Its marks.
    pub marks: ObjectMarks,
    /// Which size.
    pub quantity: Quantity,
    /// The truth.
    pub true_mm: f64,
    /// Uncertainties of the picture.
    pub inputs: InputSigma,
}

/// A size under a correction: log of predicted over true, and its derivatives by the four parameters.
struct Predicted {
    log_ratio: f64,
    by_parameter: [f64; 4],
    own_sd: f64,
}

impl BenchSize {
    fn estimate(&self, correction: &Correction) -> Option<(View, Estimate)> {
        let view = correction.apply(&self.view)?;
        let sizes = estimate(&view, self.method, &self.container, &self.marks, &self.inputs);
        Some((view, sizes.into_iter().find(|(quantity, _)| *quantity == self.quantity)?.1.ok()?))
    }

    fn predicted(&self, correction: &Correction) -> Option<Predicted> {
        let (view, estimate) = self.estimate(correction)?;
        let size_mm = estimate.measured.predicted_mm;
        let by = |source: Source| estimate.sensitivity.by_source[source.index()] / size_mm;
        let by_parameter = [
            by(Source::Mount),
            by(Source::RangeScale) * self.view.pose().range_mm() / view.pose().range_mm(),
            by(Source::RangeOffset),
            by(Source::Focal) / (1.0 + correction.focal_share),
        ];
        let noise = estimate.sensitivity.by_noise().map(|d| d * d).dot(&self.inputs.noise());
        let marks = (estimate.sensitivity.marks_mm_per_px * self.inputs.mark_px).powi(2);
        Some(Predicted {
            log_ratio: (size_mm / self.true_mm).ln(),
            by_parameter,
            own_sd: ((noise + marks).sqrt() / size_mm).max(LEAST_SD),
        })
    }

    fn error_pct(&self, correction: &Correction) -> Option<f64> {
        let (_, estimate) = self.estimate(correction)?;
        Some(100.0 * (estimate.measured.predicted_mm / self.true_mm - 1.0))
    }
}

/// Truths and pixels are never better than this share of a size.
const LEAST_SD: f64 = 1e-3;

/// Why sizes do not give corrections.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum CorrectionError {
    /// Too few sizes or setups.
    #[error("{sizes} sizes of {setups} setups; corrections need 6 sizes of 3 setups or more")]
    TooFew {
        /// How many sizes.
        sizes: usize,
        /// How many setups.
        setups: usize,
    },
    /// A size cannot be measured under some correction.
    #[error("a size cannot be measured any more when the readings are corrected: the marks or readings are off")]
    Unmeasurable,
}

/// Corrections with what is known of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Physical {
    /// The corrections; those that the data do not determine are zero.
    pub correction: Correction,
    /// Which of [`LEARNED`] the data determine better than they are known beforehand.
    pub determined: [bool; 4],
    /// SD of each that the data alone give, fitted with those that are determined; none where they say nothing.
    pub sd: [Option<f64>; 4],
    /// Covariance, in the order of [`LEARNED`]; of what is not determined, what was known beforehand.
    pub covariance: Matrix4<f64>,
    /// Errors of objects left out of the fit.
    pub without_object: HeldOut,
    /// Errors of setups left out.
    pub without_setup: HeldOut,
}

/// Fits corrections by robust least squares on the logarithms of sizes, judges them by sizes left out.
///
/// A parameter whose SD from the data is no smaller than `prior` has it is not determined: the worst is left at zero, and
/// the others fitted again. SDs allow for errors that the sizes of a setup share (a sandwich over setups).
///
/// # Errors
/// [`CorrectionError`] where there is too little.
pub fn calibrate(sizes: &[BenchSize], prior: &InputSigma) -> Result<Physical, CorrectionError> {
    let all: Vec<&BenchSize> = sizes.iter().collect();
    let fitted = fit(&all, prior)?;
    let before: Option<Vec<f64>> = sizes.iter().map(|size| size.error_pct(&Correction::default())).collect();
    let before = before.ok_or(CorrectionError::Unmeasurable)?;
    let errors = |kept: &[usize], judged: &[usize]| {
        let kept: Vec<&BenchSize> = kept.iter().map(|&i| &sizes[i]).collect();
        let correction = solve(&kept, &fitted.free, prior).ok()?.correction;
        judged.iter().map(|&i| sizes[i].error_pct(&correction)).collect()
    };
    let too_few = CorrectionError::TooFew { sizes: 0, setups: 0 };
    let without_object = leave_one_out(&before, |i| sizes[i].object.as_str(), errors).ok_or(too_few)?;
    let without_setup = leave_one_out(&before, |i| sizes[i].setup.as_str(), errors).ok_or(too_few)?;
    let mut covariance = Matrix4::zeros();
    let mut sd = fitted.refused_sd;
    for (i, a) in LEARNED.iter().enumerate() {
        covariance[(i, i)] = prior_sd(prior, *a).powi(2);
    }
    for (row, &i) in fitted.free.iter().enumerate() {
        sd[i] = Some(fitted.solution.covariance[(row, row)].sqrt());
        for (column, &j) in fitted.free.iter().enumerate() {
            covariance[(i, j)] = fitted.solution.covariance[(row, column)];
        }
    }
    Ok(Physical {
        correction: fitted.solution.correction,
        determined: std::array::from_fn(|i| fitted.free.contains(&i)),
        sd,
        covariance,
        without_object,
        without_setup,
    })
}

struct Fitted {
    solution: Solution,
    /// Numbers of the parameters that were fitted.
    free: Vec<usize>,
    refused_sd: [Option<f64>; 4],
}

/// What is known of a parameter of [`LEARNED`] beforehand, in its own unit. The mount's holds the accelerometer's pitch.
#[must_use]
pub fn prior_sd(prior: &InputSigma, source: Source) -> f64 {
    if source == Source::Mount { prior.mount_rad.hypot(prior.pitch_rad) } else { prior.of(source) }
}

fn fit(sizes: &[&BenchSize], prior: &InputSigma) -> Result<Fitted, CorrectionError> {
    let setups: BTreeSet<&str> = sizes.iter().map(|size| size.setup.as_str()).collect();
    if sizes.len() < 6 || setups.len() < 3 {
        return Err(CorrectionError::TooFew { sizes: sizes.len(), setups: setups.len() });
    }
    let mut free: Vec<usize> = (0..LEARNED.len()).filter(|&i| prior_sd(prior, LEARNED[i]) > 0.0).collect();
    let mut refused_sd = [None; 4];
    let mut solution = solve(sizes, &free, prior)?;
    while let Some(row) = worst(&solution, &free, prior) {
        refused_sd[free[row]] = Some(solution.covariance[(row, row)].sqrt()).filter(|sd| sd.is_finite());
        free.remove(row);
        solution = solve(sizes, &free, prior)?;
    }
    // What was left out early may be determined now that others are out.
    for i in (0..LEARNED.len()).filter(|&i| prior_sd(prior, LEARNED[i]) > 0.0) {
        if free.contains(&i) {
            continue;
        }
        let with: Vec<usize> = (0..LEARNED.len()).filter(|j| *j == i || free.contains(j)).collect();
        let more = solve(sizes, &with, prior)?;
        let row = with.iter().position(|j| *j == i).unwrap_or_default();
        refused_sd[i] = Some(more.covariance[(row, row)].sqrt()).filter(|sd| sd.is_finite());
        if worst(&more, &with, prior).is_none() {
            (free, solution) = (with, more);
        }
    }
    Ok(Fitted { solution, free, refused_sd })
}

/// The parameter that the data tell least of against what is known beforehand; none where they tell more of all.
fn worst(solution: &Solution, free: &[usize], prior: &InputSigma) -> Option<usize> {
    let ratio = |row: usize| {
        let sd = solution.covariance[(row, row)].sqrt() / prior_sd(prior, LEARNED[free[row]]);
        if sd.is_finite() { sd } else { f64::INFINITY }
    };
    (0..free.len()).max_by(|a, b| ratio(*a).total_cmp(&ratio(*b))).filter(|row| ratio(*row) >= 1.0)
}

struct Solution {
    correction: Correction,
    /// Of the free parameters; not finite where the data do not determine them.
    covariance: DMatrix<f64>,
}

/// Huber's constant, in robust SDs.
const HUBER: f64 = 1.7;
const ROBUST_SD: f64 = 1.4826;
const REWEIGHTINGS: usize = 10;
/// Where sizes leave a direction open, a fence of so many prior SDs keeps the search among poses that exist. What is
/// determined better than beforehand it moves by less than a hundredth of its SD. It does not count for SDs.
const FENCE: f64 = 10.0;

fn solve(sizes: &[&BenchSize], free: &[usize], prior: &InputSigma) -> Result<Solution, CorrectionError> {
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

struct LogSizes<'a> {
    sizes: &'a [&'a BenchSize],
    free: &'a [usize],
    /// Weight of each parameter's own departure from zero.
    fence: DVector<f64>,
    weights: DVector<f64>,
    parameters: DVector<f64>,
}

impl LogSizes<'_> {
    fn correction(&self) -> Correction {
        let mut values = [0.0; 4];
        for (row, &i) in self.free.iter().enumerate() {
            values[i] = self.parameters[row] * UNITS[i];
        }
        Correction::of(&values)
    }

    fn unweighted(&self) -> Option<Vec<f64>> {
        let correction = self.correction();
        self.sizes.iter().map(|size| Some(size.predicted(&correction)?.log_ratio)).collect()
    }

    /// Covariance: from the stated errors of marks and pictures, or their scatter where that is larger; with SDs raised to those
    /// that allow for errors that the sizes of a setup share, (J'J)^-1 (sum of s s') (J'J)^-1 with the scores s of a setup and the
    /// usual factor for few setups. Not finite where J'J is singular.
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
        // As many setups as parameters leave nothing to tell their scatter by.
        if setups <= free {
            return unknown();
        }
        let mut meat = DMatrix::zeros(n, n);
        scores.values().for_each(|s| meat += s * s.transpose());
        let shared = &inverse * meat * &inverse * (setups / (setups - free));
        let scatter = ROBUST_SD * median(residuals.iter().map(|r| r.abs()).collect());
        let stated = &inverse * scatter.max(1.0).powi(2);
        // A sandwich over few setups may be far too small by chance: no SD is smaller than what the marks alone make it.
        let larger = |i: usize| (shared[(i, i)] / stated[(i, i)]).sqrt().max(1.0) * UNITS[self.free[i]];
        DMatrix::from_fn(n, n, |i, j| stated[(i, j)] * larger(i) * larger(j))
    }
}

/// Parameters are fitted in these units, so that a step of 1 means about as much for each.
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
