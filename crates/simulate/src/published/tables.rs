//! The published numbers, as they are printed in the paper.

use model::Quantity;
use serde::Deserialize;
use serde::de::DeserializeOwned;

use crate::error::SimulateError;

/// The raters of Tables V and VI.
pub(super) const RATERS: [&str; 4] = ["RA1", "RA2", "RA3", "RA4"];

/// A row of Tables II-IV.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SetupRow {
    pub object: String,
    pub height_cm: f64,
    pub pitch_deg: f64,
    pub range_mm: f64,
    pub predicted_cm: f64,
    pub original_cm: f64,
    pub error_pct: f64,
}

/// A row of Tables V and VI.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RaterRow {
    pub object: String,
    pub quantity: Quantity,
    ra1_cm: f64,
    ra2_cm: f64,
    ra3_cm: f64,
    ra4_cm: f64,
    /// The 'ground truth' as it is printed. In Table VI it is by mistake the mean of the raters.
    pub printed_truth_cm: f64,
    /// The ground truth from which the printed error follows.
    pub implied_truth_cm: f64,
    pub error_pct: f64,
}

impl RaterRow {
    /// The values of the raters, in the order of [`RATERS`].
    pub(super) fn predicted_cm(&self) -> [f64; 4] {
        [self.ra1_cm, self.ra2_cm, self.ra3_cm, self.ra4_cm]
    }
}

/// A printed mean and SD of an object, or overall.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SummaryRow {
    pub object: Option<String>,
    pub mean_pct: f64,
    pub sd_pct: f64,
}

/// A table and its printed means.
#[derive(Debug, Clone)]
pub(super) struct Table<R> {
    pub id: &'static str,
    pub rows: Vec<R>,
    pub summaries: Vec<SummaryRow>,
}

/// Tables II-VI.
#[derive(Debug, Clone)]
pub(super) struct Published {
    pub plates: Table<SetupRow>,
    pub bowl_heights: Table<SetupRow>,
    pub bowl_diameters: Table<SetupRow>,
    pub container_sizes: Table<RaterRow>,
    pub container_heights: Table<RaterRow>,
}

macro_rules! table {
    ($id:literal) => {
        Ok::<_, SimulateError>(Table {
            id: $id,
            rows: rows(concat!("table_", $id, ".csv"), include_str!(concat!("tables/table_", $id, ".csv")))?,
            summaries: rows(
                concat!("table_", $id, "_summary.csv"),
                include_str!(concat!("tables/table_", $id, "_summary.csv")),
            )?,
        })
    };
}

impl Published {
    /// The tables, from the files in this crate.
    pub(super) fn load() -> Result<Self, SimulateError> {
        Ok(Self {
            plates: table!("II")?,
            bowl_heights: table!("III")?,
            bowl_diameters: table!("IV")?,
            container_sizes: table!("V")?,
            container_heights: table!("VI")?,
        })
    }

    /// The first row of every setup: its height, pitch and range.
    pub(super) fn setups(&self) -> Vec<&SetupRow> {
        let Some(first) = self.plates.rows.first() else { return Vec::new() };
        self.plates.rows.iter().filter(|row| row.object == first.object).collect()
    }
}

impl Table<SetupRow> {
    /// The row of `object` at the setup of `like`.
    pub(super) fn at_setup(&self, object: &str, like: &SetupRow) -> Result<&SetupRow, SimulateError> {
        // The numbers are printed as whole numbers, so equal ones mean the same setup.
        let same = |a: f64, b: f64| (a - b).abs() < 0.01;
        let found = self.rows.iter().find(|row| {
            row.object == object && same(row.height_cm, like.height_cm) && same(row.pitch_deg, like.pitch_deg)
        });
        found.ok_or_else(|| SimulateError::NoReading {
            table: self.id,
            object: object.to_owned(),
            height_cm: like.height_cm,
            pitch_deg: like.pitch_deg,
        })
    }

    /// The objects, in the order of their first rows.
    pub(super) fn objects(&self) -> Vec<&str> {
        let mut objects: Vec<&str> = self.rows.iter().map(|row| row.object.as_str()).collect();
        objects.dedup();
        objects
    }
}

fn rows<T: DeserializeOwned>(name: &str, text: &str) -> Result<Vec<T>, SimulateError> {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
    reader
        .deserialize()
        .collect::<Result<_, _>>()
        .map_err(|source| SimulateError::Csv { name: name.to_owned(), source })
}
