//! From the marks of one object on one picture to its sizes.

mod error;
mod height;
mod judge;
mod numbered;
mod place;
mod round;
mod span;

use crate::container::{Container, Kind, Method, Quantity, Shape, Wall};
use crate::doubt::Doubt;
use crate::marks::ObjectMarks;
use crate::sensed::Sensed;
use crate::sigma::InputSigma;
use crate::view::View;

pub use error::MeasureError;
use height::leaning_mm;
pub(crate) use height::{HeightLine, camera_height, possible_height};
pub use height::{height_by_paper_mm, height_by_ray_mm};
pub(crate) use judge::Judge;
pub use judge::LeftOut;
pub(crate) use numbered::Numbered;
pub use place::MarkPlace;
use round::coaxial;
use span::{Extent, Span};

/// A size that was measured on one picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// The quantity that was measured.
    pub quantity: Quantity,
    /// The value: the mean over the lines or outlines that were marked for it.
    pub predicted_mm: f64,
    /// Height of the plane that the size was measured on; for a height that is the table, 0.
    pub plane_z_mm: f64,
    /// The number of lines or outlines behind it.
    pub marks: usize,
    /// The lines and outlines that contradict these, and were left out.
    pub left_out: Option<LeftOut>,
    /// The number of points that lie far off their outline, and were left out.
    pub stray_points: usize,
}

impl Measured {
    /// A size by a single mark, of which nothing was left out.
    #[must_use]
    pub fn by_one_mark(quantity: Quantity, predicted_mm: f64, plane_z_mm: f64) -> Self {
        Self { quantity, predicted_mm, plane_z_mm, marks: 1, left_out: None, stray_points: 0 }
    }
}

/// A measured size with its derivatives.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Sized {
    pub measured: Measured,
    pub number: Sensed,
    /// Radius of the rim less that of the base, per height, where the method gives it.
    pub wall_slope: Option<f64>,
    /// The doubts about the outlines behind it.
    pub doubts: Vec<Doubt>,
}

/// The sizes of one object: each quantity with its size, or with the reason why there is none.
type Sizes = Vec<(Quantity, Result<Sized, MeasureError>)>;

/// The sizes of one marked object: heights first, then those on the rim plane Z = H (for plates Z = 0, unless their rim
/// height is known). Several marks of one quantity are averaged, unless they contradict each other. The default
/// [`InputSigma`] says how far they may differ.
///
/// [`Method::Paper`] takes the roll as zero. A known rim height decides the plane; a marked height is then still measured and
/// returned. [`Method::Coaxial`] gives sizes where the rim and the base of a round bowl are outlined, and otherwise none.
/// [`Method::Joint`] needs several pictures and [`Method::Best`] several methods, so they give no sizes here.
///
/// # Errors
/// There is one error for each quantity that is marked but cannot be measured; the other quantities are still returned.
#[must_use]
pub fn measure(
    view: &View,
    method: Method,
    container: &Container,
    marks: &ObjectMarks,
) -> Vec<(Quantity, Result<Measured, MeasureError>)> {
    let judge = Judge::of_method(method, view, &InputSigma::default());
    let sizes = sizes(&view_of_method(view, method), method, container, marks, &judge);
    sizes.into_iter().map(|(quantity, size)| (quantity, size.map(|size| size.measured))).collect()
}

/// The view that a method works with: [`Method::Paper`] takes the roll as zero.
pub(crate) fn view_of_method(view: &View, method: Method) -> View {
    match method {
        Method::Paper => View::new(*view.camera(), view.pose().without_roll()),
        Method::Ray | Method::Coaxial | Method::Joint | Method::Best => *view,
    }
}

