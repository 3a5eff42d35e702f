//! The table objects.csv.

use model::{Kind, Shape};
use serde::Serialize;

/// A row of objects.csv (docs/study.md).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ObjectRow {
    /// Its name.
    pub object: String,
    /// Whether it is a plate, a bowl or a box.
    pub kind: Kind,
    /// Its outline.
    pub shape: Shape,
    /// Diameter of a round rim.
    pub true_diameter_mm: Option<f64>,
    /// Side of a square, or short side of a rectangle.
    pub true_width_mm: Option<f64>,
    /// Long side of a rectangle.
    pub true_length_mm: Option<f64>,
    /// Height of the rim above the table, where it is to be measured.
    pub true_height_mm: Option<f64>,
    /// Height of the rim above the table, where it is known beforehand.
    pub rim_height_mm: Option<f64>,
}
