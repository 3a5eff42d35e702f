//! A rim that was found.

use model::{Feature, Kind, Mark, ObjectMarks, Shape, View};
use nalgebra::Point2;

use crate::evidence::{Evidence, SquareEvidence};
use crate::rim_height::RimHeight;

/// A rim found in a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Rim {
    /// From 0 to 1: how sure it is that this is the rim of a container.
    pub confidence: f64,
    /// The kind that it looks like: plates are flat and large.
    pub kind: Kind,
    /// Natural logarithm of the odds of a plate against a bowl.
    pub plate_log_odds: f64,
    /// The place of the rim's centre in the picture.
    pub center_px: Point2<f64>,
    /// Points along it, in order, where the picture shows it; of a rectangle its four corners.
    pub points_px: Vec<Point2<f64>>,
    /// Length of the rim in the picture, in pixels.
    pub perimeter_px: f64,
    /// The evidence for it.
    pub evidence: Evidence,
    /// The height of the rim above the table, if it is a bowl's.
    pub height: RimHeight,
    /// The height of the rim above the table, if it is a plate's.
    pub plate_height: RimHeight,
    /// Centre (world X, Y) and radius of the circle that it appears as on the plane Z = 0, in mm; of a rectangle a quarter of
    /// the sum of both sides.
    pub on_table_mm: ([f64; 2], f64),
    /// The evidence for a rectangle; none for a round rim.
    pub square: Option<SquareEvidence>,
}

impl Rim {
    /// The diameter of the rim in mm, if it is of the kind that it looks like.
    #[must_use]
    pub fn diameter_mm(&self, view: &View) -> f64 {
        let height = if self.kind == Kind::Plate { self.plate_height } else { self.height };
        2.0 * self.on_table_mm.1 * (1.0 - height.mm / view.pose().camera_height_mm())
    }

    /// The shape of its outline.
    #[must_use]
    pub fn shape(&self) -> Shape {
        if self.square.is_some() { Shape::Rectangle } else { Shape::Circle }
    }

    /// The marks that a person would have made.
    #[must_use]
    pub fn marks(&self, object: &str) -> ObjectMarks {
        let marks = vec![Mark::Outline { feature: Feature::Rim, points_px: self.points_px.clone() }];
        ObjectMarks { object: object.to_owned(), marks }
    }
}
