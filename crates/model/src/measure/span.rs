//! Marks on the rim plane whose extent is a size.

use nalgebra::{Point2, Vector2};

use super::MeasureError;
use super::numbered::Numbered;
use super::round::Round;
use crate::container::{Quantity, Shape};
use crate::located::Located;
use crate::marks::Feature;
use crate::sensed::Sensed;
use crate::view::View;

/// A mark, or a part of one, whose extent on the rim plane is a size. The number is that of its first point.
pub(super) enum Span<'a> {
    /// The two ends of a size.
    Line(usize, [Point2<f64>; 2]),
    /// Points around a circle.
    Circle(usize, &'a [Point2<f64>]),
    /// The four corners of a square or rectangle.
    Corners(usize, Shape, &'a [Point2<f64>]),
}

/// The mean length of opposite sides, with its derivative by the place of each corner on the plane.
struct Sides {
    length_mm: f64,
    by_corner: [Vector2<f64>; 4],
}

impl<'a> Span<'a> {
    /// The spans of a quantity: the lines that are marked for it, and the outlines of the rim where they show it.
    pub(super) fn of_marks(shape: Shape, quantity: Quantity, marks: &Numbered<'a>) -> Vec<Self> {
        let outlines = marks.outlines(Feature::Rim).filter_map(|(first, points)| match (shape, quantity) {
            (Shape::Circle, Quantity::Diameter) => Some(Span::Circle(first, points)),
            (Shape::Square, Quantity::Width) | (Shape::Rectangle, Quantity::Width | Quantity::Length) => {
                Some(Span::Corners(first, shape, points))
            }
            _ => None,
        });
        marks.lines(quantity).map(|(first, ends)| Span::Line(first, ends)).chain(outlines).collect()
    }

    /// The extent on the plane at the height `plane_z`, with its derivatives.
    pub(super) fn size(&self, view: &View, quantity: Quantity, plane_z: &Sensed) -> Result<Sensed, MeasureError> {
        let place = |pixel: Point2<f64>| Located::on_plane(view, pixel, plane_z.value);
        match self {
            Span::Line(first, [a, b]) => {
                let (a, b) = (place(*a)?, place(*b)?);
                let between = b.point_mm - a.point_mm;
                let along = between.try_normalize(0.0).ok_or(MeasureError::NoLength)?;
                Ok(Sensed::of_places(between.norm(), [(*first, &a, -along), (first + 1, &b, along)], plane_z))
            }
            Span::Circle(first, points) => {
                let numbered: Vec<_> = (*first..).zip(points.iter().copied()).collect();
                let round = Round::through(view, Feature::Rim, &numbered, plane_z)?;
                Ok(Sensed::of_numbers(2.0 * round.radius.value, [(2.0, &round.radius)], plane_z.points()))
            }
            Span::Corners(first, shape, corners) => {
                let &[a, b, c, d] = *corners else {
                    return Err(MeasureError::NotFourCorners { shape: *shape, points: corners.len() });
                };
                let corners = [place(a)?, place(b)?, place(c)?, place(d)?];
                let corners_mm = [0, 1, 2, 3].map(|i: usize| corners[i].point_mm);
                if !are_in_order(&corners_mm) {
                    return Err(MeasureError::CornersNotInOrder { shape: *shape });
                }
                let sides = sides(*shape, quantity, &corners_mm);
                if sides.length_mm <= 0.0 {
                    return Err(MeasureError::NoLength);
                }
                let terms = (*first..).zip(&corners).zip(sides.by_corner).map(|((n, corner), by)| (n, corner, by));
                Ok(Sensed::of_places(sides.length_mm, terms, plane_z))
            }
        }
    }
}

/// Whether the way around the corners turns to one side throughout: else two sides cross, and are diagonals.
fn are_in_order(corners: &[Point2<f64>; 4]) -> bool {
    let turn = |at: usize| {
        let [before, corner, after] = [0, 1, 2].map(|step| corners[(at + step) % 4]);
        (corner - before).perp(&(after - corner))
    };
    let turns = [0, 1, 2, 3].map(turn);
    turns.iter().all(|turn| *turn >= 0.0) || turns.iter().all(|turn| *turn <= 0.0)
}

/// All four sides of a square; of a rectangle the shorter pair for its width, and the longer pair for its length.
fn sides(shape: Shape, quantity: Quantity, corners: &[Point2<f64>; 4]) -> Sides {
    let (one, other) = (pair(corners, [(0, 1), (2, 3)]), pair(corners, [(1, 2), (3, 0)]));
    match (shape, quantity) {
        (Shape::Square, _) => Sides {
            length_mm: 0.5 * (one.length_mm + other.length_mm),
            by_corner: std::array::from_fn(|i| 0.5 * (one.by_corner[i] + other.by_corner[i])),
        },
        (_, Quantity::Width) if one.length_mm <= other.length_mm => one,
        (_, Quantity::Width) => other,
        _ if one.length_mm <= other.length_mm => other,
        _ => one,
    }
}

/// A pair of opposite sides, each given by the numbers of its two corners.
fn pair(corners: &[Point2<f64>; 4], sides: [(usize, usize); 2]) -> Sides {
    let mut pair = Sides { length_mm: 0.0, by_corner: [Vector2::zeros(); 4] };
    for (from, to) in sides {
        let side = corners[to] - corners[from];
        let direction = side.try_normalize(0.0).unwrap_or_else(Vector2::zeros);
        pair.length_mm += 0.5 * side.norm();
        pair.by_corner[from] -= 0.5 * direction;
        pair.by_corner[to] += 0.5 * direction;
    }
    pair
}
