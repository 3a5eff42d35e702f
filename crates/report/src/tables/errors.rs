//! Means and errors of numbers that may be missing.

use model::{ErrorStats, ResultRow};

/// The mean of the finite numbers among `values`; none where there are none.
#[expect(clippy::cast_precision_loss, reason = "a count of values is far below 2^53")]
pub(super) fn mean(values: impl IntoIterator<Item = Option<f64>>) -> Option<f64> {
    let (sum, n) = values
        .into_iter()
        .flatten()
        .filter(|value| value.is_finite())
        .fold((0.0, 0_usize), |(sum, n), value| (sum + value, n + 1));
    (n > 0).then(|| sum / n as f64)
}

/// The signed error in per cent, where there are a size and a truth above zero.
pub(super) fn error_pct(predicted: Option<f64>, truth: Option<f64>) -> Option<f64> {
    let truth = truth.filter(|truth| *truth > 0.0)?;
    Some(100.0 * (predicted? - truth) / truth).filter(|error| error.is_finite())
}

/// The signed error in per cent of a row of the results.
pub(crate) fn row_error_pct(row: &ResultRow) -> Option<f64> {
    error_pct(row.predicted_mm, row.truth_mm)
}

/// The mean and the SD of errors, as they stand in a row of means.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Summary {
    pub(super) n: usize,
    pub(super) mean: Option<f64>,
    pub(super) sd: Option<f64>,
}

impl Summary {
    /// The mean and the sample SD (n - 1) of the errors.
    pub(super) fn sample(errors: &[f64]) -> Self {
        ErrorStats::from_errors(errors).map_or_else(Self::default, |s| Self {
            n: s.n,
            mean: Some(s.mean),
            sd: s.sample_sd,
        })
    }

    /// The mean and the population SD (n) of the errors.
    pub(super) fn population(errors: &[f64]) -> Self {
        ErrorStats::from_errors(errors).map_or_else(Self::default, |s| Self {
            n: s.n,
            mean: Some(s.mean),
            sd: Some(s.population_sd),
        })
    }
}

/// A length in centimetres, the unit of the tables.
pub(super) fn to_cm(millimetres: Option<f64>) -> Option<f64> {
    millimetres.map(|millimetres| millimetres / 10.0)
}

/// The text of a footnote about rows without a size, with their flags; none where every row has a size.
pub(super) fn not_measured<'a>(rows: impl IntoIterator<Item = &'a ResultRow>) -> Option<String> {
    let mut all = 0;
    let mut missing = 0;
    let mut flags: Vec<&str> = Vec::new();
    for row in rows {
        all += 1;
        if row.predicted_mm.is_none_or(|predicted| !predicted.is_finite()) {
            missing += 1;
            flags.extend(row.flags.split(',').map(str::trim).filter(|flag| !flag.is_empty()));
        }
    }
    flags.sort_unstable();
    flags.dedup();
    let reason = if flags.is_empty() { "no flag says why".to_owned() } else { flags.join(", ") };
    match missing {
        0 => None,
        1 if all == 1 => Some(format!("not measured: {reason}")),
        _ if missing == all => Some(format!("none of {all} measured: {reason}")),
        _ => Some(format!("{missing} of {all} not measured and left out: {reason}")),
    }
}
