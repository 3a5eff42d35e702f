//! Statistics of signed errors, as the paper defines them.

/// Statistics of a sample of signed errors (any unit; the tables use per cent).
///
/// Tables II-IV of the paper state the *sample* SD (n - 1), tables V and VI the *population* SD (n).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ErrorStats {
    /// Number of errors.
    pub n: usize,
    /// Mean of the signed errors: the bias.
    pub mean: f64,
    /// SD with divisor n - 1; `None` for a single error.
    pub sample_sd: Option<f64>,
    /// SD with divisor n.
    pub population_sd: f64,
    /// Mean of the absolute errors.
    pub mean_absolute: f64,
    /// Median of the absolute errors.
    pub median_absolute: f64,
    /// Root mean square of the errors.
    pub rms: f64,
    /// The error with the largest absolute value, with its sign.
    pub worst: f64,
}

impl ErrorStats {
    /// Statistics of `errors`; `None` when there are no errors. The caller must have removed numbers that are not finite.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "a count of errors is far below 2^53")]
    pub fn from_errors(errors: &[f64]) -> Option<Self> {
        let worst = errors.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs()))?;
        let n = errors.len() as f64;
        let mean = errors.iter().sum::<f64>() / n;
        let squares: f64 = errors.iter().map(|e| (e - mean).powi(2)).sum();
        Some(Self {
            n: errors.len(),
            mean,
            sample_sd: (errors.len() > 1).then(|| (squares / (n - 1.0)).sqrt()),
            population_sd: (squares / n).sqrt(),
            mean_absolute: errors.iter().map(|e| e.abs()).sum::<f64>() / n,
            median_absolute: median(errors.iter().map(|e| e.abs()).collect()),
            rms: (errors.iter().map(|e| e * e).sum::<f64>() / n).sqrt(),
            worst,
        })
    }
}

/// The robust SD of a Gaussian sample, in median absolute deviations.
pub(crate) const ROBUST_SD: f64 = 1.4826;

/// Median of `values`: the middle value, or the mean of the two middle ones. NaN when there are no values.
#[must_use]
pub fn median(mut values: Vec<f64>) -> f64 {
    if values.is_empty() {
        return f64::NAN;
    }
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    if values.len() % 2 == 1 { values[middle] } else { 0.5 * (values[middle - 1] + values[middle]) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_sample_agrees_with_hand_values() {
        let stats = ErrorStats::from_errors(&[-2.0, 1.0, 4.0]).expect("not empty");
        assert_eq!(stats.n, 3);
        assert!((stats.mean - 1.0).abs() < 1e-15);
        assert!((stats.sample_sd.expect("n > 1") - 3.0).abs() < 1e-15);
        assert!((stats.population_sd - 6.0_f64.sqrt()).abs() < 1e-15);
        assert!((stats.mean_absolute - 7.0 / 3.0).abs() < 1e-15);
        assert!((stats.median_absolute - 2.0).abs() < 1e-15);
        assert!((stats.rms - 7.0_f64.sqrt()).abs() < 1e-15);
        assert!((stats.worst - 4.0).abs() < 1e-15);
    }

    #[test]
    fn one_error_has_no_sample_sd_and_none_has_nothing() {
        assert_eq!(ErrorStats::from_errors(&[3.0]).expect("not empty").sample_sd, None);
        assert_eq!(ErrorStats::from_errors(&[]), None);
    }
}
