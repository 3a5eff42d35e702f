//! The settings of each step of the signals. They are apart because the readings are kept between runs, keyed by the
//! settings that made them, while poses are judged anew in each run.

use serde::{Deserialize, Serialize};

/// The distance that the range sensor's reading is taken for.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RangeCone {
    /// The distance along the axis.
    #[default]
    Off,
    /// The mean over a cone of 25 degrees that meets the tilted table (docs/signals.md).
    TiltedPlane,
}

/// The use that is made of a gravity calibration from still segments (docs/signals.md).
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum GravityCalibrate {
    /// No calibration is made.
    Off,
    /// The calibration is worked out and logged, and changes nothing.
    #[default]
    Report,
    /// The calibration is used where it is accepted; a note says whether it was.
    Apply,
}

/// The settings by which samples become readings. After a change the samples are read again.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReadingSettings {
    /// The -3 dB frequency of the low-pass that separates gravity from motion.
    pub gravity_cutoff_hz: f64,
    /// The correction of offsets and scales of the accelerometer.
    pub gravity_calibration: GravityCalibrate,
    /// The width of the window around an image's time for the median range.
    pub range_window_s: f64,
    /// Shorter readings are no ranges.
    pub range_min_mm: f64,
    /// Longer readings are beyond the sensor's reach.
    pub range_max_mm: f64,
    /// The range sensor's own update period.
    pub range_update_s: f64,
}

impl Default for ReadingSettings {
    fn default() -> Self {
        Self {
            gravity_cutoff_hz: 0.25,
            gravity_calibration: GravityCalibrate::default(),
            range_window_s: 1.0,
            range_min_mm: 30.0,
            range_max_mm: 2000.0, // VL53L0X data sheet: up to 2 m
            range_update_s: 0.02, // VL53L0X data sheet: 20 ms at its fastest; a slower sensor shows it
        }
    }
}

/// The settings by which readings become a pose and a choice. After a change no sample needs to be read.
#[derive(Debug, Clone, PartialEq)]
pub struct PoseSettings {
    /// The largest departure of gravity's length from 1 g.
    pub gravity_tolerance_mg: f64,
    /// The RMS motion above which an image is not still.
    pub stillness_max_mg: f64,
    /// Whether the range is corrected for the sensor's cone.
    pub range_cone: RangeCone,
    /// The pitch of the camera around which images are selected. It is in degrees, as in study.toml and in the column
    /// `pitch_deg` of the ledger: whoever compares these two numbers comes to the same decision, also for an image at the
    /// very border.
    pub target_pitch_deg: f64,
    /// The half width of the window around that pitch; its ends belong to it.
    pub pitch_tolerance_deg: f64,
    /// The mount offset: camera pitch = sensor pitch + this.
    pub mount_pitch_rad: f64,
}

impl PoseSettings {
    /// The settings of a study that names none, for a camera that looks further down than the sensor by `mount_pitch_rad`.
    #[must_use]
    pub fn with_mount(mount_pitch_rad: f64) -> Self {
        Self {
            gravity_tolerance_mg: 150.0, // a glasses IMU with |a| = 1.04 g is usable, a wrong scale is not
            stillness_max_mg: 50.0,
            range_cone: RangeCone::default(),
            target_pitch_deg: 55.0, // where the paper's errors are lowest
            pitch_tolerance_deg: 7.5,
            mount_pitch_rad,
        }
    }
}
