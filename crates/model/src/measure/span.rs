//! Marks on the rim plane whose extent is a size.

use nalgebra::{Point2, Vector2};

use super::MeasureError;
use super::judge::Judge;
use super::numbered::Numbered;
use super::round::Round;
use crate::container::{Quantity, Shape};
use crate::doubt::Doubt;
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

/// The extent of a span.
pub(super) struct Extent {
    pub number: Sensed,
    /// The number of points of an outline that were left out.
    pub strays: usize,
    /// Whether the outline is what the object's shape says.
    pub doubt: Option<Doubt>,
}

impl Extent {
    fn without_doubt(number: Sensed) -> Self {
        Self { number, strays: 0, doubt: None }
    }
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

    /// The number of its first point.
    pub(super) fn first(&self) -> usize {
        match self {
            Span::Line(first, _) | Span::Circle(first, _) | Span::Corners(first, ..) => *first,
        }
    }

    /// The extent on the plane at the height `plane_z`, with its derivatives.
    pub(super) fn size(
        &self,
        view: &View,
        quantity: Quantity,
        plane_z: &Sensed,
        judge: &Judge,
    ) -> Result<Extent, MeasureError> {
        let place = |pixel: Point2<f64>| Located::on_plane(view, pixel, plane_z.value);
        match self {
            Span::Line(first, [a, b]) => {
                let (a, b) = (place(*a)?, place(*b)?);
                let between = b.point_mm - a.point_mm;
                let along = between.try_normalize(0.0).ok_or(MeasureError::NoLength)?;
                let ends = [(*first, &a, -along), (first + 1, &b, along)];
                Ok(Extent::without_doubt(Sensed::of_places(between.norm(), ends, plane_z)))
            }
            Span::Circle(first, points) => {
                let numbered: Vec<_> = (*first..).zip(points.iter().copied()).collect();
                let Round { radius, strays, doubt, .. } =
                    Round::through(view, Feature::Rim, &numbered, plane_z, judge)?;
                let number = Sensed::of_numbers(2.0 * radius.value, [(2.0, &radius)], plane_z.points());
                Ok(Extent { number, strays, doubt })
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
                let numbered = |by_corner: [Vector2<f64>; 4], length_mm: f64| {
                    let terms = (*first..).zip(&corners).zip(by_corner).map(|((n, corner), by)| (n, corner, by));
                    Sensed::of_places(length_mm, terms, plane_z)
                };
                let is_off =
                    |(by, mm): &([Vector2<f64>; 4], f64)| mm.abs() > CROOKED * judge.sigma(&numbered(*by, *mm));
                let doubt = deviations(*shape, &corners_mm).iter().any(is_off).then_some(Doubt::OutlineNotRight);
                let number = numbered(sides.by_corner, sides.length_mm);
                Ok(Extent { number, strays: 0, doubt })
            }
        }
    }
}

/// Corners are in doubt when sides or diagonals that should be equal differ by more than this many standard uncertainties.
const CROOKED: f64 = 4.0;

/// The differences of lengths that are equal in a rectangle (opposite sides, diagonals) and a square (all sides), in mm, each with
/// its derivatives by the places of the corners.
fn deviations(shape: Shape, corners: &[Point2<f64>; 4]) -> Vec<([Vector2<f64>; 4], f64)> {
    let difference = |plus: (usize, usize), minus: (usize, usize)| {
        let mut by_corner = [Vector2::zeros(); 4];
        let mut length = |(from, to): (usize, usize), sign: f64| {
            let side: Vector2<f64> = corners[to] - corners[from];
            let direction = side.try_normalize(0.0).unwrap_or_else(Vector2::zeros) * sign;
            by_corner[from] -= direction;
            by_corner[to] += direction;
            sign * side.norm()
        };
        let mm = length(plus, 1.0) + length(minus, -1.0);
        (by_corner, mm)
    };
    let mut all = vec![difference((0, 1), (2, 3)), difference((1, 2), (3, 0)), difference((0, 2), (1, 3))];
    if shape == Shape::Square {
        all.push(difference((0, 1), (1, 2)));
    }
    all
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
