//! Sizes of everything that is marked on single images.

use std::collections::BTreeSet;

use model::{
    Doubt, Estimate, FrameFlag, InputSigma, MeasureError, Method, ObjectMarks, Problem, Quantity, ResultRow, Severity,
    Stage, View, best_of,
};

use super::found;
use super::marks::{MarkedObject, SessionMarks};
use super::row::frame_row;
use super::{Frame, Session};
use crate::calibrate::{corrected_view, inputs_after, scaled_paper};
use rims::Found;
use crate::study::{Object, Study};

/// One object as one rater marked it on one frame.
pub(super) struct Marked<'a> {
    pub session: &'a Session<'a>,
    /// Number of the frame in its session.
    pub number: usize,
    pub frame: &'a Frame,
    pub rater: &'a str,
    pub object: &'a Object,
    pub marks: &'a ObjectMarks,
    /// What is known of a rim that the program found.
    pub found: Option<Found>,
    /// Uncertainties of this image.
    pub inputs: InputSigma,
}

impl Marked<'_> {
    /// The view that a method works with; none without a pose.
    pub(super) fn view(&self, method: Method) -> Option<View> {
        let view = View::new(self.session.marks_camera, self.frame.signals.pose_for(method)?);
        corrected_view(self.session.study.calibration.as_ref(), method, view)
    }
}

/// A row with the estimate behind it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Measurement {
    pub row: ResultRow,
    /// None where the size could not be measured.
    pub estimate: Option<Estimate>,
    /// Uncertainties of its image.
    pub inputs: InputSigma,
    /// Number of the image in its session.
    pub picture: usize,
    /// Part of the marks' uncertainty that all images share, mm: the height and the edge of a rim that was found.
    pub shared_mm: f64,
    /// At least 1: factor on its variance where it is weighed against other images.
    pub penalty: f64,
}

/// The methods that give sizes from one image.
pub(super) const ON_ONE_IMAGE: [Method; 3] = [Method::Paper, Method::Ray, Method::Coaxial];

/// Everything that is marked on frames with a pose.
pub(super) fn marked<'a>(
    session: &'a Session<'a>,
    marks: &'a SessionMarks,
    problems: &mut Vec<Problem>,
) -> Vec<Marked<'a>> {
    let mut found = Vec::new();
    for (number, frame) in session.frames.iter().enumerate() {
        for (rater, objects) in marks.of_image(&frame.image.file) {
            if frame.signals.pose.is_none() {
                problems.push(unusable(session, frame, rater));
                continue;
            }
            let inputs = inputs_of(session.study, frame);
            found.extend(objects.iter().map(|MarkedObject { marks, object, found }| {
                let found = *found;
                Marked { session, number, frame, rater, object, marks, found, inputs }
            }));
        }
    }
    found
}

/// Sizes of single images, in the order that docs/results.md gives.
pub(super) fn measure_all(marked: &[Marked<'_>], problems: &mut Vec<Problem>) -> Vec<Measurement> {
    let mut found: Vec<Measurement> = marked.iter().flat_map(|marked| measure_one(marked, problems)).collect();
    found.sort_by(|a, b| order(&a.row).cmp(&order(&b.row)));
    found
}

/// What the rows of one session are ordered by.
fn order(row: &ResultRow) -> impl Ord + '_ {
    (row.time_utc, &row.image, &row.object, &row.rater, row.quantity, row.method)
}

/// Uncertainties of one image: the study's, with the noise that its own signals show.
pub(super) fn inputs_of(study: &Study, frame: &Frame) -> InputSigma {
    let signals = &frame.signals;
    let readings = f64::from(signals.range_distinct.max(1));
    let range_error_mm = signals.range_spread_mm.unwrap_or_default() / readings.sqrt();
    let inputs = study.spec.uncertainty.inputs_of_image(signals.stillness_mg.unwrap_or_default(), range_error_mm);
    inputs_after(study.calibration.as_ref(), inputs)
}

/// Doubts about an image that its uncertainties do not hold: motion near the threshold, readings of the range that scatter
/// by more than the sensor's accuracy, and flagged signals (docs/uncertainty.md).
pub(super) fn penalty_of(study: &Study, frame: &Frame) -> f64 {
    let signals = &frame.signals;
    let motion = signals.stillness_mg.unwrap_or_default() / study.spec.signals.stillness_max_mg;
    let range_mm = signals.range_mm.unwrap_or(f64::INFINITY);
    let spread = signals.range_spread_mm.unwrap_or_default() / (UNSTEADY_RANGE * range_mm);
    let doubtful = [FrameFlag::RangeHeld, FrameFlag::RangeStep, FrameFlag::GravityEdge];
    let flags = signals.flags.iter().filter(|flag| doubtful.contains(flag)).count();
    (1.0 + motion * motion) * (1.0 + spread * spread) * FLAGGED.powi(i32::try_from(flags).unwrap_or(i32::MAX))
}

