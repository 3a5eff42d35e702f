//! Sizes of found rims: the height of such a rim comes from the picture, with an uncertainty that its images share.

use model::{
    Container, Estimate, Feature, InputSigma, Kind, Mark, MeasureError, Method, Quantity, Sensitivity, Shape,
    SizeSigma, View, estimate,
};

use super::marked::Marked;
use crate::labelme::MarksAuthor;
use rims::{Found, HeightSource};

/// The sizes by one method: of people's marks as they are, of a found rim with the height that the program measured.
pub(super) fn estimates(
    marked: &Marked<'_>,
    view: &View,
    method: Method,
) -> Vec<(Quantity, Result<Estimate, MeasureError>)> {
    let (container, inputs) = (&marked.object.container, &marked.inputs);
    let Some(found) = by_itself(marked) else {
        return estimate(view, method, container, marked.marks, inputs);
    };
    // A rim alone has no base, so nothing can be coaxial with it.
    if method == Method::Coaxial {
        return Vec::new();
    }
    let sizes = found.sizes(view, method, container, marked.marks, inputs);
    // A height that is common among bowls is no measurement; and a foot or floor was found by exact geometry, not by the
    // paper's.
    let source = found.height_as(container).source;
    // The height was measured together with the rim that was found, and not with one that a person has moved.
    let is_as_found = marked.author == MarksAuthor::Program;
    let is_seen = is_as_found
        && matches!(source, HeightSource::Foot | HeightSource::Floor | HeightSource::Session)
        && method == Method::Ray;
    let kept = sizes.into_iter().filter(|(quantity, _)| *quantity != Quantity::Height || is_seen);
    kept.map(|(quantity, size)| (quantity, size.map(|estimate| with_shared(estimate, &marked.inputs)))).collect()
}

/// The source of the rim's height; none unless the rim is measured as the program found it.
pub(super) fn height_source(marked: &Marked<'_>) -> Option<HeightSource> {
    Some(by_itself(marked)?.height_as(&marked.object.container).source)
}

/// The found rim behind the marks; none where a person has added other marks, or the object has another shape.
fn by_itself<'a>(marked: &'a Marked<'_>) -> Option<&'a Found> {
    let is_rim = |mark: &Mark| matches!(mark, Mark::Outline { feature: Feature::Rim, .. });
    let Container { kind, shape, .. } = marked.object.container;
    let is_as_found = |found: &&Found| kind != Kind::Box && (shape == Shape::Circle) == (found.shape == Shape::Circle);
    marked.found.as_ref().filter(|found| is_as_found(found) && marked.marks.marks.iter().all(is_rim))
}

/// The estimate with the errors that its images share counted as common. The height and the edge of one rim err alike in all
/// of its images. Images are still weighed by the whole uncertainty.
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

/// The part of an estimate's uncertainty, in mm, that all images share beyond the common part of their inputs; see
/// [`with_shared`].
pub(super) fn shared_mm(estimate: &Estimate, inputs: &InputSigma) -> f64 {
    let by_inputs_mm = estimate.sensitivity.sigma(inputs).common_mm;
    (estimate.sigma.common_mm.powi(2) - by_inputs_mm.powi(2)).max(0.0).sqrt()
}

/// The uncertainty of a fused size; `shares` holds weight and shared part (mm) of every image. The fusion took what images
/// share for each image's own, but that part does not average out, so it is put back here.
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
