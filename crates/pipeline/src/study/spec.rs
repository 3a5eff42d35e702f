//! study.toml as it is written, with the defaults of keys that may be left out.

use std::num::NonZeroUsize;

use model::{Kind, Method, Note, Quantity, Selection, TableLayout};
use serde::{Deserialize, Serialize};

use super::{MarksSource, UncertaintySpec};
use crate::labelme::MarksFrame;
use crate::signals::{GravityCalibrate, PoseSettings, RangeCone, ReadingSettings};
use rims::{LEAST_DIAMETER_MM, RimShape};

/// The version of study.toml that this program reads.
pub(crate) const STUDY_SCHEMA_VERSION: u32 = 1;

/// study.toml. Unknown keys are refused.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StudySpec {
    /// The version of this layout: 1.
    pub schema_version: u32,
    /// The name of the study.
    pub name: String,
    /// A sentence that every report made from this study carries.
    #[serde(default)]
    pub statement: Option<String>,
    /// The IANA time zone for image times that name none.
    #[serde(default = "utc")]
    pub time_zone: String,
    /// The device profile: built in, or devices/NAME.toml.
    pub device_profile: String,
    /// The camera: built in, or devices/NAME.toml.
    pub camera: String,
    /// The marks, of people or of the program.
    #[serde(default)]
    pub marks: MarksSpec,
    /// The way the camera sits on the device.
    #[serde(default)]
    pub mount: MountSpec,
    /// The camera's clock against the sensors'.
    #[serde(default)]
    pub time: TimeSpec,
    /// The steps from samples to pitch, roll, stillness and range.
    #[serde(default)]
    pub signals: SignalsSpec,
    /// The images that count for fused sizes.
    #[serde(default)]
    pub select: SelectSpec,
    /// The steps from marks to sizes.
    #[serde(default)]
    pub measure: MeasureSpec,
    /// The standard uncertainties of the inputs.
    #[serde(default)]
    pub uncertainty: UncertaintySpec,
    /// The error tables that are made.
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
    /// The camera of the pictures that were marked, if those are not the raw ones.
    pub camera: Option<String>,
    /// The frame of people's marks on pictures that EXIF tells viewers to turn, where it is not known from the files.
    pub frame: Option<MarksFrame>,
    /// The source of the marks: people, the program, or both.
    pub source: MarksSource,
    /// Found rims with less confidence are left out.
    pub min_confidence: f64,
    /// Found rims that are narrower, in mm, are left out: cups, mugs and drinking glasses.
    pub min_diameter_mm: f64,
    /// The shapes of rims that the program looks for.
    pub shapes: Vec<RimShape>,
}

impl Default for MarksSpec {
    fn default() -> Self {
        Self {
            camera: None,
            frame: None,
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
    /// The mount offset: camera pitch = sensor pitch + this. The profile's when left out.
    pub pitch_offset_deg: Option<f64>,
}

/// `[time]`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct TimeSpec {
    /// The lag: sensor time = image time + this.
    pub image_lag_s: f64,
    /// Whether to work out that lag from the pictures. It is reported, not applied.
    pub estimate_lag: bool,
}

/// `[signals]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SignalsSpec {
    /// The -3 dB frequency of the low-pass that separates gravity from motion.
    pub gravity_cutoff_hz: f64,
    /// The largest departure of gravity's length from 1 g.
    pub gravity_tolerance_mg: f64,
    /// The RMS motion above which an image is not still.
    pub stillness_max_mg: f64,
    /// The width of the window around an image's time for the median range.
    pub range_window_s: f64,
    /// Shorter readings are no ranges.
    pub range_min_mm: f64,
    /// Longer readings are beyond the sensor's reach.
    pub range_max_mm: f64,
    /// The range sensor's own update period; records in between repeat its reading.
    pub range_update_s: f64,
    /// Whether the range is corrected for the sensor's cone; never for the method `paper`.
    pub range_cone: RangeCone,
    /// The correction of offsets and scales of the accelerometer.
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
    /// The pitch around which images are selected; by default the one at which the paper's errors are lowest.
    pub target_pitch_deg: f64,
    /// The half width of the window around that pitch.
    pub pitch_tolerance_deg: f64,
    /// The number of images, the surest ones, that go into a fused size; all of them when left out.
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
    /// The methods, side by side on the same marks.
    pub methods: Vec<Method>,
}

impl Default for MeasureSpec {
    fn default() -> Self {
        Self { methods: Method::ALL.to_vec() }
    }
}

/// One entry of `[[tables]]`. It becomes a [`model::TableSpec`] when its printed files are read.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TableEntry {
    /// The short name, used in file names.
    pub id: String,
    /// The caption.
    pub title: String,
    /// The layout.
    pub layout: TableLayout,
    /// The objects, in the order of the rows.
    #[serde(default)]
    pub objects: Vec<String>,
    /// The kinds of container.
    #[serde(default)]
    pub kinds: Vec<Kind>,
    /// The quantities.
    pub quantities: Vec<Quantity>,
    /// The method.
    pub method: Method,
    /// The frames that count.
    pub selection: Selection,
    /// The numbers that a publication printed.
    #[serde(default)]
    pub printed: Option<PrintedFiles>,
    /// The footnotes.
    #[serde(default)]
    pub notes: Vec<Note>,
}

/// The files of printed numbers in the study folder.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PrintedFiles {
    /// The publication.
    pub source: String,
    /// The CSV file of the printed rows.
    pub rows: String,
    /// The CSV file of the printed means and SDs.
    #[serde(default)]
    pub summaries: Option<String>,
}
