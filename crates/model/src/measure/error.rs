//! The reasons why marks do not give a size.

use super::judge::APART;
use super::place::MarkPlace;
use crate::circle::CircleError;
use crate::container::Shape;
use crate::marks::Feature;
use crate::problem_code::ProblemCode;
use crate::view::ViewError;

/// The reason why marks do not give a size.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum MeasureError {
    /// A marked point has no place on its plane.
    #[error(transparent)]
    View(#[from] ViewError),
    /// An outline does not give a circle.
    #[error("{feature} outline: {source}")]
    Circle {
        /// The feature that was outlined.
        feature: Feature,
        /// The reason.
        source: CircleError,
    },
    /// A rim is marked, but its height is not known.
    #[error(
        "the rim's height is not known: mark a line OBJECT/height from the wall's foot on the table to the rim above it, \
         or the outlines OBJECT/rim and OBJECT/base of a round bowl, or give the rim height"
    )]
    NoHeight,
    /// The second end of a height line is not behind the first one.
    #[error(
        "the rim lies towards the wearer from the foot on the table plane: draw a height line from the wall's foot on the \
         table to the rim above it, and do not swap the outlines of rim and base"
    )]
    RimBelowFoot,
    /// The wall would be higher than the camera, which sees it from above.
    #[error(
        "a wall {height_mm:.0} mm high would reach above the camera, which is {camera_height_mm:.0} mm above the table"
    )]
    RimAboveCamera {
        /// The height that the marks give.
        height_mm: f64,
        /// Height of the camera above the table.
        camera_height_mm: f64,
    },
    /// The base of a bowl lies under the camera, so that the centres of rim and base cannot be told apart.
    #[error(
        "the bowl stands under the camera: rim and base share one centre in the picture; use a picture from the side"
    )]
    BaseUnderCamera,
    /// The ends of a line, or two corners, lie on one spot.
    #[error("the marked points lie on one spot: draw the mark again")]
    NoLength,
    /// Several marks of one size contradict each other, and none is in the majority.
    #[error(
        "{marks} marks of one size give {smallest_mm:.1} mm ({smallest}) to {largest_mm:.1} mm ({largest}), which differ by more \
         than {APART} of their uncertainties: correct the one that slipped"
    )]
    MarksDisagree {
        /// The number of marks.
        marks: usize,
        /// The smallest size that they give.
        smallest_mm: f64,
        /// The largest size that they give.
        largest_mm: f64,
        /// The mark of the smallest.
        smallest: MarkPlace,
        /// The mark of the largest.
        largest: MarkPlace,
    },
    /// The rim of a square or rectangle is not outlined by its four corners.
    #[error("rim outline of a {shape}: expected its 4 corners, got {points} points")]
    NotFourCorners {
        /// The shape of the object.
        shape: Shape,
        /// The number of points of the outline.
        points: usize,
    },
    /// The four corners of a square or rectangle do not follow each other around it, so that its diagonals would be taken for sides.
    #[error("rim outline of a {shape}: its 4 corners are not in order around it, or one lies within the others")]
    CornersNotInOrder {
        /// The shape of the object.
        shape: Shape,
    },
}

impl MeasureError {
    /// The stable code of the error, which stands in the `flags` of the results.
    #[must_use]
    pub const fn problem_code(&self) -> ProblemCode {
        match self {
            Self::View(_) => ProblemCode::MarkOffPlane,
            Self::Circle { source: CircleError::NotRound { .. }, .. } => ProblemCode::OutlineNotRound,
            Self::Circle { .. } => ProblemCode::NoCircle,
            Self::NoHeight => ProblemCode::NoHeight,
            Self::RimBelowFoot => ProblemCode::RimBelowFoot,
            Self::RimAboveCamera { .. } => ProblemCode::RimAboveCamera,
            Self::BaseUnderCamera => ProblemCode::BaseUnderCamera,
            Self::NoLength => ProblemCode::NoLength,
            Self::MarksDisagree { .. } => ProblemCode::MarksDisagree,
            Self::NotFourCorners { .. } | Self::CornersNotInOrder { .. } => ProblemCode::NotFourCorners,
        }
    }
}
