//! Sizes of a rectangle that was found, by the code that measures people's marks.

use model::{Container, Estimate, InputSigma, MeasureError, Method, ObjectMarks, Quantity, View, estimate};

use super::SHARED_PX;
use crate::found::Found;

/// Width and length by the corners, on the plane of the rim, with what its height's uncertainty and the edge's own make of them
/// (in the part from the marks).
pub(super) fn sizes(
    found: &Found,
    view: &View,
    method: Method,
    container: &Container,
    marks: &ObjectMarks,
    inputs: &InputSigma,
) -> Vec<(Quantity, Result<Estimate, MeasureError>)> {
    let height = found.height_as(container);
    let on_plane = |mm: f64| {
        let container = Container { rim_height_mm: Some(mm), ..*container };
        estimate(view, method, &container, marks, inputs)
    };
    let of = |sizes: &[(Quantity, Result<Estimate, MeasureError>)], quantity: Quantity| {
        let size = sizes.iter().find(|(other, _)| *other == quantity)?.1.as_ref().ok()?;
        Some(size.measured.predicted_mm)
    };
    let mut sizes = on_plane(height.mm);
    let (above, below) = (on_plane(height.mm + height.sigma_mm), on_plane(height.mm - height.sigma_mm));
    let side = |quantity| of(&sizes, quantity).unwrap_or_default();
    // A square has one size for all four sides.
    let (width, length) = (side(Quantity::Width), side(Quantity::Length));
    let perimeter_mm = 2.0 * (width + if length > 0.0 { length } else { width });
    let shared_mm = 2.0 * SHARED_PX * perimeter_mm / found.perimeter_px;
    for (quantity, size) in &mut sizes {
        let Ok(Estimate { measured, sigma, .. }) = size else { continue };
        let at = |sizes: &[_]| of(sizes, *quantity).unwrap_or(measured.predicted_mm);
        let by_height = 0.5 * (at(&above) - at(&below));
        *sigma = sigma.with_marks(sigma.marks_mm.hypot(by_height).hypot(shared_mm));
    }
    sizes
}
