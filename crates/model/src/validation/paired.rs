//! The comparison of two methods on the same marks.

use super::bootstrap::{Interval, bootstrap};
use crate::stats::ErrorStats;

/// The comparison of two methods' absolute errors on the same sizes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paired {
    /// Number of sizes that both methods gave.
    pub n: usize,
    /// Mean of |first| - |second|: positive where the second is better.
    pub mean_difference: f64,
    /// Student's t of these differences, with n - 1 degrees of freedom; `None` where they do not scatter.
    pub t: Option<f64>,
    /// 95 % interval of the mean difference, by drawing whole clusters; `None` for a single cluster.
    pub interval: Option<Interval>,
}

/// The comparison of pairs of errors (of the first method, of the second), given by cluster; `None` when there are none.
#[must_use]
#[expect(clippy::cast_precision_loss, reason = "a count of sizes is far below 2^53")]
pub fn paired(clusters: &[Vec<(f64, f64)>], draws: usize, seed: u64) -> Option<Paired> {
    let differences: Vec<Vec<f64>> =
        clusters.iter().map(|pairs| pairs.iter().map(|(a, b)| a.abs() - b.abs()).collect()).collect();
    let all: Vec<f64> = differences.iter().flatten().copied().collect();
    let stats = ErrorStats::from_errors(&all)?;
    let mean = |sample: &[f64]| ErrorStats::from_errors(sample).map(|stats| stats.mean);
    Some(Paired {
        n: stats.n,
        mean_difference: stats.mean,
        t: stats.sample_sd.filter(|sd| *sd > 0.0).map(|sd| stats.mean / (sd / (stats.n as f64).sqrt())),
        interval: bootstrap(&differences, mean, draws, seed),
    })
}
