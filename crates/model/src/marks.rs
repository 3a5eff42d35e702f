//! Marks that a person or the program made on one picture.

use nalgebra::Point2;

use crate::codes::coded_enum;
use crate::container::Quantity;

coded_enum! {
    /// A closed curve of a container that can be outlined.
    Feature {
        Rim = "rim": "the upper edge, on the plane Z = H (a plate: on the table plane)",
        Base = "base": "the edge of the foot, on the table plane Z = 0",
    }
}

/// One mark, in pixels of the picture that it was made on.
#[derive(Debug, Clone, PartialEq)]
pub enum Mark {
    /// A line between two ends. For [`Quantity::Height`] it runs from the wall's foot on the table to the rim above it.
    Line {
        /// The size that the line shows.
        quantity: Quantity,
        /// The ends of the line.
        ends_px: [Point2<f64>; 2],
    },
    /// Points along a closed curve, in order.
    Outline {
        /// The curve that the points follow.
        feature: Feature,
        /// The points.
        points_px: Vec<Point2<f64>>,
    },
}

impl Mark {
    /// The points of the mark: the two ends of a line, or all points of an outline.
    #[must_use]
    pub fn points_px(&self) -> &[Point2<f64>] {
        match self {
            Self::Line { ends_px, .. } => ends_px,
            Self::Outline { points_px, .. } => points_px,
        }
    }
}

/// The marks of one object on one picture.
#[derive(Debug, Clone, PartialEq)]
pub struct ObjectMarks {
    /// Name of the object, as in objects.csv.
    pub object: String,
    /// The marks of the object, in the order of the file.
    pub marks: Vec<Mark>,
}

impl ObjectMarks {
    /// Whether every marked point lies in a picture of this width and height. A fitted rim may run over the border, while a
    /// point that was set by hand may not.
    #[must_use]
    pub fn inside_picture(&self, [width, height]: [u32; 2]) -> bool {
        let inside = |point: &Point2<f64>| {
            (0.0..=f64::from(width)).contains(&point.x) && (0.0..=f64::from(height)).contains(&point.y)
        };
        self.marks.iter().flat_map(Mark::points_px).all(inside)
    }
}
