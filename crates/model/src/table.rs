//! The error tables that a study asks for, with the numbers that a publication printed for them. They travel inside the
//! results file, so that a report needs nothing else.

use serde::{Deserialize, Serialize};

use crate::codes::coded_enum;
use crate::container::{Kind, Method, Quantity};

coded_enum! {
    /// The layout of an error table, which decides its rows and its statistics.
    TableLayout {
        Setups = "setups": "one row per object and bench setup; mean and sample SD (n - 1) per object and overall (Tables II-IV)",
        Raters = "raters": "one row per object, one column per rater; the error is that of the raters' mean; mean and population SD (n) over rows (Tables V, VI)",
    }
}

coded_enum! {
    /// The selection of frames that a table is made from.
    Selection {
        All = "all": "every measured frame, whatever its pitch",
        NearTarget = "near_target": "only selected frames: still, with pitch near the target",
    }
}

/// The specification of one error table.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TableSpec {
    /// Short name, used in file names: 'II' gives table_II.csv.
    pub id: String,
    /// Caption of the table.
    pub title: String,
    /// The layout. `setups` uses rows of level `frame`, and `raters` rows of level `fused`.
    pub layout: TableLayout,
    /// The quantities that the table covers.
    pub quantities: Vec<Quantity>,
    /// The method that measured the sizes.
    pub method: Method,
    /// The frames that count.
    pub selection: Selection,
    /// The objects in the order of the rows; empty for all objects of `kinds`, in the order of their names.
    #[serde(default)]
    pub objects: Vec<String>,
    /// The kinds of container; empty for all kinds.
    #[serde(default)]
    pub kinds: Vec<Kind>,
    /// The numbers that a publication printed for the same table.
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
    /// The publication that printed them.
    pub source: String,
    /// The printed rows.
    pub rows: Vec<PrintedRow>,
    /// The printed means and SDs, per object and overall.
    pub summaries: Vec<PrintedSummary>,
}

/// One printed row. The layout of the table decides which fields it has.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PrintedRow {
    /// Name of the object, as in objects.csv.
    pub object: String,
    /// Nominal height of the camera above the table (`setups`).
    pub setup_height_mm: Option<f64>,
    /// Nominal pitch (`setups`).
    pub setup_pitch_deg: Option<f64>,
    /// The rater (`raters`; there is one printed row per rater).
    pub rater: Option<String>,
    /// The printed prediction.
    pub predicted_mm: Option<f64>,
    /// The printed true size.
    pub truth_mm: Option<f64>,
    /// The printed error (`raters`: that of the raters' mean, which is the same in each row of the object).
    pub error_pct: Option<f64>,
}

/// A printed mean and SD of errors.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PrintedSummary {
    /// Name of the object; `None` for the whole table.
    pub object: Option<String>,
    /// The printed mean.
    pub mean_pct: f64,
    /// The printed SD.
    pub sd_pct: f64,
}

/// A footnote of a table.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Note {
    /// The object whose rows carry the note; `None` for the whole table, whose overall row carries it.
    #[serde(default)]
    pub object: Option<String>,
    /// The nominal height of the setup to whose row the note is restricted.
    #[serde(default)]
    pub setup_height_mm: Option<f64>,
    /// The nominal pitch of the setup to whose row the note is restricted.
    #[serde(default)]
    pub setup_pitch_deg: Option<f64>,
    /// The text of the note.
    pub text: String,
}
