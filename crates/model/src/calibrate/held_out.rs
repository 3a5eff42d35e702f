//! Errors of sizes that were left out of a calibration.

use std::collections::BTreeSet;

use crate::stats::ErrorStats;

/// Root mean square errors in per cent of the truth, before and after a calibration that was fitted without the judged sizes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeldOut {
    /// Number of sizes that were judged.
    pub n: usize,
    /// Number of folds: of objects, or of setups.
    pub folds: usize,
    /// The error before the calibration.
    pub before_rmse_pct: f64,
    /// The error after the calibration; `None` where some fold left too few sizes to fit.
    pub after_rmse_pct: Option<f64>,
}

/// The errors when one fold after the other is left out; `None` when there are no sizes. `before_pct`: the error of each size
/// before the calibration. `fold_of(i)`: the fold of size i. `errors_pct(kept, judged)`: the errors of the judged sizes after a
/// fit to the kept ones, or `None` where those do not determine the fit.
pub(super) fn leave_one_out<F: Ord>(
    before_pct: &[f64],
    fold_of: impl Fn(usize) -> F,
    errors_pct: impl Fn(&[usize], &[usize]) -> Option<Vec<f64>>,
) -> Option<HeldOut> {
    let folds: BTreeSet<F> = (0..before_pct.len()).map(&fold_of).collect();
    let rms = |errors: &[f64]| ErrorStats::from_errors(errors).map(|stats| stats.rms);
    let mut after = Some(Vec::new());
    for fold in &folds {
        let (judged, kept): (Vec<usize>, Vec<usize>) = (0..before_pct.len()).partition(|i| fold_of(*i) == *fold);
        after = after.zip(errors_pct(&kept, &judged)).map(|(mut all, more)| {
            all.extend(more);
            all
        });
    }
    Some(HeldOut {
        n: before_pct.len(),
        folds: folds.len(),
        before_rmse_pct: rms(before_pct)?,
        after_rmse_pct: after.as_deref().and_then(rms),
    })
}
