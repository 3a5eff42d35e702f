//! Calibration by table rows: the factor by which sizes are wrong, as a line in tan(pitch).
//!
//! For heights the line has a meaning: the paper's height of a wall that is H high and overhangs its foot by s is
//! H' tan(pitch) = H cot(e) tan(pitch) + s tan(pitch), where e is the depression of the ray to the rim, which is close to the
//! pitch. So a is about 1, and b is the wall's slope s / H.

use nalgebra::{Matrix2, Vector2};

use super::held_out::{HeldOut, leave_one_out};
use crate::stats::{ROBUST_SD, median};

/// One row of a table, with a size and its truth.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Name of the object that was measured.
    pub object: String,
    /// The setup or session: the rows of one setup share its errors.
    pub setup: String,
    /// Pitch of the camera.
    pub pitch_rad: f64,
    /// The measured size.
    pub predicted_mm: f64,
    /// The true size.
    pub true_mm: f64,
}

impl Row {
    /// The ratio of the measured to the true size.
    fn factor(&self) -> f64 {
        self.predicted_mm / self.true_mm
    }
}

/// The scale of sizes: predicted = true (a + b tan(pitch)).
#[derive(Debug, Clone, PartialEq)]
pub struct Scale {
    /// The factor for a level view.
    pub a: f64,
    /// The slope of the factor, per tangent of the pitch.
    pub b: f64,
    /// The covariance of a and b.
    pub covariance: Matrix2<f64>,
    /// The robust SD of the rows' factors about the line.
    pub scatter: f64,
    /// The weight of each row: 1 for rows that lie near the line.
    pub weights: Vec<f64>,
}

impl Scale {
    /// The factor at a pitch; `None` where the line gives one that is not well above zero.
    #[must_use]
    pub fn factor_at(&self, pitch_rad: f64) -> Option<f64> {
        Some(self.a + self.b * pitch_rad.tan()).filter(|factor| factor.is_finite() && *factor > SMALLEST_FACTOR)
    }
}

/// A smaller factor is refused, since a division by it would blow up noise.
const SMALLEST_FACTOR: f64 = 0.05;

/// The reason why rows do not give a line.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ScaleError {
    /// There are fewer than the four rows that a line and its scatter need.
    #[error("{0} rows; a line in tan(pitch) with its scatter needs 4 or more")]
    TooFew(usize),
    /// All rows have nearly the same pitch.
    #[error("the pitches are all but the same: they do not determine a trend with pitch; use setups 10 degrees apart")]
    OnePitch,
    /// A row is no measurement.
    #[error("a predicted or true size is not a positive number")]
    BadSize,
}

/// Huber's constant, in robust SDs: 98 % efficiency for Gaussian errors, since rows are few.
const HUBER: f64 = 1.7;
/// Bound of the reweighting steps.
const STEPS: usize = 100;
/// Pitches count as one when the SD of their tangents is smaller than this.
const LEAST_SPREAD: f64 = 0.05;

/// The robust line through the rows' factors: least squares with Huber's weights, repeated until the line settles.
///
/// # Errors
/// [`ScaleError`] when the rows do not determine the line.
pub fn fit(rows: &[&Row]) -> Result<Scale, ScaleError> {
    if rows.len() < 4 {
        return Err(ScaleError::TooFew(rows.len()));
    }
    let good = |mm: f64| mm.is_finite() && mm > 0.0;
    if !rows.iter().all(|row| good(row.predicted_mm) && good(row.true_mm)) {
        return Err(ScaleError::BadSize);
    }
    let mut weights = vec![1.0; rows.len()];
    let (mut line, mut inverse, mut scatter) = (Vector2::zeros(), Matrix2::zeros(), 0.0);
    for _ in 0..STEPS {
        let before = line;
        (line, inverse) = weighted_line(rows, &weights)?;
        let off: Vec<f64> = rows.iter().map(|row| row.factor() - design(row).dot(&line)).collect();
        scatter = ROBUST_SD * median(off.iter().map(|r| r.abs()).collect());
        let limit = HUBER * scatter;
        weights = off.iter().map(|r| if r.abs() > limit { limit / r.abs() } else { 1.0 }).collect();
        if (line - before).norm() < 1e-12 {
            break;
        }
    }
    Ok(Scale { a: line.x, b: line.y, covariance: inverse * scatter.powi(2), scatter, weights })
}

