//! The coverage of intervals: whether they contain the truth as often as they claim.

use super::summary::K_95;

/// The shares of sizes whose intervals contain the truth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coverage {
    /// Number of sizes.
    pub n: usize,
    /// Share of errors within one standard uncertainty, 0 to 1: 0.683 if the uncertainty is right.
    pub within_68: f64,
    /// Share of errors within 1.96 standard uncertainties: 0.95 if the uncertainty is right.
    pub within_95: f64,
}

/// The coverage of pairs (error, its standard uncertainty); `None` when there are none.
#[must_use]
#[expect(clippy::cast_precision_loss, reason = "a count of sizes is far below 2^53")]
pub fn coverage(sizes: &[(f64, f64)]) -> Option<Coverage> {
    let share =
        |k: f64| sizes.iter().filter(|(error, sigma)| error.abs() <= k * sigma).count() as f64 / sizes.len() as f64;
    (!sizes.is_empty()).then(|| Coverage { n: sizes.len(), within_68: share(1.0), within_95: share(K_95) })
}
