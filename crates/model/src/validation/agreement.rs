//! The agreement of raters.

/// The agreement of raters who all rated all targets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Agreement {
    /// Number of targets.
    pub targets: usize,
    /// Number of raters.
    pub raters: usize,
    /// ICC(2,1): two-way random effects, absolute agreement, single rater (Shrout and Fleiss 1979; McGraw and Wong's
    /// ICC(A,1)).
    pub icc: f64,
    /// Standard error of measurement of a single rater for absolute agreement: the root of the summed variances of the raters
    /// and of the residual, in the unit of the ratings.
    pub sem: f64,
}

/// The agreement in a table with one row per target and one column per rater; `None` for fewer than two of either, for rows of
/// different lengths, for ratings that are not finite, and where all ratings are alike.
#[must_use]
#[expect(clippy::cast_precision_loss, reason = "counts of targets and raters are far below 2^53")]
pub fn agreement(ratings: &[Vec<f64>]) -> Option<Agreement> {
    let (n, k) = (ratings.len(), ratings.first()?.len());
    if n < 2 || k < 2 || ratings.iter().any(|row| row.len() != k || !row.iter().all(|x| x.is_finite())) {
        return None;
    }
    let (targets, raters) = (n as f64, k as f64);
    let mean = ratings.iter().flatten().sum::<f64>() / (targets * raters);
    let target_mean = |row: &Vec<f64>| row.iter().sum::<f64>() / raters;
    let rater_mean = |j: usize| ratings.iter().map(|row| row[j]).sum::<f64>() / targets;
    let between_targets = raters * ratings.iter().map(|row| (target_mean(row) - mean).powi(2)).sum::<f64>();
    let between_raters = targets * (0..k).map(|j| (rater_mean(j) - mean).powi(2)).sum::<f64>();
    let total: f64 = ratings.iter().flatten().map(|x| (x - mean).powi(2)).sum();
    let residual = (total - between_targets - between_raters).max(0.0);
    // The mean squares of targets, of raters and of the residual.
    let msr = between_targets / (targets - 1.0);
    let msc = between_raters / (raters - 1.0);
    let mse = residual / ((targets - 1.0) * (raters - 1.0));
    let icc = (msr - mse) / (msr + (raters - 1.0) * mse + raters * (msc - mse) / targets);
    let sem = (mse + ((msc - mse) / targets).max(0.0)).sqrt();
    icc.is_finite().then_some(Agreement { targets: n, raters: k, icc, sem })
}
