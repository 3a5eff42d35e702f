//! How samples lie in CSV files.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{Epoch, TimeUnit};

/// The form of a CSV file, whatever its columns.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CsvFormat {
    /// The separator of columns: one ASCII character.
    pub delimiter: char,
    /// Lines before the line of column names.
    pub skip_lines: u32,
    /// Whether there is a line of column names; without one, columns are called `#1`, `#2` and so on.
    pub header: bool,
    /// Whether numbers have a comma where others have a point.
    pub decimal_comma: bool,
    /// Other names that a column may have, by the name that the profile uses.
    pub other_names: BTreeMap<String, Vec<String>>,
}

impl Default for CsvFormat {
    fn default() -> Self {
        let other_names = BTreeMap::new();
        Self { delimiter: comma(), skip_lines: 0, header: yes(), decimal_comma: false, other_names }
    }
}

fn comma() -> char {
    ','
}

fn yes() -> bool {
    true
}

/// The source of a row's time: exactly one of `column` and `rows_per_s` and `rows_over_s`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RowTime {
    /// The column with the time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub column: Option<String>,
    /// Unit of its numbers. Either this or `format`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<TimeUnit>,
    /// strptime pattern of its texts; one without a zone is in the study's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub format: Option<String>,
    /// The zero of its numbers.
    pub epoch: Epoch,
    /// The counter starts anew after 2^`wrap_bits` units.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wrap_bits: Option<u32>,
    /// There is no column: so many rows are a second, from the anchor on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rows_per_s: Option<f64>,
    /// There is no column: the rows of a file are spread evenly over so many seconds, from the anchor on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rows_over_s: Option<f64>,
}

// The keys of the file stand in both tables: serde cannot flatten a struct where unknown keys are refused.

/// Columns of an accelerometer's CSV file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AccelerationColumns {
    /// Time.
    pub time: RowTime,
    /// Sensor x, in counts.
    pub x: String,
    /// Sensor y, in counts.
    pub y: String,
    /// Sensor z, in counts.
    pub z: String,
    /// The separator of columns: one ASCII character.
    #[serde(default = "comma")]
    pub delimiter: char,
    /// Lines before the line of column names.
    #[serde(default)]
    pub skip_lines: u32,
    /// Whether there is a line of column names; without one, columns are called `#1`, `#2` and so on.
    #[serde(default = "yes")]
    pub header: bool,
    /// Whether numbers have a comma where others have a point.
    #[serde(default)]
    pub decimal_comma: bool,
    /// Other names that a column may have, by the name that is used above: for exports whose names changed.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub other_names: BTreeMap<String, Vec<String>>,
}

/// Columns of a range sensor's CSV file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RangeColumns {
    /// Time.
    pub time: RowTime,
    /// Reading, in counts.
    pub range: String,
    /// The separator of columns: one ASCII character.
    #[serde(default = "comma")]
    pub delimiter: char,
    /// Lines before the line of column names.
    #[serde(default)]
    pub skip_lines: u32,
    /// Whether there is a line of column names; without one, columns are called `#1`, `#2` and so on.
    #[serde(default = "yes")]
    pub header: bool,
    /// Whether numbers have a comma where others have a point.
    #[serde(default)]
    pub decimal_comma: bool,
    /// Other names that a column may have, by the name that is used above: for exports whose names changed.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub other_names: BTreeMap<String, Vec<String>>,
}

impl AccelerationColumns {
    /// The form of the file.
    #[must_use]
    pub fn format(&self) -> CsvFormat {
        let Self { delimiter, skip_lines, header, decimal_comma, .. } = *self;
        CsvFormat { delimiter, skip_lines, header, decimal_comma, other_names: self.other_names.clone() }
    }
}

impl RangeColumns {
    /// The form of the file.
    #[must_use]
    pub fn format(&self) -> CsvFormat {
        let Self { delimiter, skip_lines, header, decimal_comma, .. } = *self;
        CsvFormat { delimiter, skip_lines, header, decimal_comma, other_names: self.other_names.clone() }
    }
}
