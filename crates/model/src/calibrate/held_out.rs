//! Errors of sizes that a calibration has not seen.

use std::collections::BTreeSet;

use crate::stats::ErrorStats;

/// Root mean square errors in per cent of the truth, before and after a calibration that was fitted without what is judged.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeldOut {
    /// How many sizes were judged.
    pub n: usize,
    /// How many folds there were: objects, or setups.
    pub folds: usize,
    /// Before.
    pub before_rmse_pct: f64,
    /// After; none where some fold left too little to fit.
    pub after_rmse_pct: Option<f64>,
}

/// Leaves out one fold after the other. `fold_of(i)`: the fold of size i. `errors_pct(kept, judged)`: errors of the judged
/// sizes after a fit to the kept ones; none where those do not determine it.
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
