//! The numbers that a publication printed for a table.

use model::{PrintedRow, PrintedSummary, TableSpec};

/// A nominal setup of the bench: height of the camera above the table in mm, pitch in degrees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Setup {
    pub(super) height_mm: f64,
    pub(super) pitch_deg: f64,
}

impl Setup {
    /// The setup, where both numbers are there.
    pub(super) fn from_nominal(height_mm: Option<f64>, pitch_deg: Option<f64>) -> Option<Self> {
        Some(Self { height_mm: height_mm?, pitch_deg: pitch_deg? })
    }

    /// Whether two setups are the same. Their numbers are nominal, and written by hand in different files.
    pub(super) fn is(self, other: Self) -> bool {
        is_same(self.height_mm, other.height_mm) && is_same(self.pitch_deg, other.pitch_deg)
    }
}

/// Whether two nominal numbers, in mm or degrees, are the same.
pub(super) fn is_same(one: f64, other: f64) -> bool {
    (one - other).abs() < 1e-6
}

/// The printed rows of an object.
pub(super) fn rows<'a>(spec: &'a TableSpec, object: &str) -> Vec<&'a PrintedRow> {
    spec.printed.iter().flat_map(|printed| &printed.rows).filter(|row| row.object == object).collect()
}

/// The printed mean and SD of an object, or of the table.
pub(super) fn summary<'a>(spec: &'a TableSpec, object: Option<&str>) -> Option<&'a PrintedSummary> {
    spec.printed.iter().flat_map(|printed| &printed.summaries).find(|summary| summary.object.as_deref() == object)
}

/// Whether anything was printed.
pub(super) fn has_any(spec: &TableSpec) -> bool {
    spec.printed.as_ref().is_some_and(|printed| !printed.rows.is_empty() || !printed.summaries.is_empty())
}