/// The sizes of [`measure`] with their derivatives, by the view as it is, roll included.
pub(crate) fn sizes(view: &View, method: Method, container: &Container, marks: &ObjectMarks, judge: &Judge) -> Sizes {
    let numbered = Numbered::from_marks(marks);
    let may_lean = container.known_wall() != Some(Wall::Vertical);
    let height = match method {
        Method::Paper | Method::Ray => height_of_lines(view, method, &numbered, judge, may_lean),
        Method::Coaxial => match coaxial_height(view, container, &numbered, judge) {
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
    sizes.extend(sizes_on_plane(view, container.shape, &numbered, &plane_z, judge));
    sizes
}

/// The diameters, widths and lengths on the rim plane, whose height is `plane_z`.
fn sizes_on_plane(
    view: &View,
    shape: Shape,
    marks: &Numbered<'_>,
    plane_z: &Result<Sensed, MeasureError>,
    judge: &Judge,
) -> impl Iterator<Item = (Quantity, Result<Sized, MeasureError>)> {
    [Quantity::Diameter, Quantity::Width, Quantity::Length].into_iter().filter_map(move |quantity| {
        let spans = Span::of_marks(shape, quantity, marks);
        let size = || {
            let plane_z = plane_z.as_ref().map_err(|error| *error)?;
            let extents =
                spans.iter().map(|span| span.size(view, quantity, plane_z, judge)).collect::<Result<Vec<_>, _>>()?;
            let place = |i: usize| marks.place(spans[i].first());
            mean_size(quantity, extents, plane_z.value, judge, |_, _| 0.0, place)
        };
        (!spans.is_empty()).then(|| (quantity, size()))
    })
}

/// The mean height of the height lines; `None` when none is marked.
fn height_of_lines(
    view: &View,
    method: Method,
    marks: &Numbered<'_>,
    judge: &Judge,
    may_lean: bool,
) -> Option<Result<Sized, MeasureError>> {
    let lines: Vec<HeightLine> = marks.height_lines().collect();
    let heights: Result<Vec<_>, _> = lines
        .iter()
        .map(|line| match method {
            Method::Paper => line.by_paper(view, marks.points),
            Method::Ray | Method::Coaxial | Method::Joint | Method::Best => line.by_ray(view, marks.points),
        })
        .collect();
    if lines.is_empty() {
        return None;
    }
    Some(heights.and_then(|heights| {
        let leeway_mm = |a, b| if may_lean { leaning_mm(view, &lines, &heights, [a, b]) } else { 0.0 };
        let extents = heights.iter().map(|number| Extent { number: number.clone(), strays: 0, doubt: None });
        mean_size(Quantity::Height, extents.collect(), 0.0, judge, leeway_mm, |i| marks.place(lines[i].foot.0))
    }))
}

/// The height by the circles of rim and base; `None` unless the object is a round bowl with both outlined.
fn coaxial_height(
    view: &View,
    container: &Container,
    marks: &Numbered<'_>,
    judge: &Judge,
) -> Option<Result<Sized, MeasureError>> {
    if container.kind != Kind::Bowl || container.shape != Shape::Circle {
        return None;
    }
    let sized = |bowl: round::Coaxial| Sized {
        measured: Measured {
            stray_points: bowl.strays,
            ..Measured::by_one_mark(Quantity::Height, bowl.height.value, 0.0)
        },
        number: bowl.height,
        wall_slope: Some(bowl.wall_slope),
        doubts: bowl.doubts,
    };
    Some(coaxial(view, marks, judge)?.map(sized))
}

/// The mean of the sizes that several marks of one quantity give, without those that contradict the majority.
fn mean_size(
    quantity: Quantity,
    extents: Vec<Extent>,
    plane_z_mm: f64,
    judge: &Judge,
    leeway_mm: impl Fn(usize, usize) -> f64,
    place: impl Fn(usize) -> MarkPlace,
) -> Result<Sized, MeasureError> {
    let numbers: Vec<Sensed> = extents.iter().map(|extent| extent.number.clone()).collect();
    let kept = judge.agreeing(&numbers, leeway_mm).map_err(|apart| apart.error(&numbers, &place))?;
    let number = Sensed::mean(&kept.iter().map(|i| numbers[*i].clone()).collect::<Vec<_>>());
    let number = number.ok_or(MeasureError::NoLength)?;
    let off = |i: &usize| (numbers[*i].value - number.value).abs();
    let others = (0..numbers.len()).filter(|i| !kept.contains(i));
    let furthest = others.max_by(|a, b| off(a).total_cmp(&off(b)));
    let measured = Measured {
        marks: kept.len(),
        left_out: furthest.map(|i| LeftOut {
            marks: numbers.len() - kept.len(),
            furthest_mm: numbers[i].value,
            furthest: place(i),
        }),
        stray_points: kept.iter().map(|i| extents[*i].strays).sum(),
        ..Measured::by_one_mark(quantity, number.value, plane_z_mm)
    };
    let mut doubts: Vec<Doubt> = kept.iter().filter_map(|i| extents[*i].doubt).collect();
    doubts.dedup();
    Ok(Sized { measured, number, wall_slope: None, doubts })
}
