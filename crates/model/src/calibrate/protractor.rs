//! The paper's calibration of the pitch, which compares measured angles with reference angles.

use crate::stats::ErrorStats;

/// The line measured = offset + slope * reference, and the differences.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Protractor {
    /// Number of angles.
    pub n: usize,
    /// Slope of the measured angle against the reference.
    pub slope: f64,
    /// Measured angle at a reference of zero, in the unit of the angles.
    pub offset: f64,
    /// Mean of the differences measured - reference.
    pub mean_difference: f64,
    /// Sample SD of these differences.
    pub sd_difference: f64,
}

/// The line through pairs (reference, measured), in any unit; `None` for fewer than three pairs, or when all references are
/// alike.
#[must_use]
pub fn protractor(pairs: &[(f64, f64)]) -> Option<Protractor> {
    let stats = |values: Vec<f64>| ErrorStats::from_errors(&values);
    let (x, y) = (stats(pairs.iter().map(|p| p.0).collect())?, stats(pairs.iter().map(|p| p.1).collect())?);
    let difference = stats(pairs.iter().map(|(reference, measured)| measured - reference).collect())?;
    let sum = |term: &dyn Fn(&(f64, f64)) -> f64| pairs.iter().map(term).sum::<f64>();
    let slope = sum(&|p| (p.0 - x.mean) * (p.1 - y.mean)) / sum(&|p| (p.0 - x.mean).powi(2));
    (pairs.len() >= 3 && slope.is_finite()).then_some(Protractor {
        n: pairs.len(),
        slope,
        offset: y.mean - slope * x.mean,
        mean_difference: difference.mean,
        sd_difference: difference.sample_sd?,
    })
}
