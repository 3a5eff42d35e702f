//! What a person (or a detector) marked on one picture.

use nalgebra::Point2;

use crate::codes::coded_enum;
use crate::container::Quantity;

coded_enum! {
    /// A closed curve of a container.
    Feature {
        Rim = "rim": "the upper edge, on the plane Z = H (a plate: on the table plane)",
        Base = "base": "the edge of the foot, on the table plane Z = 0",
    }
}

/// One mark, in pixels of the picture that was marked.
#[derive(Debug, Clone, PartialEq)]
pub enum Mark {
    /// A line between two ends. For [`Quantity::Height`]: from the wall's foot on the table to the rim above it.
    Line {
        /// What its length is.
        quantity: Quantity,
        /// Its ends.
        ends_px: [Point2<f64>; 2],
    },
    /// Points along a closed curve, in order.
    Outline {
        /// Which curve.
        feature: Feature,
        /// The points.
        points_px: Vec<Point2<f64>>,
    },
}

impl Mark {
    /// Its points.
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
    /// Its marks, in file order.
    pub marks: Vec<Mark>,
}

impl ObjectMarks {
    /// Whether every point lies in a picture of this width and height. A fitted rim may run over the border; a point set
    /// by hand may not.
    #[must_use]
    pub fn inside_picture(&self, [width, height]: [u32; 2]) -> bool {
        let inside = |point: &Point2<f64>| {
            (0.0..=f64::from(width)).contains(&point.x) && (0.0..=f64::from(height)).contains(&point.y)
        };
        self.marks.iter().flat_map(Mark::points_px).all(inside)
    }
}
