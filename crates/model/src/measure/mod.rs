//! From the marks of one object on one picture to its sizes.

mod span;

use nalgebra::{Point2, Vector2};

use crate::circle::CircleError;
use crate::container::{Kind, Method, Quantity, Shape};
use crate::marks::{Feature, Mark, ObjectMarks};
use crate::view::{View, ViewError};
use span::Span;

/// What is known of a container before it is measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Container {
    /// Plate, bowl or box.
    pub kind: Kind,
    /// Its outline.
    pub shape: Shape,
    /// Height of the rim above the table where it is known (a catalogue, a ruler) and need not be measured.
    pub rim_height_mm: Option<f64>,
}

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

/// Why marks do not give a size.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum MeasureError {
    /// A marked point has no place on its plane.
    #[error(transparent)]
    View(#[from] ViewError),
    /// An outline does not give a circle.
    #[error("{feature} outline: {source}")]
    Circle {
        /// Which outline.
        feature: Feature,
        /// Why.
        source: CircleError,
    },
    /// A rim is marked, but its height is not known.
    #[error(
        "the rim's height is not known: mark a line OBJECT/height from the wall's foot on the table to the rim above it, \
         or give the rim height"
    )]
    NoHeight,
    /// The second end of a height line is not behind the first one.
    #[error(
        "the height line runs towards the wearer on the table plane: draw it from the wall's foot on the table to the rim \
         above it"
    )]
    RimBelowFoot,
    /// A height that a wall seen from above cannot have.
    #[error(
        "a wall {height_mm:.0} mm high would reach above the camera, which is {camera_height_mm:.0} mm above the table"
    )]
    RimAboveCamera {
        /// The height found.
        height_mm: f64,
        /// Height of the camera.
        camera_height_mm: f64,
    },
    /// The ends of a line, or two corners, lie on one spot.
    #[error("the marked points lie on one spot: draw the mark again")]
    NoLength,
    /// A rim polygon of a square or rectangle that is not four corners.
    #[error("rim outline of a {shape}: expected its 4 corners, got {points} points")]
    NotFourCorners {
        /// The shape.
        shape: Shape,
        /// How many points there are.
        points: usize,
    },
}

impl MeasureError {
    /// Stable code, as in the `flags` of the results.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::View(_) => "mark_off_plane",
            Self::Circle { .. } => "no_circle",
            Self::NoHeight => "no_height",
            Self::RimBelowFoot => "rim_below_foot",
            Self::RimAboveCamera { .. } => "rim_above_camera",
            Self::NoLength => "no_length",
            Self::NotFourCorners { .. } => "not_four_corners",
        }
    }
}

/// Wall height by the paper: Eq. (14), H = tan(w) H', where H' is the length along Y, on Z = 0, from the wall's foot to
/// the rim above it. This uses the depression of the optical axis for every ray.
///
/// # Errors
/// [`MeasureError`] when an end has no place on the table, or the rim end lies nearer than the foot.
pub fn height_by_paper_mm(view: &View, foot_px: Point2<f64>, rim_px: Point2<f64>) -> Result<f64, MeasureError> {
    let (foot, rim) = (view.on_plane(foot_px, 0.0)?, view.on_plane(rim_px, 0.0)?);
    let projected_mm = rim.y - foot.y; // H'
    possible_height(view, view.pose().pitch_rad().tan() * projected_mm) // Eq. (14)
}

/// Wall height by the rim point's own ray, exact for a vertical wall: H = c (1 - |foot| / |rim|), with distances on
/// Z = 0 from the point under the camera.
///
/// # Errors
/// As [`height_by_paper_mm`].
pub fn height_by_ray_mm(view: &View, foot_px: Point2<f64>, rim_px: Point2<f64>) -> Result<f64, MeasureError> {
    let (foot, rim) = (view.on_plane(foot_px, 0.0)?, view.on_plane(rim_px, 0.0)?);
    possible_height(view, view.pose().camera_height_mm() * (1.0 - foot.coords.norm() / rim.coords.norm()))
}

fn height_mm(view: &View, method: Method, foot_px: Point2<f64>, rim_px: Point2<f64>) -> Result<f64, MeasureError> {
    match method {
        Method::Paper => height_by_paper_mm(view, foot_px, rim_px),
        Method::Ray => height_by_ray_mm(view, foot_px, rim_px),
    }
}

/// A height above the table and below the camera.
fn possible_height(view: &View, height_mm: f64) -> Result<f64, MeasureError> {
    let camera_height_mm = view.pose().camera_height_mm();
    if height_mm >= camera_height_mm {
        Err(MeasureError::RimAboveCamera { height_mm, camera_height_mm })
    } else if height_mm > 0.0 {
        Ok(height_mm)
    } else {
        Err(MeasureError::RimBelowFoot)
    }
}

/// The sizes of one marked object: heights first, then what is measured on the rim plane Z = H (plates: Z = 0, unless
/// their rim height is known). Several marks of one quantity are averaged.
///
/// [`Method::Paper`] takes the roll as zero. A known rim height decides the plane; a marked height is then still
/// measured and returned.
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
    measure_as_seen(&view_of_method(view, method), method, container, marks)
}

