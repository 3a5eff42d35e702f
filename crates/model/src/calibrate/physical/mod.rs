//! Corrections of mount, range sensor and focal length from known sizes.

mod bench_size;
mod correction;
mod solve;

use std::collections::BTreeSet;

use nalgebra::Matrix4;

use super::held_out::{HeldOut, leave_one_out};
use crate::sigma::{InputSigma, LEARNED};
use crate::source::Source;

pub use bench_size::BenchSize;
pub use correction::Correction;
use solve::{Solution, solve};

/// The reason why sizes do not give corrections.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum CorrectionError {
    /// There are too few sizes or setups.
    #[error("{sizes} sizes of {setups} setups; corrections need 6 sizes of 3 setups or more")]
    TooFew {
        /// Number of sizes.
        sizes: usize,
        /// Number of setups.
        setups: usize,
    },
    /// A size cannot be measured any more under some correction.
    #[error("a size cannot be measured any more when the readings are corrected: the marks or readings are off")]
    Unmeasurable,
}

/// Corrections with their covariance, and with their errors on sizes that were left out.
#[derive(Debug, Clone, PartialEq)]
pub struct Physical {
    /// The corrections; those that the data do not determine are zero.
    pub correction: Correction,
    /// For each of [`LEARNED`], whether the data determine it better than it is known beforehand.
    pub determined: [bool; 4],
    /// The SD of each by the data alone, fitted with those that are determined; `None` where the data give none.
    pub sd: [Option<f64>; 4],
    /// The covariance, in the order of [`LEARNED`]. Parameters that are not determined keep the prior variance.
    pub covariance: Matrix4<f64>,
    /// The errors of objects that were left out of the fit.
    pub without_object: HeldOut,
    /// The errors of setups that were left out of the fit.
    pub without_setup: HeldOut,
}

/// The corrections by robust least squares on the logarithms of sizes, and their errors on sizes that were left out.
///
/// A parameter whose SD from the data is no smaller than that in `prior` is not determined. The worst such parameter is left at
/// zero, and the others are fitted again. SDs allow for errors that the sizes of a setup share (a sandwich over setups).
///
/// # Errors
/// [`CorrectionError`] when there are too few sizes or setups, or when a size cannot be measured.
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

/// A fit, with the choice of the parameters that the data determine.
struct Fitted {
    solution: Solution,
    /// The numbers of the parameters that were fitted.
    free: Vec<usize>,
    /// The SDs, by the data, of the parameters that were left out.
    refused_sd: [Option<f64>; 4],
}

/// The SD of a parameter of [`LEARNED`] before the calibration, in its own unit. That of the mount includes the pitch of the
/// accelerometer.
#[must_use]
pub fn prior_sd(prior: &InputSigma, source: Source) -> f64 {
    if source == Source::Mount { prior.mount_rad.hypot(prior.pitch_rad) } else { prior.sigma_of(source) }
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
    // A parameter that was left out early may be determined now that others are left out.
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

/// The place in `free` of the parameter whose SD is the largest against that in `prior`; `None` when all SDs are smaller than
/// in `prior`.
fn worst(solution: &Solution, free: &[usize], prior: &InputSigma) -> Option<usize> {
    let ratio = |row: usize| {
        let sd = solution.covariance[(row, row)].sqrt() / prior_sd(prior, LEARNED[free[row]]);
        if sd.is_finite() { sd } else { f64::INFINITY }
    };
    (0..free.len()).max_by(|a, b| ratio(*a).total_cmp(&ratio(*b))).filter(|row| ratio(*row) >= 1.0)
}
