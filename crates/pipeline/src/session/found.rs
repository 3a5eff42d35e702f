//! Sizes of rims that the program found: their heights come from the picture, with an uncertainty that images share.

use model::{
    Container, Estimate, Feature, InputSigma, Kind, Mark, MeasureError, Method, Quantity, Sensitivity, Shape,
    SizeSigma, View, estimate,
};

use super::marked::Marked;
use rims::{Found, HeightSource};

/// Sizes by one method: of people's marks as they are; of a rim that was found with what is known of its height.
pub(super) fn estimates(
    marked: &Marked<'_>,
    view: &View,
    method: Method,
) -> Vec<(Quantity, Result<Estimate, MeasureError>)> {
    let (container, inputs) = (&marked.object.container, &marked.inputs);
    let Some(found) = by_itself(marked) else {
        return estimate(view, method, container, marked.marks, inputs);
    };
    // A rim alone has no base, by which it would be coaxial.
    if method == Method::Coaxial {
        return Vec::new();
    }
    let sizes = found.sizes(view, method, container, marked.marks, inputs);
    // What bowls commonly have is no measurement; and the foot was found by exact geometry, not by the paper's.
    let source = found.height_as(container).source;
    let is_seen = matches!(source, HeightSource::Foot | HeightSource::Floor) && method == Method::Ray;
    let kept = sizes.into_iter().filter(|(quantity, _)| *quantity != Quantity::Height || is_seen);
    kept.map(|(quantity, size)| (quantity, size.map(|estimate| with_shared(estimate, &marked.inputs)))).collect()
}

/// Where the height of the rim comes from, of a rim that is measured by what was found of it.
pub(super) fn height_source(marked: &Marked<'_>) -> Option<HeightSource> {
    Some(by_itself(marked)?.height_as(&marked.object.container).source)
}

/// What was found of the rim, unless a person has added other marks, or the object has another shape.
fn by_itself<'a>(marked: &'a Marked<'_>) -> Option<&'a Found> {
    let is_rim = |mark: &Mark| matches!(mark, Mark::Outline { feature: Feature::Rim, .. });
    let Container { kind, shape, .. } = marked.object.container;
    let is_as_found = |found: &&Found| kind != Kind::Box && (shape == Shape::Circle) == (found.shape == Shape::Circle);
    marked.found.as_ref().filter(|found| is_as_found(found) && marked.marks.marks.iter().all(is_rim))
}

/// Height and edge of a rim err alike in all images of it: that part counts as common; and images are weighed by all of it.
fn with_shared(estimate: Estimate, inputs: &InputSigma) -> Estimate {
    let Estimate { sigma, sensitivity, .. } = &estimate;
    let by_points_mm = sensitivity.marks_mm_per_px * inputs.mark_px;
    let shared_mm = (sigma.marks_mm.powi(2) - by_points_mm.powi(2)).max(0.0).sqrt();
    let sigma = SizeSigma { common_mm: sigma.common_mm.hypot(shared_mm), ..*sigma };
    let sensitivity = if inputs.mark_px > 0.0 {
        Sensitivity { marks_mm_per_px: sigma.marks_mm / inputs.mark_px, ..*sensitivity }
    } else {
        *sensitivity
    };
    Estimate { sigma, sensitivity, ..estimate }
}

/// The part of an estimate that all images share beyond their inputs; see [`with_shared`].
pub(super) fn shared_mm(estimate: &Estimate, inputs: &InputSigma) -> f64 {
    let by_inputs_mm = estimate.sensitivity.sigma(inputs).common_mm;
    (estimate.sigma.common_mm.powi(2) - by_inputs_mm.powi(2)).max(0.0).sqrt()
}

/// The uncertainty of a fused size, from weight and shared part of every image: what images share was fused as if it were each
/// image's own, and does not average out.
pub(super) fn fused_sigma(sigma: &SizeSigma, shares: impl IntoIterator<Item = (f64, f64)>, mark_px: f64) -> SizeSigma {
    let (mut averaged, mut common_mm) = (0.0, 0.0);
    for (weight, shared_mm) in shares {
        averaged += (weight * shared_mm).powi(2);
        common_mm += weight * shared_mm;
    }
    if common_mm <= 0.0 {
        return *sigma;
    }
    let averaged = if mark_px > 0.0 { averaged } else { 0.0 };
    let marks_mm = ((sigma.marks_mm.powi(2) - averaged).max(0.0) + common_mm.powi(2)).sqrt();
    SizeSigma { common_mm: sigma.common_mm.hypot(common_mm), ..sigma.with_marks(marks_mm) }
}
