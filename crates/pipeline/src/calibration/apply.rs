//! The use of a calibration in a run.

use model::{Estimate, InputSigma, Kind, Method, Quantity, Source, View};

use super::{CalibrationFile, PhysicalEntry};

/// The rest of the pitch error of an accelerometer whose offset a bench has taught. ADXL362 data sheet: 0.5 mg per
/// degree Celsius; 10 degrees between bench and use are 5 mg, or 0.3 degrees.
const DRIFT_DEG: f64 = 0.3;

/// The view after the physical corrections; method `paper` keeps its readings. None where no such pose exists.
pub(crate) fn corrected_view(calibration: Option<&CalibrationFile>, method: Method, view: View) -> Option<View> {
    match calibration.and_then(|file| file.physical.as_ref()).filter(|_| method != Method::Paper) {
        Some(physical) => physical.correction().apply(&view),
        None => Some(view),
    }
}

/// The uncertainties after the physical corrections: the covariance that was learned, in place of what was known before.
pub(crate) fn inputs_after(calibration: Option<&CalibrationFile>, inputs: InputSigma) -> InputSigma {
    match calibration.and_then(|file| file.physical.as_ref()) {
        Some(physical) => inputs_with(physical, inputs),
        None => inputs,
    }
}

pub(crate) fn inputs_with(physical: &PhysicalEntry, inputs: InputSigma) -> InputSigma {
    // The mount's correction includes the accelerometer's pitch. Where the mount was not learned, nor was that pitch.
    let learned_pitch = physical.determined.contains(&Source::Mount);
    let mut covariance = physical.covariance();
    if !learned_pitch {
        covariance[(0, 0)] = inputs.mount_rad.powi(2);
    }
    covariance[(1, 1)] += (physical.unexplained_pct / 100.0).powi(2);
    let pitch_rad = if learned_pitch { inputs.pitch_rad.min(DRIFT_DEG.to_radians()) } else { inputs.pitch_rad };
    InputSigma { pitch_rad, learned: Some(covariance), ..inputs }
}

/// The size of method `paper` divided by a + b tan(pitch), with its derivatives; other estimates as they are.
pub(crate) fn scaled_paper(
    calibration: Option<&CalibrationFile>,
    kind: Kind,
    view: &View,
    inputs: &InputSigma,
    estimate: Estimate,
) -> Estimate {
    let is_height = estimate.measured.quantity == Quantity::Height;
    let fits = |kind_of: Kind, height: bool| kind_of == kind && height == is_height;
    let entry = calibration
        .and_then(|file| file.empirical.iter().find(|entry| entry.used && fits(entry.kind, entry.height)))
        .filter(|_| estimate.method == Method::Paper);
    let Some(entry) = entry else { return estimate };
    let tan_pitch = view.pose().pitch_rad().tan();
    let factor = entry.a + entry.b * tan_pitch;
    if !(factor.is_finite() && factor > 0.05) {
        return estimate;
    }
    let mut scaled = estimate;
    scaled.measured.predicted_mm /= factor;
    scaled.sensitivity.by_source /= factor;
    scaled.sensitivity.marks_mm_per_px /= factor;
    let by_pitch = -scaled.measured.predicted_mm * entry.b * (1.0 + tan_pitch * tan_pitch) / factor;
    scaled.sensitivity.by_source[Source::Pitch.index()] += by_pitch;
    scaled.sensitivity.by_source[Source::Mount.index()] += by_pitch;
    scaled.sigma = scaled.sensitivity.sigma(inputs);
    scaled
}
