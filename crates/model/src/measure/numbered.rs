//! The marks of an object with a number for every marked point.

use nalgebra::Point2;

use super::MeasureError;
use super::height::{HeightLine, leaning_mm};
use super::judge::Judge;
use super::place::MarkPlace;
use crate::container::Quantity;
use crate::marks::{Feature, Mark, ObjectMarks};
use crate::view::View;

/// The marks of an object, each with the number of its first point. Derivatives by marks stand in the order of the numbers.
pub(crate) struct Numbered<'a> {
    marks: Vec<(usize, &'a Mark)>,
    /// The number of all points.
    pub points: usize,
}

impl<'a> Numbered<'a> {
    /// The marks with their points numbered from 0, in the order of the file.
    pub(crate) fn from_marks(marks: &'a ObjectMarks) -> Self {
        let mut points = 0;
        let number = |mark: &'a Mark| {
            let first = points;
            points += mark.points_px().len();
            (first, mark)
        };
        Self { marks: marks.marks.iter().map(number).collect(), points }
    }

    /// The lines of a quantity, each with the number of its first end.
    pub(super) fn lines(&self, wanted: Quantity) -> impl Iterator<Item = (usize, [Point2<f64>; 2])> + '_ {
        self.marks.iter().filter_map(move |(first, mark)| match mark {
            Mark::Line { quantity, ends_px } if *quantity == wanted => Some((*first, *ends_px)),
            Mark::Line { .. } | Mark::Outline { .. } => None,
        })
    }

    /// The lines of heights, each from foot to rim.
    pub(crate) fn height_lines(&self) -> impl Iterator<Item = HeightLine> + '_ {
        self.lines(Quantity::Height).map(|(n, [foot, rim])| HeightLine { foot: (n, foot), rim: (n + 1, rim) })
    }

    /// The height lines without those that contradict the majority. Lines that give no height by their rays, as those of a wall that
    /// leans over its foot, are not judged.
    pub(crate) fn agreeing_height_lines(&self, view: &View, judge: &Judge) -> Result<Vec<HeightLine>, MeasureError> {
        let lines: Vec<HeightLine> = self.height_lines().collect();
        let heights: Result<Vec<_>, _> = lines.iter().map(|line| line.by_ray(view, self.points)).collect();
        let Ok(heights) = heights else { return Ok(lines) };
        let kept = judge
            .agreeing(&heights, |a, b| leaning_mm(view, &lines, &heights, [a, b]))
            .map_err(|apart| apart.error(&heights, |i| self.place(lines[i].foot.0)))?;
        Ok(lines.into_iter().enumerate().filter(|(i, _)| kept.contains(i)).map(|(_, line)| line).collect())
    }

    /// The place of the mark that has this point.
    pub(super) fn place(&self, point: usize) -> MarkPlace {
        let of_point = self.marks.iter().rev().find(|(first, _)| *first <= point);
        of_point.map_or(MarkPlace { is_outline: false, middle_px: Point2::origin() }, |(_, mark)| MarkPlace::of(mark))
    }

    /// The outlines of a feature, each with the number of its first point.
    pub(super) fn outlines(&self, wanted: Feature) -> impl Iterator<Item = (usize, &'a [Point2<f64>])> + '_ {
        self.marks.iter().filter_map(move |(first, mark)| match mark {
            Mark::Outline { feature, points_px } if *feature == wanted => Some((*first, points_px.as_slice())),
            Mark::Line { .. } | Mark::Outline { .. } => None,
        })
    }

    /// All points along a feature with their numbers, over all its outlines: an edge that is hidden in part may be marked in
    /// pieces.
    pub(super) fn along(&self, wanted: Feature) -> Vec<(usize, Point2<f64>)> {
        self.outlines(wanted).flat_map(|(first, points)| (first..).zip(points.iter().copied())).collect()
    }
}
