//! Sizes with their uncertainty: first-order propagation by analytic derivatives.

use crate::container::{Container, Method, Quantity};
use crate::doubt::Doubt;
use crate::marks::ObjectMarks;
use crate::measure::{Judge, MeasureError, Measured, Sized, sizes, view_of_method};
use crate::sigma::{InputSigma, Sensitivity, SizeSigma};
use crate::stats::median;
use crate::view::View;
use crate::wall::{assumes_vertical_wall, wall_doubt, wall_slope};

/// A size with its uncertainty.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// The method that gave the size.
    pub method: Method,
    /// The size.
    pub measured: Measured,
    /// The derivatives of the size.
    pub sensitivity: Sensitivity,
    /// The standard uncertainty of the size.
    pub sigma: SizeSigma,
    /// Radius of a round rim less that of its base, per height, where the method gives it.
    pub wall_slope: Option<f64>,
    /// The assumptions of the method that may not hold. Without any, the uncertainty claims to be complete.
    pub doubts: Vec<Doubt>,
}

/// The sizes of [`measure`](crate::measure()) with their uncertainties. These follow from the derivatives of every step, so
/// the uncertainty of a measured rim plane reaches the diameter that is measured on it, with all correlations through the
/// common pose and the common marks.
#[must_use]
pub fn estimate(
    view: &View,
    method: Method,
    container: &Container,
    marks: &ObjectMarks,
    inputs: &InputSigma,
) -> Vec<(Quantity, Result<Estimate, MeasureError>)> {
    estimate_judged(view, method, container, marks, inputs, &Judge::of_method(method, view, inputs))
}

/// The sizes of [`estimate`], whose marks are judged by `judge`.
pub(crate) fn estimate_judged(
    view: &View,
    method: Method,
    container: &Container,
    marks: &ObjectMarks,
    inputs: &InputSigma,
    judge: &Judge,
) -> Vec<(Quantity, Result<Estimate, MeasureError>)> {
    let sizes_of_method = sizes(&view_of_method(view, method), method, container, marks, judge);
    let exact = if method == Method::Paper { sizes(view, Method::Ray, container, marks, judge) } else { Vec::new() };
    let slope = assumes_vertical_wall(method).then(|| wall_slope(view, container, marks, judge)).flatten();
    let estimated = |size: Sized| {
        let sensitivity = Sensitivity { by_source: size.number.by_source, marks_mm_per_px: size.number.by_mark.norm() };
        let sigma = sensitivity.sigma(inputs);
        let quantity = size.measured.quantity;
        let mut doubts = size.doubts;
        let differs = |exact_mm: f64| (exact_mm - size.measured.predicted_mm).abs() > NEGLIGIBLE * sigma.total_mm;
        if method == Method::Paper && size_mm(&exact, quantity).is_none_or(differs) {
            doubts.push(Doubt::PaperApproximation);
        }
        doubts.extend(wall_doubt(method, container, quantity, slope));
        Estimate { method, measured: size.measured, sensitivity, sigma, wall_slope: size.wall_slope, doubts }
    };
    sizes_of_method.into_iter().map(|(quantity, size)| (quantity, size.map(estimated))).collect()
}

/// A bias below this share of the standard uncertainty is negligible: it lowers the coverage of a 95 % interval by no more than
/// 1 percentage point.
const NEGLIGIBLE: f64 = 0.3;

/// The size of one quantity; `None` where it was not measured.
fn size_mm(sizes: &[(Quantity, Result<Sized, MeasureError>)], wanted: Quantity) -> Option<f64> {
    let (_, size) = sizes.iter().find(|(quantity, _)| *quantity == wanted)?;
    Some(size.as_ref().ok()?.measured.predicted_mm)
}

/// The estimate for `method = "best"`: the one with the fewest doubts, and among several of those the one with the smallest
/// uncertainty. The uncertainties are compared for the same size, the median of the estimates, since a size that is too small
/// has a small uncertainty for that alone. `None` when there are no estimates.
#[must_use]
pub fn best_of<'a>(estimates: impl IntoIterator<Item = &'a Estimate>) -> Option<&'a Estimate> {
    let estimates: Vec<&Estimate> = estimates.into_iter().collect();
    let size_mm = |estimate: &Estimate| estimate.measured.predicted_mm;
    let middle_mm = median(estimates.iter().map(|estimate| size_mm(estimate)).collect());
    let sigma = |estimate: &Estimate| estimate.sigma.total_at(size_mm(estimate), middle_mm);
    estimates.into_iter().min_by(|a, b| a.doubts.len().cmp(&b.doubts.len()).then(sigma(a).total_cmp(&sigma(b))))
}
