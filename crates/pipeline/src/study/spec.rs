//! study.toml as it is written, with the defaults of what may be left out.

use std::num::NonZeroUsize;

use model::{Kind, Method, Note, Quantity, Selection, TableLayout};
use serde::{Deserialize, Serialize};

use super::{MarksSource, UncertaintySpec};
use crate::rims::{LEAST_DIAMETER_MM, RimShape};
use crate::signals::{GravityCalibrate, PoseSettings, RangeCone, ReadingSettings};

/// The version of study.toml that this program reads.
pub(crate) const STUDY_SCHEMA_VERSION: u32 = 1;

/// study.toml. Unknown keys are refused.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StudySpec {
    /// Version of this layout: 1.
    pub schema_version: u32,
    /// Name of the study.
    pub name: String,
    /// A sentence that every report made from this study carries.
    #[serde(default)]
    pub statement: Option<String>,
    /// IANA time zone, for image times that name none.
    #[serde(default = "utc")]
    pub time_zone: String,
    /// Device profile: built in, or devices/NAME.toml.
    pub device_profile: String,
    /// Camera: built in, or devices/NAME.toml.
    pub camera: String,
    /// About what people marked.
    #[serde(default)]
    pub marks: MarksSpec,
    /// How the camera sits on the device.
    #[serde(default)]
    pub mount: MountSpec,
    /// The cameras' clock against the sensors'.
    #[serde(default)]
    pub time: TimeSpec,
    /// From samples to pitch, roll, stillness and range.
    #[serde(default)]
    pub signals: SignalsSpec,
    /// Which frames count.
    #[serde(default)]
    pub select: SelectSpec,
    /// From marks to sizes.
    #[serde(default)]
    pub measure: MeasureSpec,
    /// Standard uncertainties of what goes in.
    #[serde(default)]
    pub uncertainty: UncertaintySpec,
    /// Error tables to make.
    #[serde(default)]
    pub tables: Vec<TableEntry>,
}

fn utc() -> String {
    "UTC".to_owned()
}

/// `[marks]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MarksSpec {
    /// Camera of the pictures that were marked, if those are not the raw ones.
    pub camera: Option<String>,
    /// Who marks: people, the program, or both.
    pub source: MarksSource,
    /// Rims that the program finds with less confidence are left out.
    pub min_confidence: f64,
    /// Rims that the program finds and that are narrower, in mm, are left out: cups, mugs and drinking glasses.
    pub min_diameter_mm: f64,
    /// Shapes of rims that the program looks for.
    pub shapes: Vec<RimShape>,
}

impl Default for MarksSpec {
    fn default() -> Self {
        Self {
            camera: None,
            source: MarksSource::default(),
            min_confidence: 0.5,
            min_diameter_mm: LEAST_DIAMETER_MM,
            shapes: vec![RimShape::Circle],
        }
    }
}

/// `[mount]`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MountSpec {
    /// Camera pitch = sensor pitch + this; the profile's when left out.
    pub pitch_offset_deg: Option<f64>,
}

/// `[time]`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct TimeSpec {
    /// Sensor time = image time + this.
    pub image_lag_s: f64,
    /// Whether to work out that lag from the pictures; it is told, and not applied.
    pub estimate_lag: bool,
}

/// `[signals]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SignalsSpec {
    /// -3 dB frequency of the low-pass that separates gravity from motion.
    pub gravity_cutoff_hz: f64,
    /// Largest departure of gravity's length from 1 g.
    pub gravity_tolerance_mg: f64,
    /// RMS motion above which an image is not still.
    pub stillness_max_mg: f64,
    /// Width of the window around an image's time for the median range.
    pub range_window_s: f64,
    /// Shorter readings are nonsense.
    pub range_min_mm: f64,
    /// Longer readings are beyond the sensor.
    pub range_max_mm: f64,
    /// The range sensor's own update period; records in between repeat its reading.
    pub range_update_s: f64,
    /// Whether the range is corrected for the sensor's cone; never for the method `paper`.
    pub range_cone: RangeCone,
    /// What to do about offsets and scales of the accelerometer.
    pub gravity_calibration: GravityCalibrate,
}