/// The row of the design matrix: 1 and tan(pitch).
fn design(row: &Row) -> Vector2<f64> {
    Vector2::new(1.0, row.pitch_rad.tan())
}

/// The coefficients (a, b) of the weighted least-squares line, and the inverse of its normal matrix.
fn weighted_line(rows: &[&Row], weights: &[f64]) -> Result<(Vector2<f64>, Matrix2<f64>), ScaleError> {
    let (mut normal, mut right) = (Matrix2::zeros(), Vector2::zeros());
    for (row, weight) in rows.iter().zip(weights) {
        let x = design(row);
        normal += x * x.transpose() * *weight;
        right += x * (row.factor() * weight);
    }
    let (sum, mean) = (normal[(0, 0)], normal[(0, 1)] / normal[(0, 0)]);
    let variance = normal[(1, 1)] / sum - mean * mean;
    if !(variance.is_finite() && variance > LEAST_SPREAD * LEAST_SPREAD) {
        return Err(ScaleError::OnePitch);
    }
    let inverse = normal.try_inverse().ok_or(ScaleError::OnePitch)?;
    Ok((inverse * right, inverse))
}

/// The result of a calibration by table rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Empirical {
    /// The line through all rows.
    pub scale: Scale,
    /// The errors of objects that were left out of the fit.
    pub without_object: HeldOut,
    /// The errors of setups that were left out of the fit.
    pub without_setup: HeldOut,
    /// The rows that a shift of the decimal point would bring to the line.
    pub slips: Vec<Slip>,
}

/// A slip of the decimal point: a row that is wrong by a factor of ten.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slip {
    /// The number of the row, from 0.
    pub row: usize,
    /// The factor that puts its size right: 10 or 0.1.
    pub factor: f64,
}

/// The calibration by these rows: the line, its errors on rows that were left out, and slips of the decimal point. It does not
/// correct the slips; call it again with the rows of [`mended`].
///
/// # Errors
/// [`ScaleError`] when the rows do not determine a line.
pub fn calibrate(rows: &[Row]) -> Result<Empirical, ScaleError> {
    let scale = fit(&rows.iter().collect::<Vec<_>>())?;
    let before: Vec<f64> = rows.iter().map(|row| 100.0 * (row.factor() - 1.0)).collect();
    let errors = |kept: &[usize], judged: &[usize]| {
        let scale = fit(&kept.iter().map(|&i| &rows[i]).collect::<Vec<_>>()).ok()?;
        judged.iter().map(|&i| Some(100.0 * (rows[i].factor() / scale.factor_at(rows[i].pitch_rad)? - 1.0))).collect()
    };
    let without_object = leave_one_out(&before, |i| rows[i].object.as_str(), errors).ok_or(ScaleError::TooFew(0))?;
    let without_setup = leave_one_out(&before, |i| rows[i].setup.as_str(), errors).ok_or(ScaleError::TooFew(0))?;
    let slips = slips(rows, &scale);
    Ok(Empirical { scale, without_object, without_setup, slips })
}

/// Only a row that is further off than this, in robust SDs, may be a slip.
const FAR: f64 = 3.0;
/// A mended row may be off by this share, however small the scatter is.
const NEAR: f64 = 0.1;

/// The rows that are far from the line, and near it after a shift of the decimal point.
fn slips(rows: &[Row], scale: &Scale) -> Vec<Slip> {
    let off = |row: &Row, factor: f64| (row.factor() * factor - design(row).dot(&Vector2::new(scale.a, scale.b))).abs();
    let slip = |(i, row): (usize, &Row)| {
        let factor = [10.0, 0.1].into_iter().find(|factor| off(row, *factor) < (FAR * scale.scatter).max(NEAR))?;
        (off(row, 1.0) > FAR * scale.scatter && off(row, factor) < 0.5 * off(row, 1.0))
            .then_some(Slip { row: i, factor })
    };
    rows.iter().enumerate().filter_map(slip).collect()
}

/// The rows with slips of the decimal point corrected.
#[must_use]
pub fn mended(rows: &[Row], slips: &[Slip]) -> Vec<Row> {
    let factor = |i: usize| slips.iter().find(|slip| slip.row == i).map_or(1.0, |slip| slip.factor);
    rows.iter().enumerate().map(|(i, row)| Row { predicted_mm: row.predicted_mm * factor(i), ..row.clone() }).collect()
}
