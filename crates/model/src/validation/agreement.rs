//! How far raters agree.

/// Agreement of raters who all rated all targets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Agreement {
    /// How many targets.
    pub targets: usize,
    /// How many raters.
    pub raters: usize,
    /// ICC(2,1): two-way random effects, absolute agreement, single rater (Shrout and Fleiss 1979; McGraw and Wong's
    /// ICC(A,1)).
    pub icc: f64,
    /// Standard error of measurement of a single rater for absolute agreement: root of the variances of raters and of the
    /// residual, in the unit of the ratings.
    pub sem: f64,
}

/// Agreement of a table with one row per target and one column per rater. None for fewer than two of either, for rows of
/// different lengths, or where all ratings are alike.
#[must_use]
#[expect(clippy::cast_precision_loss, reason = "counts of targets and raters are far below 2^53")]
pub fn agreement(ratings: &[Vec<f64>]) -> Option<Agreement> {
    let (n, k) = (ratings.len(), ratings.first()?.len());
    if n < 2 || k < 2 || ratings.iter().any(|row| row.len() != k || !row.iter().all(|x| x.is_finite())) {
        return None;
    }
    let (targets, raters) = (n as f64, k as f64);
    let mean = ratings.iter().flatten().sum::<f64>() / (targets * raters);
    let of_target = |row: &Vec<f64>| row.iter().sum::<f64>() / raters;
    let of_rater = |j: usize| ratings.iter().map(|row| row[j]).sum::<f64>() / targets;
    let between_targets = raters * ratings.iter().map(|row| (of_target(row) - mean).powi(2)).sum::<f64>();
    let between_raters = targets * (0..k).map(|j| (of_rater(j) - mean).powi(2)).sum::<f64>();
    let total: f64 = ratings.iter().flatten().map(|x| (x - mean).powi(2)).sum();
    let residual = (total - between_targets - between_raters).max(0.0);
    // Mean squares of targets, raters and residual.
    let msr = between_targets / (targets - 1.0);
    let msc = between_raters / (raters - 1.0);
    let mse = residual / ((targets - 1.0) * (raters - 1.0));
    let icc = (msr - mse) / (msr + (raters - 1.0) * mse + raters * (msc - mse) / targets);
    let sem = (mse + ((msc - mse) / targets).max(0.0)).sqrt();
    icc.is_finite().then_some(Agreement { targets: n, raters: k, icc, sem })
}
