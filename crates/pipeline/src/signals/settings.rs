//! Which of the study's settings matter to which step: what is kept between runs is keyed by them.

use serde::Serialize;

use crate::study::{GravityCalibrate, RangeCone, SelectSpec, SignalsSpec};

/// From samples to readings. A change means that the samples are read again.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReadingSettings {
    /// -3 dB frequency of the low-pass that separates gravity from motion.
    pub gravity_cutoff_hz: f64,
    /// What to do about offsets and scales of the accelerometer.
    pub gravity_calibration: GravityCalibrate,
    /// Width of the window around an image's time for the median range.
    pub range_window_s: f64,
    /// Shorter readings are nonsense.
    pub range_min_mm: f64,
    /// Longer readings are beyond the sensor.
    pub range_max_mm: f64,
    /// The range sensor's own update period.
    pub range_update_s: f64,
}

impl From<&SignalsSpec> for ReadingSettings {
    fn from(spec: &SignalsSpec) -> Self {
        Self {
            gravity_cutoff_hz: spec.gravity_cutoff_hz,
            gravity_calibration: spec.gravity_calibration,
            range_window_s: spec.range_window_s,
            range_min_mm: spec.range_min_mm,
            range_max_mm: spec.range_max_mm,
            range_update_s: spec.range_update_s,
        }
    }
}

impl Default for ReadingSettings {
    fn default() -> Self {
        Self::from(&SignalsSpec::default())
    }
}

/// From readings to a pose and a choice. A change means that no sample is read.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PoseSettings {
    /// Largest departure of gravity's length from 1 g.
    pub gravity_tolerance_mg: f64,
    /// RMS motion above which an image is not still.
    pub stillness_max_mg: f64,
    /// Whether the range is corrected for the sensor's cone.
    pub range_cone: RangeCone,
    /// Which frames count.
    pub select: SelectSpec,
    /// Camera pitch = sensor pitch + this.
    pub mount_pitch_rad: f64,
}

impl PoseSettings {
    /// Those of a study.
    #[must_use]
    pub fn new(signals: &SignalsSpec, select: &SelectSpec, mount_pitch_rad: f64) -> Self {
        Self {
            gravity_tolerance_mg: signals.gravity_tolerance_mg,
            stillness_max_mg: signals.stillness_max_mg,
            range_cone: signals.range_cone,
            select: select.clone(),
            mount_pitch_rad,
        }
    }
}
