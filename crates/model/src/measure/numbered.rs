//! The marks of an object, with a number for every marked point.

use nalgebra::Point2;

use super::height::HeightLine;
use crate::container::Quantity;
use crate::marks::{Feature, Mark, ObjectMarks};

/// Marks with the number of their first point: derivatives by marks are kept in the order of those numbers.
pub(crate) struct Numbered<'a> {
    marks: Vec<(usize, &'a Mark)>,
    /// How many points there are.
    pub points: usize,
}

impl<'a> Numbered<'a> {
    pub(crate) fn from_marks(marks: &'a ObjectMarks) -> Self {
        let mut points = 0;
        let number = |mark: &'a Mark| {
            let first = points;
            points += mark.points_px().len();
            (first, mark)
        };
        Self { marks: marks.marks.iter().map(number).collect(), points }
    }

    /// Lines of a quantity, with the number of their first end.
    pub(super) fn lines(&self, wanted: Quantity) -> impl Iterator<Item = (usize, [Point2<f64>; 2])> + '_ {
        self.marks.iter().filter_map(move |(first, mark)| match mark {
            Mark::Line { quantity, ends_px } if *quantity == wanted => Some((*first, *ends_px)),
            Mark::Line { .. } | Mark::Outline { .. } => None,
        })
    }

    pub(crate) fn height_lines(&self) -> impl Iterator<Item = HeightLine> + '_ {
        self.lines(Quantity::Height).map(|(n, [foot, rim])| HeightLine { foot: (n, foot), rim: (n + 1, rim) })
    }

    /// Outlines of a feature, with the number of their first point.
    pub(super) fn outlines(&self, wanted: Feature) -> impl Iterator<Item = (usize, &'a [Point2<f64>])> + '_ {
        self.marks.iter().filter_map(move |(first, mark)| match mark {
            Mark::Outline { feature, points_px } if *feature == wanted => Some((*first, points_px.as_slice())),
            Mark::Line { .. } | Mark::Outline { .. } => None,
        })
    }

    /// All points along a feature, with their numbers: an edge that something hides in part may be marked in pieces.
    pub(super) fn along(&self, wanted: Feature) -> Vec<(usize, Point2<f64>)> {
        self.outlines(wanted).flat_map(|(first, points)| (first..).zip(points.iter().copied())).collect()
    }
}
