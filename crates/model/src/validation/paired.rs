//! Two methods on the same marks.

use super::bootstrap::{Interval, bootstrap};
use crate::stats::ErrorStats;

/// Absolute errors of two methods on the same sizes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paired {
    /// How many sizes both have.
    pub n: usize,
    /// Mean of |first| - |second|: positive where the second is better.
    pub mean_difference: f64,
    /// Student's t of these differences, n - 1 degrees of freedom; none where they do not scatter.
    pub t: Option<f64>,
    /// 95 % interval of the mean difference, whole clusters drawn; none of a single cluster.
    pub interval: Option<Interval>,
}

/// Compares pairs of errors, by cluster. None of none.
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
