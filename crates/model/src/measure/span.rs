//! Something marked on the rim plane whose extent is a size.

use nalgebra::{Matrix2, Point2, Vector2};

use super::{MeasureError, lines};
use crate::circle::{Circle, fit_circle};
use crate::container::{Quantity, Shape};
use crate::marks::{Feature, Mark, ObjectMarks};
use crate::view::{View, ViewError};

pub(super) enum Span<'a> {
    /// The two ends of a size.
    Line([Point2<f64>; 2]),
    /// Points around a circle.
    Circle(&'a [Point2<f64>]),
    /// Opposite sides of a quadrilateral.
    Corners { shape: Shape, corners: &'a [Point2<f64>] },
}

/// A pair of opposite sides: mean length, and its derivative by each corner on the plane.
struct Sides {
    length_mm: f64,
    by_corner: [Vector2<f64>; 4],
}

impl<'a> Span<'a> {
    /// What is marked for a quantity: its lines, and the rim's outlines where they give it.
    pub(super) fn of_marks(shape: Shape, quantity: Quantity, marks: &'a ObjectMarks) -> Vec<Self> {
        let rims = marks.marks.iter().filter_map(|mark| match mark {
            Mark::Outline { feature: Feature::Rim, points_px } => Some(points_px.as_slice()),
            Mark::Outline { feature: Feature::Base, .. } | Mark::Line { .. } => None,
        });
        let outlines = rims.filter_map(|points| match (shape, quantity) {
            (Shape::Circle, Quantity::Diameter) => Some(Span::Circle(points)),
            (Shape::Square, Quantity::Width) | (Shape::Rectangle, Quantity::Width | Quantity::Length) => {
                Some(Span::Corners { shape, corners: points })
            }
            _ => None,
        });
        lines(marks, quantity).map(Span::Line).chain(outlines).collect()
    }

    /// Its size on the plane `z_mm`.
    pub(super) fn size_mm(&self, view: &View, quantity: Quantity, z_mm: f64) -> Result<f64, MeasureError> {
        match self {
            Span::Line([a, b]) => length((view.on_plane(*a, z_mm)? - view.on_plane(*b, z_mm)?).norm()),
            Span::Circle(points) => Ok(2.0 * circle_on_plane(view, points, z_mm)?.radius_mm),
            Span::Corners { shape, corners } => length(sides(view, *shape, quantity, corners, z_mm)?.length_mm),
        }
    }

    /// SD of [`Self::size_mm`] for a SD of one pixel of each marked coordinate.
    pub(super) fn sigma_per_px(&self, view: &View, quantity: Quantity, z_mm: f64) -> Result<f64, MeasureError> {
        match self {
            Span::Line([a, b]) => {
                let along = (view.on_plane(*a, z_mm)? - view.on_plane(*b, z_mm)?).normalize();
                let by = |pixel| Ok::<_, ViewError>(plane_by_pixel(view, pixel, z_mm)?.tr_mul(&along).norm_squared());
                Ok((by(*a)? + by(*b)?).sqrt())
            }
            Span::Circle(points) => Ok(2.0 * circle_on_plane(view, points, z_mm)?.radius_sd),
            Span::Corners { shape, corners } => {
                let by_corner = sides(view, *shape, quantity, corners, z_mm)?.by_corner;
                let variances = corners.iter().zip(by_corner).map(|(pixel, by_corner)| {
                    Ok(plane_by_pixel(view, *pixel, z_mm)?.tr_mul(&by_corner).norm_squared())
                });
                Ok(variances.sum::<Result<f64, ViewError>>()?.sqrt())
            }
        }
    }
}

/// A size is more than nothing.
fn length(length_mm: f64) -> Result<f64, MeasureError> {
    if length_mm > 0.0 { Ok(length_mm) } else { Err(MeasureError::NoLength) }
}

/// The circle through points marked along a level rim, each weighted by what a pixel is worth where it lies.
fn circle_on_plane(view: &View, points_px: &[Point2<f64>], z_mm: f64) -> Result<Circle, MeasureError> {
    let on_plane: Vec<_> = points_px.iter().map(|p| view.on_plane(*p, z_mm)).collect::<Result<_, _>>()?;
    let per_pixel: Vec<_> = points_px.iter().map(|p| plane_by_pixel(view, *p, z_mm)).collect::<Result<_, _>>()?;
    fit_circle(&on_plane, |i, direction| per_pixel[i].tr_mul(&direction).norm())
        .map_err(|source| MeasureError::Circle { feature: Feature::Rim, source })
}

/// Derivative of the point on the plane by the pixel, in mm per px, by central differences of one pixel.
fn plane_by_pixel(view: &View, pixel: Point2<f64>, z_mm: f64) -> Result<Matrix2<f64>, ViewError> {
    let along = |step: Vector2<f64>| -> Result<Vector2<f64>, ViewError> {
        Ok(view.on_plane(pixel + step * 0.5, z_mm)? - view.on_plane(pixel - step * 0.5, z_mm)?)
    };
    Ok(Matrix2::from_columns(&[along(Vector2::x())?, along(Vector2::y())?]))
}

/// All four sides of a square, the shorter or longer pair of a rectangle.
fn sides(
    view: &View,
    shape: Shape,
    quantity: Quantity,
    corners_px: &[Point2<f64>],
    z_mm: f64,
) -> Result<Sides, MeasureError> {
    let &[a, b, c, d] = corners_px else {
        return Err(MeasureError::NotFourCorners { shape, points: corners_px.len() });
    };
    let on_plane = |pixel| view.on_plane(pixel, z_mm);
    let corners = [on_plane(a)?, on_plane(b)?, on_plane(c)?, on_plane(d)?];
    let (one, other) = (pair(&corners, [(0, 1), (2, 3)]), pair(&corners, [(1, 2), (3, 0)]));
    Ok(match (shape, quantity) {
        (Shape::Square, _) => Sides {
            length_mm: 0.5 * (one.length_mm + other.length_mm),
            by_corner: std::array::from_fn(|i| 0.5 * (one.by_corner[i] + other.by_corner[i])),
        },
        (_, Quantity::Width) if one.length_mm <= other.length_mm => one,
        (_, Quantity::Width) => other,
        _ if one.length_mm <= other.length_mm => other,
        _ => one,
    })
}

fn pair(corners: &[Point2<f64>; 4], sides: [(usize, usize); 2]) -> Sides {
    let mut found = Sides { length_mm: 0.0, by_corner: [Vector2::zeros(); 4] };
    for (from, to) in sides {
        let side = corners[to] - corners[from];
        let direction = side.try_normalize(0.0).unwrap_or_else(Vector2::zeros);
        found.length_mm += 0.5 * side.norm();
        found.by_corner[from] -= 0.5 * direction;
        found.by_corner[to] += 0.5 * direction;
    }
    found
}