impl Default for SignalsSpec {
    fn default() -> Self {
        let (reading, pose) = (ReadingSettings::default(), PoseSettings::with_mount(0.0));
        Self {
            gravity_cutoff_hz: reading.gravity_cutoff_hz,
            gravity_tolerance_mg: pose.gravity_tolerance_mg,
            stillness_max_mg: pose.stillness_max_mg,
            range_window_s: reading.range_window_s,
            range_min_mm: reading.range_min_mm,
            range_max_mm: reading.range_max_mm,
            range_update_s: reading.range_update_s,
            range_cone: pose.range_cone,
            gravity_calibration: reading.gravity_calibration,
        }
    }
}

impl SignalsSpec {
    /// The settings that readings are made by.
    #[must_use]
    pub fn reading_settings(&self) -> ReadingSettings {
        // Without `..`: a new key is either read by, and then in the key of the signals stage, or judged by.
        let Self {
            gravity_cutoff_hz,
            gravity_calibration,
            range_window_s,
            range_min_mm,
            range_max_mm,
            range_update_s,
            gravity_tolerance_mg: _,
            stillness_max_mg: _,
            range_cone: _,
        } = *self;
        ReadingSettings {
            gravity_cutoff_hz,
            gravity_calibration,
            range_window_s,
            range_min_mm,
            range_max_mm,
            range_update_s,
        }
    }

    /// The settings that readings are judged by, for a camera that looks further down than the sensor by `mount_pitch_rad`.
    #[must_use]
    pub fn pose_settings(&self, select: &SelectSpec, mount_pitch_rad: f64) -> PoseSettings {
        PoseSettings {
            gravity_tolerance_mg: self.gravity_tolerance_mg,
            stillness_max_mg: self.stillness_max_mg,
            range_cone: self.range_cone,
            target_pitch_deg: select.target_pitch_deg,
            pitch_tolerance_deg: select.pitch_tolerance_deg,
            mount_pitch_rad,
        }
    }
}

/// `[select]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SelectSpec {
    /// Pitch at which the paper's errors are lowest.
    pub target_pitch_deg: f64,
    /// Half width of the window around it.
    pub pitch_tolerance_deg: f64,
    /// So many images, the surest ones, go into a fused size; all of them when left out.
    pub best_images: Option<NonZeroUsize>,
}

impl Default for SelectSpec {
    fn default() -> Self {
        let PoseSettings { target_pitch_deg, pitch_tolerance_deg, .. } = PoseSettings::with_mount(0.0);
        Self { target_pitch_deg, pitch_tolerance_deg, best_images: None }
    }
}

/// `[measure]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MeasureSpec {
    /// Methods, side by side on the same marks.
    pub methods: Vec<Method>,
}

impl Default for MeasureSpec {
    fn default() -> Self {
        Self { methods: Method::ALL.to_vec() }
    }
}

/// One `[[tables]]` entry; becomes a [`model::TableSpec`] when its printed files are read.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TableEntry {
    /// Short name, used in file names.
    pub id: String,
    /// Caption.
    pub title: String,
    /// Layout.
    pub layout: TableLayout,
    /// Objects, in the order of the rows.
    #[serde(default)]
    pub objects: Vec<String>,
    /// Kinds of container.
    #[serde(default)]
    pub kinds: Vec<Kind>,
    /// Quantities.
    pub quantities: Vec<Quantity>,
    /// Method.
    pub method: Method,
    /// Frames.
    pub selection: Selection,
    /// What a publication printed.
    #[serde(default)]
    pub printed: Option<PrintedFiles>,
    /// Footnotes.
    #[serde(default)]
    pub notes: Vec<Note>,
}

/// Where printed numbers stand in the study folder.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PrintedFiles {
    /// The publication.
    pub source: String,
    /// CSV of the printed rows.
    pub rows: String,
    /// CSV of the printed means and SDs.
    #[serde(default)]
    pub summaries: Option<String>,
}
