//! Gravity calibration of the accelerometer from still segments of the session itself.
//!
//! A device that is still feels nothing but gravity. Whatever its direction, the length must be 1 g: the points lie on the
//! unit sphere. An offset and a scale per axis that bring them there calibrate the sensor without a bench (van Hees et al.
//! 2014, J Appl Physiol 117:738-744; the R package GGIR, `g.calibrate`, is the implementation that the field uses).

mod rails;
mod sphere;
mod stats;
#[cfg(test)]
mod tests;
mod windows;

use nalgebra::Vector3;

use sphere::Points;
pub(super) use windows::StillWindows;

/// An offset and a scale for each axis: `calibrated = scale * (sample + offset)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisCalibration {
    /// The offset, in g, which is added first.
    pub offset_g: Vector3<f64>,
    /// The scale, by which the sum is multiplied.
    pub scale: Vector3<f64>,
}

impl AxisCalibration {
    /// The calibration that changes nothing.
    const NONE: Self = Self { offset_g: Vector3::new(0.0, 0.0, 0.0), scale: Vector3::new(1.0, 1.0, 1.0) };

    /// The calibrated sample.
    #[must_use]
    pub fn apply(&self, sample_g: &Vector3<f64>) -> Vector3<f64> {
        self.scale.component_mul(&(sample_g + self.offset_g))
    }
}

/// The reason why a calibration may be used, or not: the first that applies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CalibrationVerdict {
    /// There are too few still windows.
    TooFewWindows,
    /// The still windows show too few directions of gravity.
    TooFewDirections,
    /// The fit ended at an offset or a scale that no working sensor has.
    Implausible,
    /// The error did not fall.
    NotBetter,
    /// The error fell, but is still too large.
    StillLarge,
    /// It makes the error smaller, and small.
    Accepted,
}

impl CalibrationVerdict {
    /// The stable code of the verdict.
    #[must_use]
    pub fn code(self) -> &'static str {
        match self {
            Self::TooFewWindows => "too_few_windows",
            Self::TooFewDirections => "too_few_directions",
            Self::Implausible => "implausible",
            Self::NotBetter => "not_better",
            Self::StillLarge => "still_large",
            Self::Accepted => "accepted",
        }
    }
}

/// The gravity calibration that the still segments of a session give.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GravityCalibration {
    /// Whether it may be used.
    pub verdict: CalibrationVerdict,
    /// The number of still windows of 10 s that are used.
    pub windows: u64,
    /// The number of still windows that are left out because an axis stands at the sensor's rail.
    pub at_rail: u64,
    /// The number of different directions among them, in cells of an eighth of g.
    pub directions: usize,
    /// The smallest component among them, in g, by axis.
    pub least_g: Vector3<f64>,
    /// The largest component among them, in g, by axis.
    pub most_g: Vector3<f64>,
    /// The mean departure of their length from 1 g, as recorded. None without a still window.
    pub error_before_mg: Option<f64>,
    /// The mean departure after the fit; none where no fit was tried.
    pub error_after_mg: Option<f64>,
    /// The fit; none where no fit was tried.
    pub fit: Option<AxisCalibration>,
}

/// Fewer still windows than this (5 minutes) are not enough.
const MIN_WINDOWS: u64 = 30;
/// Six numbers are fitted. With twice as many directions a wrong fit can show.
const MIN_DIRECTIONS: usize = 12;
/// Each axis must have been seen beyond this on both sides (GGIR's `spherecrit`).
const MIN_REACH_G: f64 = 0.3;
/// The error after the fit must be below this (van Hees et al. 2014).
const MAX_ERROR_MG: f64 = 10.0;
/// Offsets of a working sensor are smaller (ADXL362 data sheet: zero-g offset up to 250 mg on z).
const MAX_OFFSET_G: f64 = 0.3;
/// Departures of its scale from 1 are smaller as well (ADXL362 data sheet: 10 %). Scales that shrink to nothing would also
/// bring all points to one place on the sphere.
const MAX_SCALE_CHANGE: f64 = 0.2;