/// Readings that scatter by this share of the range are unsteady.
const UNSTEADY_RANGE: f64 = 0.03;
/// A flag doubles the standard uncertainty that an image is weighed with.
const FLAGGED: f64 = 4.0;

fn measure_one(marked: &Marked<'_>, problems: &mut Vec<Problem>) -> Vec<Measurement> {
    let asked = &marked.session.study.spec.measure.methods;
    let wants_best = asked.contains(&Method::Best);
    let wanted = ON_ONE_IMAGE.into_iter().filter(|method| wants_best || asked.contains(method));
    let sizes: Vec<(Method, Quantity, Result<Estimate, MeasureError>)> = wanted
        .filter_map(|method| Some((method, marked.view(method)?)))
        .flat_map(|(method, view)| {
            let found = found::estimates(marked, &view, method);
            found.into_iter().map(move |(quantity, size)| (method, quantity, size.map(|e| as_read(marked, &view, e))))
        })
        .collect();
    tell(marked, &sizes, problems);
    let best = if wants_best { best_sizes(&sizes) } else { Vec::new() };
    // Methods that were not asked for are candidates for the best, and left out at the end.
    sizes
        .into_iter()
        .chain(best)
        .filter_map(|(method, quantity, size)| measurement(marked, method, quantity, size))
        .collect()
}

/// The paper's method takes readings as they are, and has a line in tan(pitch) at most; where the study or its calibration
/// says that readings are off, that is a doubt.
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

/// The best of each quantity, in place of any method of its own.
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

/// What could not be measured, each kind of it once; and objects whose marks give nothing at all. A height that nobody marked
/// is no problem where another method does without.
fn tell(
    marked: &Marked<'_>,
    sizes: &[(Method, Quantity, Result<Estimate, MeasureError>)],
    problems: &mut Vec<Problem>,
) {
    let measured: BTreeSet<Quantity> = sizes.iter().filter(|(.., s)| s.is_ok()).map(|(_, q, _)| *q).collect();
    let mut told = BTreeSet::new();
    for (_, quantity, size) in sizes {
        if let Err(error) = size
            && !(*error == MeasureError::NoHeight && measured.contains(quantity))
            && told.insert((*quantity, error.code()))
        {
            problems.push(unmeasured(marked, *quantity, error));
        }
    }
    // Marks for a method that needs several images give nothing on one.
    if sizes.is_empty() && marked.session.study.spec.measure.methods.iter().any(|m| *m != Method::Joint) {
        problems.push(nothing(marked));
    }
}

fn unusable(session: &Session<'_>, frame: &Frame, rater: &str) -> Problem {
    Problem {
        severity: Severity::Loss,
        stage: Stage::Signals,
        code: "marked_image_without_pose".to_owned(),
        place: session.place_of(&frame.image.file),
        fact: format!("marked by {rater}, but {}", frame.signals.reason.meaning()),
        remedy: "mark another image of the same object, or see frames.parquet for the numbers behind it".to_owned(),
    }
}

fn unmeasured(marked: &Marked<'_>, quantity: Quantity, error: &MeasureError) -> Problem {
    Problem {
        severity: Severity::Loss,
        stage: Stage::Measure,
        code: error.code().to_owned(),
        place: marked.session.place_of(&marked.frame.image.file),
        fact: format!("{quantity} of '{}' marked by {}: {error}", marked.marks.object, marked.rater),
        remedy: "correct the marks in LabelMe and run again".to_owned(),
    }
}

fn nothing(marked: &Marked<'_>) -> Problem {
    let shape = marked.object.container.shape;
    Problem {
        severity: Severity::Loss,
        stage: Stage::Measure,
        code: "nothing_to_measure".to_owned(),
        place: marked.session.place_of(&marked.frame.image.file),
        fact: format!("the marks of '{}' by {} give no size of a {shape}", marked.marks.object, marked.rater),
        remedy: "mark a diameter, width, length, height or the rim (docs/study.md)".to_owned(),
    }
}
