//! Whether intervals hold the truth as often as they say.

/// Shares of sizes whose intervals hold the truth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coverage {
    /// How many sizes.
    pub n: usize,
    /// Share within one standard uncertainty: 68.3 % if it is right.
    pub within_68: f64,
    /// Share within 1.96: 95 % if it is right.
    pub within_95: f64,
}

/// 95 % of a Gaussian lie within so many SDs.
const K_95: f64 = 1.959_963_984_540_054;

/// Coverage of pairs (error, its standard uncertainty). None of none.
#[must_use]
#[expect(clippy::cast_precision_loss, reason = "a count of sizes is far below 2^53")]
pub fn coverage(sizes: &[(f64, f64)]) -> Option<Coverage> {
    let share =
        |k: f64| sizes.iter().filter(|(error, sigma)| error.abs() <= k * sigma).count() as f64 / sizes.len() as f64;
    (!sizes.is_empty()).then(|| Coverage { n: sizes.len(), within_68: share(1.0), within_95: share(K_95) })
}