impl GravityCalibration {
    /// The fit, if it may be used.
    #[must_use]
    pub fn accepted(&self) -> Option<AxisCalibration> {
        self.fit.filter(|_| self.verdict == CalibrationVerdict::Accepted)
    }

    fn from_points(points: &Points, at_rail: u64) -> Self {
        let (least_g, most_g) = points.reach();
        let mut judged = Self {
            verdict: CalibrationVerdict::Accepted,
            windows: points.windows(),
            at_rail,
            directions: points.directions(),
            least_g,
            most_g,
            error_before_mg: points.error_mg(&AxisCalibration::NONE),
            error_after_mg: None,
            fit: None,
        };
        let seen_on_both_sides =
            least_g.iter().all(|least| *least < -MIN_REACH_G) && most_g.iter().all(|most| *most > MIN_REACH_G);
        if judged.windows < MIN_WINDOWS {
            judged.verdict = CalibrationVerdict::TooFewWindows;
        } else if judged.directions < MIN_DIRECTIONS || !seen_on_both_sides {
            judged.verdict = CalibrationVerdict::TooFewDirections;
        } else {
            let fit = sphere::fit(points);
            judged.error_after_mg = points.error_mg(&fit);
            judged.fit = Some(fit);
            judged.verdict = verdict(&fit, judged.error_before_mg, judged.error_after_mg);
        }
        judged
    }
}

fn verdict(fit: &AxisCalibration, before_mg: Option<f64>, after_mg: Option<f64>) -> CalibrationVerdict {
    let plausible = fit.offset_g.iter().all(|offset| offset.abs() <= MAX_OFFSET_G)
        && fit.scale.iter().all(|scale| (scale - 1.0).abs() <= MAX_SCALE_CHANGE);
    match (before_mg, after_mg) {
        _ if !plausible => CalibrationVerdict::Implausible,
        (Some(before), Some(after)) if after < before && after < MAX_ERROR_MG => CalibrationVerdict::Accepted,
        (Some(before), Some(after)) if after < before => CalibrationVerdict::StillLarge,
        _ => CalibrationVerdict::NotBetter,
    }
}

impl std::fmt::Display for GravityCalibration {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { windows, at_rail, directions, least_g: l, most_g: m, .. } = self;
        write!(f, "{windows} still windows of 10 s in {directions} directions")?;
        if *at_rail > 0 {
            write!(f, " ({at_rail} more, with an axis at the sensor's rail, are left out)")?;
        }
        if *windows > 0 {
            let axes = [("x", l.x, m.x), ("y", l.y, m.y), ("z", l.z, m.z)];
            for (axis, least, most) in axes {
                write!(f, ", {axis} {:.2} to {:.2} g", without_sign_of_zero(least), without_sign_of_zero(most))?;
            }
        }
        if let Some(before) = self.error_before_mg {
            write!(f, "; mean error {before:.1} mg")?;
        }
        if let (Some(after), Some(AxisCalibration { offset_g: o, scale: s })) = (self.error_after_mg, self.fit) {
            let (x, y, z) = (1000.0 * o.x, 1000.0 * o.y, 1000.0 * o.z);
            write!(f, " before, {after:.1} mg after offsets of {x:.1}, {y:.1}, {z:.1} mg")?;
            write!(f, " and scales of {:.4}, {:.4}, {:.4}", s.x, s.y, s.z)?;
        }
        Ok(())
    }
}

/// The number with the two decimals that are shown, without -0.00.
fn without_sign_of_zero(g: f64) -> f64 {
    (100.0 * g).round() / 100.0 + 0.0
}

impl CalibrationVerdict {
    /// The expectation that failed, in words; empty when accepted.
    #[must_use]
    pub fn expected(self) -> &'static str {
        match self {
            Self::TooFewWindows => "expected at least 30 windows",
            Self::TooFewDirections => "expected at least 12 directions, and every axis beyond -0.3 and +0.3 g",
            Self::Implausible => "expected offsets up to 300 mg and scales of 0.8 to 1.2",
            Self::NotBetter => "expected a smaller error after than before",
            Self::StillLarge => "expected an error below 10 mg after",
            Self::Accepted => "",
        }
    }
}
