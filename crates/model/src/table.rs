//! Which error tables a study asks for, and what was printed for them elsewhere. Travels inside the results file, so that
//! a report needs nothing else.

use serde::{Deserialize, Serialize};

use crate::codes::coded_enum;
use crate::container::{Kind, Method, Quantity};

coded_enum! {
    /// How the rows of a table are made, and with them its statistics.
    TableLayout {
        Setups = "setups": "one row per object and bench setup; mean and sample SD (n - 1) per object and overall (Tables II-IV)",
        Raters = "raters": "one row per object, one column per rater; the error is that of the raters' mean; mean and population SD (n) over rows (Tables V, VI)",
    }
}

coded_enum! {
    /// Which frames a table is made from.
    Selection {
        All = "all": "every measured frame, whatever its pitch",
        NearTarget = "near_target": "only selected frames: still, with pitch near the target",
    }
}

/// One error table.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TableSpec {
    /// Short name, used in file names: 'II' gives table_II.csv.
    pub id: String,
    /// Caption.
    pub title: String,
    /// Layout. `setups` uses rows of level `frame`, `raters` rows of level `fused`.
    pub layout: TableLayout,
    /// Quantities, any of them.
    pub quantities: Vec<Quantity>,
    /// Method.
    pub method: Method,
    /// Frames.
    pub selection: Selection,
    /// Objects in the order of the rows; empty for all objects of `kinds` in the order of their names.
    #[serde(default)]
    pub objects: Vec<String>,
    /// Kinds of container; empty for all.
    #[serde(default)]
    pub kinds: Vec<Kind>,
    /// What a publication printed for the same table.
    #[serde(default)]
    pub printed: Option<PrintedTable>,
    /// Footnotes, for instance misprints.
    #[serde(default)]
    pub notes: Vec<Note>,
}

/// The numbers of a published table.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PrintedTable {
    /// Where they were printed.
    pub source: String,
    /// Rows.
    pub rows: Vec<PrintedRow>,
    /// Means and SDs, per object and overall.
    pub summaries: Vec<PrintedSummary>,
}

/// One printed row. Which fields it has depends on the layout.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PrintedRow {
    /// Object, as in objects.csv.
    pub object: String,
    /// Nominal height of the camera above the table (`setups`).
    pub setup_height_mm: Option<f64>,
    /// Nominal pitch (`setups`).
    pub setup_pitch_deg: Option<f64>,
    /// Rater (`raters`; one printed row per rater).
    pub rater: Option<String>,
    /// Printed prediction.
    pub predicted_mm: Option<f64>,
    /// Printed true size.
    pub truth_mm: Option<f64>,
    /// Printed error (`raters`: that of the raters' mean, the same in each of the object's rows).
    pub error_pct: Option<f64>,
}

/// A printed mean and SD of errors.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PrintedSummary {
    /// Object, or none for the whole table.
    pub object: Option<String>,
    /// Printed mean.
    pub mean_pct: f64,
    /// Printed SD.
    pub sd_pct: f64,
}

/// A footnote.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Note {
    /// The object whose rows it marks; none for the whole table (marked at the overall row).
    #[serde(default)]
    pub object: Option<String>,
    /// Restricts it to the row of one setup: nominal height.
    #[serde(default)]
    pub setup_height_mm: Option<f64>,
    /// Restricts it to the row of one setup: nominal pitch.
    #[serde(default)]
    pub setup_pitch_deg: Option<f64>,
    /// What the reader must know.
    pub text: String,
}
