//! Step *measure*: turns the marks on single images into sizes with their uncertainty.
//!
//! - Input: the marked objects of a session ([`Marked`]), and `[measure]` of study.toml.
//! - Output: one [`Measurement`] for each object, rater, image, quantity and method.

use std::collections::{BTreeMap, BTreeSet};

use model::{
    Doubt, Estimate, InputSigma, MeasureError, Method, Problem, ProblemCode, Quantity, ResultRow, Severity, Stage,
    View, best_of,
};

use super::found;
use super::frames::penalty_of;
use super::marked::Marked;
use super::row::frame_row;
use crate::calibration::scaled_paper;

/// A row of level frame with the estimate behind it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Measurement {
    pub row: ResultRow,
    /// The estimate; none where the size could not be measured.
    pub estimate: Option<Estimate>,
    /// The uncertainties of the image's inputs.
    pub inputs: InputSigma,
    /// The number of the image in its session.
    pub picture: usize,
    /// The part of the marks' uncertainty, in mm, that all images share: the height and the edge of a found rim.
    pub shared_mm: f64,
    /// The factor, at least 1, on the variance with which the size is weighed against those of other images.
    pub penalty: f64,
}

/// The methods that give sizes from a single image.
pub(super) const ON_ONE_IMAGE: [Method; 3] = [Method::Paper, Method::Ray, Method::Coaxial];

/// The sizes on all images, in the order that docs/results.md gives. A size that cannot be measured becomes a problem.
pub(super) fn measure_all(marked: &[Marked<'_>], problems: &mut Vec<Problem>) -> Vec<Measurement> {
    let mut measurements: Vec<Measurement> = marked.iter().flat_map(|marked| measure_one(marked, problems)).collect();
    measurements.sort_by(|a, b| order(&a.row).cmp(&order(&b.row)));
    measurements
}

/// The key by which the rows of a session are ordered.
fn order(row: &ResultRow) -> impl Ord + '_ {
    (row.time_utc, &row.image, &row.object, &row.rater, row.quantity, row.method)
}

fn measure_one(marked: &Marked<'_>, problems: &mut Vec<Problem>) -> Vec<Measurement> {
    let asked = &marked.session.study.spec.measure.methods;
    let wants_best = asked.contains(&Method::Best);
    let wanted = ON_ONE_IMAGE.into_iter().filter(|method| wants_best || asked.contains(method));
    let sizes: Vec<(Method, Quantity, Result<Estimate, MeasureError>)> = wanted
        .filter_map(|method| Some((method, marked.view(method)?)))
        .flat_map(|(method, view)| {
            let estimates = found::estimates(marked, &view, method);
            estimates
                .into_iter()
                .map(move |(quantity, size)| (method, quantity, size.map(|e| as_read(marked, &view, e))))
        })
        .collect();
    report_unmeasured(marked, &sizes, problems);
    let best = if wants_best { best_sizes(&sizes) } else { Vec::new() };
    // A method that was not asked for is still a candidate for the best; its rows are left out at the end.
    sizes
        .into_iter()
        .chain(best)
        .filter_map(|(method, quantity, size)| measurement(marked, method, quantity, size))
        .collect()
}

/// The estimate with a doubt where it is by the paper's method and the study or its calibration says that the readings are
/// off: that method takes them as they are, or corrects them by a line in tan(pitch) at most.
fn as_read(marked: &Marked<'_>, view: &View, estimate: Estimate) -> Estimate {
    let study = marked.session.study;
    let kind = marked.object.container.kind;
    let mut estimate = scaled_paper(study.calibration.as_ref(), kind, view, &marked.inputs, estimate);
    let differs = marked.view(Method::Paper) != marked.view(Method::Ray);
    if estimate.method == Method::Paper && differs && !estimate.doubts.contains(&Doubt::PaperApproximation) {
        estimate.doubts.push(Doubt::PaperApproximation);
    }
    estimate
}

/// The best size of each quantity, as rows of method 'best'.
fn best_sizes(
    sizes: &[(Method, Quantity, Result<Estimate, MeasureError>)],
) -> Vec<(Method, Quantity, Result<Estimate, MeasureError>)> {
    let quantities: BTreeSet<Quantity> = sizes.iter().map(|(_, quantity, _)| *quantity).collect();
    let best = |quantity: Quantity| {
        let of_quantity = || sizes.iter().filter(move |(_, q, _)| *q == quantity).map(|(.., size)| size);
        let best = best_of(of_quantity().filter_map(|size| size.as_ref().ok())).cloned();
        let refused = || of_quantity().find_map(|size| size.as_ref().err().copied());
        match best {
            Some(best) => Some((Method::Best, quantity, Ok(best))),
            None => refused().map(|error| (Method::Best, quantity, Err(error))),
        }
    };
    quantities.into_iter().filter_map(best).collect()
}

