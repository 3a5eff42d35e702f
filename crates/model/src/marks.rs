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

/// The marks of one object on one picture.
#[derive(Debug, Clone, PartialEq)]
pub struct ObjectMarks {
    /// Name of the object, as in objects.csv.
    pub object: String,
    /// Its marks, in file order.
    pub marks: Vec<Mark>,
}
