//! Where a mark is in its picture, so that a person finds it among others.

use std::fmt::{Display, Formatter};

use nalgebra::Point2;

use crate::marks::Mark;

/// A mark by its form and its middle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MarkPlace {
    /// Whether it is an outline; a line otherwise.
    pub is_outline: bool,
    /// The mean of its points, in pixels of the stored picture.
    pub middle_px: Point2<f64>,
}

impl MarkPlace {
    /// The place of a mark.
    #[must_use]
    pub(super) fn of(mark: &Mark) -> Self {
        let points_px = mark.points_px();
        #[expect(clippy::cast_precision_loss, reason = "a count of marks is far below 2^53")]
        let count = points_px.len().max(1) as f64;
        let sum = points_px.iter().fold(Point2::origin(), |sum, point| sum + point.coords);
        Self { is_outline: matches!(mark, Mark::Outline { .. }), middle_px: sum / count }
    }
}

impl Display for MarkPlace {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        let form = if self.is_outline { "outline" } else { "line" };
        write!(f, "{form} about pixel ({:.0}, {:.0})", self.middle_px.x, self.middle_px.y)
    }
}
