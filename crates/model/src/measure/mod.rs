//! From the marks of one object on one picture to its sizes.

mod error;
mod height;
mod numbered;
mod round;
mod span;

use crate::container::{Container, Kind, Method, Quantity, Shape};
use crate::marks::ObjectMarks;
use crate::sensed::Sensed;
use crate::view::View;

pub use error::MeasureError;
pub(crate) use height::{HeightLine, camera_height, possible_height};
pub use height::{height_by_paper_mm, height_by_ray_mm};
pub(crate) use numbered::Numbered;
use round::coaxial;
use span::Span;

/// One size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// Which size.
    pub quantity: Quantity,
    /// The size: mean over the lines or outlines marked for it.
    pub predicted_mm: f64,
    /// Height of the plane that it was measured on; for a height, the table.
    pub plane_z_mm: f64,
    /// How many lines or outlines were marked for it.
    pub marks: usize,
}

/// A size with its derivatives.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Sized {
    pub measured: Measured,
    pub number: Sensed,
    /// Radius gained per height, where the method tells it.
    pub wall_slope: Option<f64>,
}

type Sizes = Vec<(Quantity, Result<Sized, MeasureError>)>;

/// The sizes of one marked object: heights first, then what is measured on the rim plane Z = H (plates: Z = 0, unless
/// their rim height is known). Several marks of one quantity are averaged.
///
/// [`Method::Paper`] takes the roll as zero. A known rim height decides the plane; a marked height is then still
/// measured and returned. [`Method::Coaxial`] gives sizes where rim and base of a round bowl are outlined, and nothing
/// otherwise; [`Method::Joint`] and [`Method::Best`] need more than one method or picture, and give nothing here.
///
/// # Errors
/// One per quantity that is marked but cannot be measured; the other quantities are still returned.
#[must_use]
pub fn measure(
    view: &View,
    method: Method,
    container: &Container,
    marks: &ObjectMarks,
) -> Vec<(Quantity, Result<Measured, MeasureError>)> {
    let sizes = sizes(&view_of_method(view, method), method, container, marks);
    sizes.into_iter().map(|(quantity, size)| (quantity, size.map(|size| size.measured))).collect()
}

/// The view as a method takes it.
pub(crate) fn view_of_method(view: &View, method: Method) -> View {
    match method {
        Method::Paper => View::new(*view.camera(), view.pose().without_roll()),
        Method::Ray | Method::Coaxial | Method::Joint | Method::Best => *view,
    }
}

/// [`measure`] with derivatives, and with the view taken as it is, roll included.
pub(crate) fn sizes(view: &View, method: Method, container: &Container, marks: &ObjectMarks) -> Sizes {
    let numbered = Numbered::from_marks(marks);
    let height = match method {
        Method::Paper | Method::Ray => height_of_lines(view, method, &numbered),
        Method::Coaxial => match coaxial_height(view, container, &numbered) {
            Some(height) => Some(height),
            None => return Vec::new(),
        },
        Method::Joint | Method::Best => return Vec::new(),
    };
    let exact = |z_mm: f64| Sensed::exact(z_mm, numbered.points);
    let plane_z = match (container.rim_height_mm, container.kind, &height) {
        (Some(known_mm), _, _) => Ok(exact(known_mm)),
        (None, Kind::Plate, _) => Ok(exact(0.0)),
        (None, Kind::Bowl | Kind::Box, Some(Ok(height))) => Ok(height.number.clone()),
        (None, Kind::Bowl | Kind::Box, Some(Err(error))) => Err(*error),
        (None, Kind::Bowl | Kind::Box, None) => Err(MeasureError::NoHeight),
    };
    let mut sizes: Sizes = height.map(|result| (Quantity::Height, result)).into_iter().collect();
    sizes.extend(sizes_on_plane(view, container.shape, &numbered, &plane_z));
    sizes
}

/// Diameters, widths and lengths on the rim plane.
fn sizes_on_plane(
    view: &View,
    shape: Shape,
    marks: &Numbered<'_>,
    plane_z: &Result<Sensed, MeasureError>,
) -> impl Iterator<Item = (Quantity, Result<Sized, MeasureError>)> {
    [Quantity::Diameter, Quantity::Width, Quantity::Length].into_iter().filter_map(move |quantity| {
        let spans = Span::of_marks(shape, quantity, marks);
        let size = || {
            let plane_z = plane_z.as_ref().map_err(|error| *error)?;
            let found = spans.iter().map(|span| span.size(view, quantity, plane_z)).collect::<Result<Vec<_>, _>>()?;
            mean_of(quantity, &found, plane_z.value)
        };
        (!spans.is_empty()).then(|| (quantity, size()))
    })
}

fn height_of_lines(view: &View, method: Method, marks: &Numbered<'_>) -> Option<Result<Sized, MeasureError>> {
    let heights: Vec<_> = marks
        .height_lines()
        .map(|line| match method {
            Method::Paper => line.by_paper(view, marks.points),
            Method::Ray | Method::Coaxial | Method::Joint | Method::Best => line.by_ray(view, marks.points),
        })
        .collect();
    if heights.is_empty() {
        return None;
    }
    let all: Result<Vec<_>, _> = heights.into_iter().collect();
    Some(all.and_then(|all| mean_of(Quantity::Height, &all, 0.0)))
}

/// None where the object is no round bowl with both circles marked.
fn coaxial_height(view: &View, container: &Container, marks: &Numbered<'_>) -> Option<Result<Sized, MeasureError>> {
    if container.kind != Kind::Bowl || container.shape != Shape::Circle {
        return None;
    }
    let sized = |found: round::Coaxial| Sized {
        measured: Measured { quantity: Quantity::Height, predicted_mm: found.height.value, plane_z_mm: 0.0, marks: 1 },
        number: found.height,
        wall_slope: Some(found.wall_slope),
    };
    Some(coaxial(view, marks)?.map(sized))
}

fn mean_of(quantity: Quantity, found: &[Sensed], plane_z_mm: f64) -> Result<Sized, MeasureError> {
    let number = Sensed::mean(found).ok_or(MeasureError::NoLength)?;
    let measured = Measured { quantity, predicted_mm: number.value, plane_z_mm, marks: found.len() };
    Ok(Sized { measured, number, wall_slope: None })
}
