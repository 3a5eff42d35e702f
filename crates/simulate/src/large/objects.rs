//! The containers of the study: their sizes, their places on the table, and their exact marks.

use model::{Kind, Quantity, Shape, View, ViewError};
use nalgebra::{Point2, Point3, Vector2};
use serde::Serialize;

use crate::scene::{Bowl, Colour, Outline, Plate, Scene, Solid, Tub};
use crate::study::{LabeledLine, ObjectRow};

/// Radius of a bowl's foot, as a share of that of its rim.
const FOOT_SHARE: f64 = 0.6;

/// A container of the study.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Object {
    pub name: &'static str,
    pub kind: Kind,
    pub shape: Shape,
    /// The size across that is marked: the diameter, the side, or the long side.
    span_mm: f64,
    /// Short side of a rectangle.
    width_mm: Option<f64>,
    height_mm: Option<f64>,
    colour: Colour,
}

/// The containers of the study. Plates have no height that could be measured. The wall of a bowl is not upright, so only its
/// diameter is marked, and its rim height is given beforehand. Of a box both are marked.
pub(super) const OBJECTS: [Object; 5] = [
    Object::plate("dinner plate", Shape::Circle, 240.0, [238.0, 234.0, 224.0]),
    Object::plate("side plate", Shape::Circle, 170.0, [214.0, 222.0, 232.0]),
    Object::plate("square plate", Shape::Square, 200.0, [232.0, 228.0, 212.0]),
    Object {
        name: "soup bowl",
        kind: Kind::Bowl,
        shape: Shape::Circle,
        span_mm: 160.0,
        width_mm: None,
        height_mm: Some(55.0),
        colour: [196.0, 214.0, 226.0],
    },
    Object {
        name: "lunch box",
        kind: Kind::Box,
        shape: Shape::Rectangle,
        span_mm: 180.0,
        width_mm: Some(120.0),
        height_mm: Some(50.0),
        colour: [128.0, 186.0, 122.0],
    },
];

/// True sizes of a container, as in objects.csv and truth.parquet.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(super) struct TrueSizes {
    pub true_diameter_mm: Option<f64>,
    pub true_width_mm: Option<f64>,
    pub true_length_mm: Option<f64>,
    pub true_height_mm: Option<f64>,
}

impl Object {
    const fn plate(name: &'static str, shape: Shape, span_mm: f64, colour: Colour) -> Self {
        Self { name, kind: Kind::Plate, shape, span_mm, width_mm: None, height_mm: None, colour }
    }

    pub(super) fn true_sizes(&self) -> TrueSizes {
        let across = |shape: Shape| (self.shape == shape).then_some(self.span_mm);
        TrueSizes {
            true_diameter_mm: across(Shape::Circle),
            true_width_mm: across(Shape::Square).or(self.width_mm),
            true_length_mm: across(Shape::Rectangle),
            true_height_mm: self.height_mm,
        }
    }

    pub(super) fn row(&self) -> ObjectRow {
        let TrueSizes { true_diameter_mm, true_width_mm, true_length_mm, true_height_mm } = self.true_sizes();
        ObjectRow {
            object: self.name.to_owned(),
            kind: self.kind,
            shape: self.shape,
            true_diameter_mm,
            true_width_mm,
            true_length_mm,
            true_height_mm,
            rim_height_mm: self.height_mm.filter(|_| self.kind == Kind::Bowl),
        }
    }

    /// The scene of the container with its middle at the point where the optical axis meets the table.
    pub(super) fn scene(&self, view: &View) -> Scene {
        let center_mm = axis_point_mm(view);
        let half_mm = 0.5 * self.span_mm;
        let height_mm = self.height_mm.unwrap_or_default();
        let solid = match self.kind {
            Kind::Plate => {
                let outline = if self.shape == Shape::Circle { Outline::Circle } else { Outline::Square };
                Solid::Plate(Plate { center_mm, half_width_mm: half_mm, outline })
            }
            Kind::Bowl => {
                Solid::Bowl(Bowl { center_mm, foot_radius_mm: FOOT_SHARE * half_mm, rim_radius_mm: half_mm, height_mm })
            }
            Kind::Box => {
                Solid::Tub(Tub { center_mm, half_size_mm: Vector2::new(half_mm, self.half_width_mm()), height_mm })
            }
        };
        Scene { solid, colour: self.colour }
    }

    /// The marks of a rater who never errs: the size across on the rim's plane, and of a box the height of its near wall.
    pub(super) fn marks(&self, view: &View) -> Result<Vec<LabeledLine>, ViewError> {
        let center_mm = axis_point_mm(view);
        let rim_z_mm = self.height_mm.unwrap_or_default();
        let line = |quantity, ends_mm: [Point3<f64>; 2]| {
            let [a, b] = ends_mm.map(|end| view.pixel_of(end));
            Ok::<_, ViewError>(LabeledLine { object: self.name.to_owned(), quantity, ends_px: [a?, b?] })
        };
        let end = |side: f64| Point3::new(center_mm.x + side * 0.5 * self.span_mm, center_mm.y, rim_z_mm);
        let mut lines = vec![line(self.span(), [end(-1.0), end(1.0)])?];
        if self.kind == Kind::Box {
            let near = |z_mm: f64| Point3::new(center_mm.x, center_mm.y - self.half_width_mm(), z_mm);
            lines.push(line(Quantity::Height, [near(0.0), near(rim_z_mm)])?);
        }
        Ok(lines)
    }

    fn span(&self) -> Quantity {
        match self.shape {
            Shape::Circle => Quantity::Diameter,
            Shape::Square => Quantity::Width,
            Shape::Rectangle => Quantity::Length,
        }
    }

    fn half_width_mm(&self) -> f64 {
        0.5 * self.width_mm.unwrap_or(self.span_mm)
    }
}

/// The point where the optical axis meets the table, in mm.
fn axis_point_mm(view: &View) -> Point2<f64> {
    Point2::new(0.0, view.pose().camera_height_mm() / view.pose().pitch_rad().tan())
}