/// The view as a method takes it.
pub(crate) fn view_of_method(view: &View, method: Method) -> View {
    match method {
        Method::Paper => View::new(*view.camera(), view.pose().without_roll()),
        Method::Ray => *view,
    }
}

/// [`measure`] with the view taken as it is, roll included.
pub(crate) fn measure_as_seen(
    view: &View,
    method: Method,
    container: &Container,
    marks: &ObjectMarks,
) -> Vec<(Quantity, Result<Measured, MeasureError>)> {
    let height = marked_height(view, method, marks);
    let plane_z_mm = match (container.rim_height_mm, container.kind, &height) {
        (Some(known_mm), _, _) => Ok(known_mm),
        (None, Kind::Plate, _) => Ok(0.0),
        (None, Kind::Bowl | Kind::Box, Some(Ok(measured))) => Ok(measured.predicted_mm),
        (None, Kind::Bowl | Kind::Box, Some(Err(error))) => Err(*error),
        (None, Kind::Bowl | Kind::Box, None) => Err(MeasureError::NoHeight),
    };
    let mut sizes: Vec<_> = height.map(|result| (Quantity::Height, result)).into_iter().collect();
    for quantity in [Quantity::Diameter, Quantity::Width, Quantity::Length] {
        let found = Span::of_marks(container.shape, quantity, marks);
        if !found.is_empty() {
            sizes.push((quantity, plane_z_mm.and_then(|z_mm| mean_span(view, quantity, &found, z_mm))));
        }
    }
    sizes
}

fn marked_height(view: &View, method: Method, marks: &ObjectMarks) -> Option<Result<Measured, MeasureError>> {
    let heights_mm: Vec<_> =
        lines(marks, Quantity::Height).map(|[foot, rim]| height_mm(view, method, foot, rim)).collect();
    if heights_mm.is_empty() {
        return None;
    }
    Some(mean(heights_mm).map(|(predicted_mm, marks)| Measured {
        quantity: Quantity::Height,
        predicted_mm,
        plane_z_mm: 0.0,
        marks,
    }))
}

fn lines(marks: &ObjectMarks, wanted: Quantity) -> impl Iterator<Item = [Point2<f64>; 2]> + '_ {
    marks.marks.iter().filter_map(move |mark| match mark {
        Mark::Line { quantity, ends_px } if *quantity == wanted => Some(*ends_px),
        Mark::Line { .. } | Mark::Outline { .. } => None,
    })
}

fn mean_span(view: &View, quantity: Quantity, spans: &[Span<'_>], z_mm: f64) -> Result<Measured, MeasureError> {
    let (predicted_mm, marks) = mean(spans.iter().map(|span| span.size_mm(view, quantity, z_mm)).collect())?;
    Ok(Measured { quantity, predicted_mm, plane_z_mm: z_mm, marks })
}

/// Standard deviation of a size on the plane `z_mm`, per pixel of standard deviation of each marked coordinate. The plane
/// is taken as known.
pub(crate) fn spans_sigma_per_px(
    view: &View,
    shape: Shape,
    quantity: Quantity,
    marks: &ObjectMarks,
    z_mm: f64,
) -> Result<f64, MeasureError> {
    let spans = Span::of_marks(shape, quantity, marks);
    sigma_of_mean(spans.iter().map(|span| span.sigma_per_px(view, quantity, z_mm)))
}

/// The same for the height of a wall, by central differences of one pixel.
pub(crate) fn height_sigma_per_px(view: &View, method: Method, marks: &ObjectMarks) -> Result<f64, MeasureError> {
    sigma_of_mean(lines(marks, Quantity::Height).map(|[foot, rim]| {
        let mut variance = 0.0;
        for step in [Vector2::x() * 0.5, Vector2::y() * 0.5] {
            let by_foot = height_mm(view, method, foot + step, rim)? - height_mm(view, method, foot - step, rim)?;
            let by_rim = height_mm(view, method, foot, rim + step)? - height_mm(view, method, foot, rim - step)?;
            variance += by_foot.powi(2) + by_rim.powi(2);
        }
        Ok(variance.sqrt())
    }))
}

/// SD of the mean of independent values with these SDs.
fn sigma_of_mean(sigmas: impl Iterator<Item = Result<f64, MeasureError>>) -> Result<f64, MeasureError> {
    let (variance, n) = mean(sigmas.map(|sigma| sigma.map(|s| s * s)).collect())?;
    #[expect(clippy::cast_precision_loss, reason = "a count of marks is far below 2^53")]
    Ok((variance / n as f64).sqrt())
}

fn mean(values: Vec<Result<f64, MeasureError>>) -> Result<(f64, usize), MeasureError> {
    let n = values.len();
    let sum = values.into_iter().sum::<Result<f64, MeasureError>>()?;
    #[expect(clippy::cast_precision_loss, reason = "a count of marks is far below 2^53")]
    Ok((sum / n as f64, n))
}