fn measurement(
    marked: &Marked<'_>,
    method: Method,
    quantity: Quantity,
    size: Result<Estimate, MeasureError>,
) -> Option<Measurement> {
    let used = size.as_ref().map_or(method, |estimate| estimate.method);
    let view = marked.view(used)?;
    Some(Measurement {
        shared_mm: size.as_ref().map_or(0.0, |estimate| match marked.found {
            Some(_) => found::shared_mm(estimate, &marked.inputs),
            None => 0.0,
        }),
        row: frame_row(marked, *view.pose(), method, quantity, &size),
        estimate: size.ok(),
        inputs: marked.inputs,
        picture: marked.number,
        penalty: penalty_of(marked.session.study, marked.frame),
    })
}

/// Adds a problem for each kind of thing that could not be measured, and for an object whose marks give nothing at all. A
/// height that nobody marked is no problem where another method does without it.
fn report_unmeasured(
    marked: &Marked<'_>,
    sizes: &[(Method, Quantity, Result<Estimate, MeasureError>)],
    problems: &mut Vec<Problem>,
) {
    let measured: BTreeSet<Quantity> = sizes.iter().filter(|(.., s)| s.is_ok()).map(|(_, q, _)| *q).collect();
    let mut reported = BTreeSet::new();
    for (_, quantity, size) in sizes {
        if let Err(error) = size
            && !(*error == MeasureError::NoHeight && measured.contains(quantity))
            && reported.insert((*quantity, error.problem_code()))
        {
            problems.push(unmeasured(marked, *quantity, error));
        }
    }
    problems.extend(left_out(marked, sizes));
    // Marks for a method that needs several images give nothing on one of them.
    if sizes.is_empty() && marked.session.study.spec.measure.methods.iter().any(|m| *m != Method::Joint) {
        problems.push(nothing(marked));
    }
}

fn unmeasured(marked: &Marked<'_>, quantity: Quantity, error: &MeasureError) -> Problem {
    Problem {
        severity: Severity::Loss,
        stage: Stage::Measure,
        code: error.problem_code(),
        place: marked.session.place_of(&marked.frame.image.file),
        fact: format!("{quantity} of '{}' marked by {}: {error}", marked.marks.object, marked.rater),
        remedy: "correct the marks in LabelMe and run again".to_owned(),
    }
}

/// One problem for each quantity of which a mark, or points of an outline, contradict the others and were left out.
fn left_out(marked: &Marked<'_>, sizes: &[(Method, Quantity, Result<Estimate, MeasureError>)]) -> Vec<Problem> {
    let mut facts: BTreeMap<Quantity, String> = BTreeMap::new();
    for (_, quantity, size) in sizes {
        let Ok(Estimate { measured, .. }) = size else { continue };
        let lines = measured.left_out.map(|left| {
            let (marks, used) = (left.marks, measured.marks);
            format!(
                "{marks} of {} marks ({}, {:.1} mm) left out, which contradict the other {used}",
                marks + used,
                left.furthest,
                left.furthest_mm
            )
        });
        let points = (measured.stray_points > 0)
            .then(|| format!("{} points left out, which lie far off their outline", measured.stray_points));
        let parts: Vec<String> = lines.into_iter().chain(points).collect();
        if !parts.is_empty() {
            facts.entry(*quantity).or_insert_with(|| format!("{:.1} mm: {}", measured.predicted_mm, parts.join("; ")));
        }
    }
    let problem = |(quantity, fact): (Quantity, String)| Problem {
        severity: Severity::Loss,
        stage: Stage::Measure,
        code: ProblemCode::MarkLeftOut,
        place: marked.session.place_of(&marked.frame.image.file),
        fact: format!("{quantity} of '{}' marked by {}, {fact}", marked.marks.object, marked.rater),
        remedy: ProblemCode::MarkLeftOut.remedy().to_owned(),
    };
    facts.into_iter().map(problem).collect()
}

fn nothing(marked: &Marked<'_>) -> Problem {
    let shape = marked.object.container.shape;
    Problem {
        severity: Severity::Loss,
        stage: Stage::Measure,
        code: ProblemCode::NothingToMeasure,
        place: marked.session.place_of(&marked.frame.image.file),
        fact: format!("the marks of '{}' by {} give no size of a {shape}", marked.marks.object, marked.rater),
        remedy: "mark a diameter, width, length, height or the rim (docs/study.md)".to_owned(),
    }
}
