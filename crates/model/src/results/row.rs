//! The rows of `results.parquet` and `frames.parquet`, with one declaration for each column.

use serde::{Deserialize, Serialize};

use super::cell::{Cell, CellError, ColumnType, Value};
use super::level::Level;
use crate::container::{Kind, Method, Quantity, Shape};
use crate::frame_log::FrameReason;
use crate::fusion::Verdict;
use crate::time::UtcNs;

/// Version of both schemas. It rises when a column is removed, renamed, or changes its type, unit or meaning; a new
/// column at the end of a schema does not raise it.
pub const RESULTS_SCHEMA_VERSION: u32 = 2;

/// One column of a schema.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Column {
    /// The name, with the unit where there is one.
    pub name: &'static str,
    /// The type of the cells.
    pub column_type: ColumnType,
    /// Whether cells may be empty.
    pub nullable: bool,
    /// The meaning, as in the data dictionary.
    pub meaning: &'static str,
}

/// A row of a file with a fixed schema.
pub trait Row: Sized {
    /// The columns of the file.
    const COLUMNS: &'static [Column];

    /// The cells of the row, in the order of the columns.
    fn values(&self) -> Vec<Value>;

    /// The row with these cells.
    ///
    /// # Errors
    /// The name of the first column whose cell does not fit, and the reason.
    fn from_values(values: impl IntoIterator<Item = Value>) -> Result<Self, (&'static str, CellError)>;
}

macro_rules! schema {
    ($(#[$outer:meta])* $name:ident, $columns:ident { $($field:ident : $type:ty = $meaning:literal,)+ }) => {
        $(#[$outer])*
        #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
        pub struct $name { $(#[doc = $meaning] pub $field: $type,)+ }

        #[doc = concat!("The columns of [`", stringify!($name), "`].")]
        pub const $columns: &[Column] = &[$(Column {
            name: stringify!($field),
            column_type: <$type as Cell>::TYPE,
            nullable: <$type as Cell>::NULLABLE,
            meaning: $meaning,
        },)+];

        impl Row for $name {
            const COLUMNS: &'static [Column] = $columns;

            fn values(&self) -> Vec<Value> {
                vec![$(self.$field.to_value(),)+]
            }

            fn from_values(values: impl IntoIterator<Item = Value>) -> Result<Self, (&'static str, CellError)> {
                let mut values = values.into_iter();
                Ok(Self {
                    $($field: values
                        .next()
                        .ok_or(CellError::Missing)
                        .and_then(Cell::from_value)
                        .map_err(|error| (stringify!($field), error))?,)+
                })
            }
        }
    };
}

pub(super) use schema;

schema! {
    /// One row of `results.parquet`: a size of an object, by one rater and one method, from one image or fused.
    ResultRow, RESULT_COLUMNS {
        schema_version: u32 = "version of this schema",
        study: String = "name of the study",
        session: String = "name of the session: its folder below cards/",
        participant: Option<String> = "who wore the camera",
        object: String = "name of the object, as in objects.csv and the marks",
        kind: Kind = "plate, bowl or box",
        shape: Shape = "circle, square or rectangle",
        setup_height_mm: Option<f64> = "nominal height of the camera above the table, on a bench",
        setup_pitch_deg: Option<f64> = "nominal pitch, on a bench",
        rater: String = "who marked; all for consensus rows",
        image: Option<String> = "file of the image, relative to the card; empty for fused rows",
        time_utc: Option<UtcNs> = "time of the image; empty for fused rows",
        pitch_deg: Option<f64> = "depression of the optical axis below the horizontal; fused: mean of the images",
        roll_deg: Option<f64> = "roll, positive clockwise as the wearer sees it; fused: mean of the images",
        range_mm: Option<f64> = "distance to the table along the optical axis; fused: mean of the images",
        quantity: Quantity = "diameter, width, length or height",
        method: Method = "how marks became a size: paper, ray, coaxial, joint or best (docs/uncertainty.md)",
        level: Level = "frame (one image), fused (the selected images of the session) or consensus (those of all raters)",
        predicted_mm: Option<f64> = "the measured size; empty when it could not be measured (flags say why)",
        sigma_mm: Option<f64> = "standard uncertainty (k = 1) of predicted_mm from the sources below",
        sigma_pitch_mm: Option<f64> = "its part from the pitch of the device (accelerometer)",
        sigma_roll_mm: Option<f64> = "its part from the roll",
        sigma_range_mm: Option<f64> = "its part from the range",
        sigma_marks_mm: Option<f64> = "its part from the marks",
        sigma_camera_mm: Option<f64> = "its part from focal length, principal point and lens",
        plane_z_mm: Option<f64> = "height of the plane that the size was measured on",
        truth_mm: Option<f64> = "true size from objects.csv",
        error_pct: Option<f64> = "100 (predicted_mm - truth_mm) / truth_mm",
        selected: bool = "whether the image counts for fused rows: still, pitch within the target window; true for fused rows",
        frames: u32 = "number of images behind the row",
        spread_mm: Option<f64> = "sample SD between the images of a fused row, or between the raters of a consensus; empty for fewer than two",
        flags: String = "codes of what to know about the row, joined by commas: why the frame was not selected (docs/ledger.md), mark_outside_picture, corrected where a person has made or changed marks of the rater auto, inconsistent, outlier:IMAGE or outlier_rater:RATER for what lies too far off and counts less or not at all, mixed_methods for a consensus of best sizes by different methods, or why there is no size; empty when there is nothing",
        method_used: Option<Method> = "the method behind predicted_mm: for best the one that was taken, else the same as method; empty without a size",
        doubts: String = "assumptions of the method that are broken or not known to hold (docs/uncertainty.md), joined by commas; sigma_mm leaves them out; empty when there is nothing",
        sigma_mount_mm: Option<f64> = "part of sigma_mm from the angle of the camera on the device",
        sigma_common_mm: Option<f64> = "part of sigma_mm from what all images of the session share; it does not shrink with their number",
        wall_slope: Option<f64> = "radius of a round rim less that of its base, per height; joint: how far the rim overhangs its foot away from the wearer, per height",
        rank: Option<u32> = "rank of a selected image for this size, 1 being the surest; by sigma_mm, penalised for motion and unsteady range (docs/uncertainty.md)",
        weight: Option<f64> = "share of this image in the fused row",
        chi_squared: Option<f64> = "chi-square of what was fused about its mean, correlations counted",
        chi_squared_degrees: Option<u32> = "its degrees of freedom",
        consistency: Option<Verdict> = "whether what was fused differs by no more than its uncertainties allow: consistent or inconsistent",
        confidence: Option<f64> = "of a rim that the program found itself (docs/rims.md): how sure it is that it is a container's, 0 to 1; fused: mean of the images; empty for people's marks",
        sigma_disagreement_mm: Option<f64> = "part of sigma_mm from the disagreement of what was fused, where that is more than its uncertainties allow; 0 where they agree",
    }
}

schema! {
    /// One row of `frames.parquet`: an image of the study, kept or dropped, with one reason and the numbers behind it.
    FrameRow, FRAME_COLUMNS {
        schema_version: u32 = "version of this schema",
        study: String = "name of the study",
        session: String = "name of the session: its folder below cards/",
        participant: Option<String> = "who wore the camera",
        image: String = "file of the image, relative to the card",
        time_utc: Option<UtcNs> = "time of the image",
        reason: FrameReason = "why it was kept or dropped (docs/ledger.md)",
        bytes: u32 = "size of the file, in bytes (4294967295 for more)",
        width_px: Option<u32> = "width of the picture, from its header",
        height_px: Option<u32> = "height of the picture, from its header",
        gravity_mg: Option<f64> = "length of gravity after the low-pass, in 1/1000 of standard gravity",
        stillness_mg: Option<f64> = "RMS of the acceleration around gravity near the image's time",
        pitch_deg: Option<f64> = "depression of the optical axis below the horizontal",
        roll_deg: Option<f64> = "roll, positive clockwise as the wearer sees it",
        range_mm: Option<f64> = "distance to the table along the optical axis: median over a short window",
        range_spread_mm: Option<f64> = "robust SD (1.4826 MAD) of the range samples in the window",
        range_samples: u32 = "valid range samples in the window",
        raters: u32 = "number of raters with marks on the image",
        sizes: u32 = "number of sizes measured on the image, over raters and methods",
        range_distinct: u32 = "readings of the range sensor behind range_samples: values that it held over several records count once",
        flags: String = "codes of warnings about the image's signals, joined by commas (docs/ledger.md); empty when there are none",
        plate_sigma_mm: Option<f64> = "of a selected image: standard uncertainty that a plate of 200 mm would have, marked by its rim where the camera looks, penalised for motion and unsteady range (docs/uncertainty.md)",
        rank: Option<u32> = "rank of a selected image of its session by plate_sigma_mm, 1 being the surest: the ones to mark first",
    }
}

schema! {
    /// The columns of `frames.parquet` that the flow of images needs, so that a year of images is read at a few bytes each.
    FlowRow, FLOW_COLUMNS {
        session: String = "name of the session",
        reason: FrameReason = "why the image was kept or dropped",
        raters: u32 = "raters with marks on the image",
        sizes: u32 = "sizes measured on the image",
    }
}

impl ResultRow {
    /// A row of level frame for a round object on a selected image, without any numbers. It is a start where only some columns
    /// matter, as in tests and examples. The names of study, session and rater are empty.
    #[must_use]
    pub fn without_numbers(object: &str, kind: Kind, quantity: Quantity, method: Method) -> Self {
        Self {
            schema_version: RESULTS_SCHEMA_VERSION,
            study: String::new(),
            session: String::new(),
            participant: None,
            object: object.to_owned(),
            kind,
            shape: Shape::Circle,
            setup_height_mm: None,
            setup_pitch_deg: None,
            rater: String::new(),
            image: None,
            time_utc: None,
            pitch_deg: None,
            roll_deg: None,
            range_mm: None,
            quantity,
            method,
            level: Level::Frame,
            predicted_mm: None,
            sigma_mm: None,
            sigma_pitch_mm: None,
            sigma_roll_mm: None,
            sigma_range_mm: None,
            sigma_marks_mm: None,
            sigma_camera_mm: None,
            plane_z_mm: None,
            truth_mm: None,
            error_pct: None,
            selected: true,
            frames: 1,
            spread_mm: None,
            flags: String::new(),
            method_used: None,
            doubts: String::new(),
            sigma_mount_mm: None,
            sigma_common_mm: None,
            wall_slope: None,
            rank: None,
            weight: None,
            chi_squared: None,
            chi_squared_degrees: None,
            consistency: None,
            confidence: None,
            sigma_disagreement_mm: None,
        }
    }
}

impl FrameRow {
    /// The row of an image of which only the names and the reason are known.
    #[must_use]
    pub fn without_numbers(study: &str, session: &str, image: &str, reason: FrameReason) -> Self {
        Self {
            schema_version: RESULTS_SCHEMA_VERSION,
            study: study.to_owned(),
            session: session.to_owned(),
            participant: None,
            image: image.to_owned(),
            time_utc: None,
            reason,
            bytes: 0,
            width_px: None,
            height_px: None,
            gravity_mg: None,
            stillness_mg: None,
            pitch_deg: None,
            roll_deg: None,
            range_mm: None,
            range_spread_mm: None,
            range_samples: 0,
            raters: 0,
            sizes: 0,
            range_distinct: 0,
            flags: String::new(),
            plate_sigma_mm: None,
            rank: None,
        }
    }
}
