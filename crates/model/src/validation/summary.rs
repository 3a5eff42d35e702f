//! The summary of signed errors.

use crate::stats::{ErrorStats, median};

/// The summary of signed errors, in any unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ErrorSummary {
    /// Number of errors.
    pub n: usize,
    /// Mean of the signed errors.
    pub bias: f64,
    /// Sample SD; `None` for a single error.
    pub sd: Option<f64>,
    /// Root mean square.
    pub rmse: f64,
    /// Mean of the absolute errors.
    pub mae: f64,
    /// Median of the signed errors.
    pub median: f64,
    /// The absolute error that 95 % of the errors do not exceed.
    pub q95_absolute: f64,
    /// Largest absolute error.
    pub max_absolute: f64,
    /// Limits of agreement, bias -+ 1.96 SD (Bland and Altman, Lancet 1986); `None` for a single error.
    pub limits: Option<[f64; 2]>,
}

/// 95 % of a Gaussian distribution lie within this many SDs.
pub(super) const K_95: f64 = 1.959_963_984_540_054;

impl ErrorSummary {
    /// The summary of `errors`; `None` when there are no errors.
    #[must_use]
    pub fn from_errors(errors: &[f64]) -> Option<Self> {
        let stats = ErrorStats::from_errors(errors)?;
        let absolute: Vec<f64> = errors.iter().map(|e| e.abs()).collect();
        Some(Self {
            n: stats.n,
            bias: stats.mean,
            sd: stats.sample_sd,
            rmse: stats.rms,
            mae: stats.mean_absolute,
            median: median(errors.to_vec()),
            q95_absolute: quantile(absolute, 0.95),
            max_absolute: stats.worst.abs(),
            limits: stats.sample_sd.map(|sd| [stats.mean - K_95 * sd, stats.mean + K_95 * sd]),
        })
    }
}

/// The value below which the share `p` (0 to 1) of the values lies, linear between neighbours (numpy's default, R's type 7).
/// NaN when there are no values.
#[must_use]
#[expect(clippy::cast_precision_loss, reason = "a count of errors is far below 2^53")]
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a place between 0 and the count")]
pub fn quantile(mut values: Vec<f64>, p: f64) -> f64 {
    if values.is_empty() {
        return f64::NAN;
    }
    values.sort_by(f64::total_cmp);
    let place = p.clamp(0.0, 1.0) * (values.len() - 1) as f64;
    let below = place.floor() as usize;
    let above = (below + 1).min(values.len() - 1);
    values[below] + (place - place.floor()) * (values[above] - values[below])
}
