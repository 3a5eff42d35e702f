//! The objects that are marked on images with a pose, which is all that can be measured.

use model::{InputSigma, Method, ObjectMarks, Problem, ProblemCode, Severity, Stage, View};

use super::frames::{Frame, Session, inputs_of};
use super::session_marks::{MarkedObject, SessionMarks};
use crate::calibration::corrected_view;
use crate::labelme::MarksAuthor;
use crate::study::{AUTO, Object};
use rims::Found;

/// One object as one rater marked it on one image.
pub(super) struct Marked<'a> {
    pub session: &'a Session<'a>,
    /// The number of the image in its session.
    pub number: usize,
    pub frame: &'a Frame,
    pub rater: &'a str,
    pub object: &'a Object,
    pub marks: &'a ObjectMarks,
    /// The found rim behind the marks, where the program made them.
    pub found: Option<Found>,
    /// Who made the marks as they are now.
    pub author: MarksAuthor,
    /// The uncertainties of this image's inputs.
    pub inputs: InputSigma,
}

impl Marked<'_> {
    /// Whether they are marks of the rater [`AUTO`] that a person has made or changed.
    pub(super) fn is_corrected(&self) -> bool {
        self.rater == AUTO && self.author == MarksAuthor::Person
    }

    /// The view that a method works with, a calibration applied; none without a pose.
    pub(super) fn view(&self, method: Method) -> Option<View> {
        let view = View::new(self.session.marks_camera, self.frame.signals.pose_for(method)?);
        corrected_view(self.session.study.calibration.as_ref(), method, view)
    }
}

/// Everything that is marked on images with a pose, in the order of time, rater and object. A marked image without a pose
/// becomes a problem.
pub(super) fn marked<'a>(
    session: &'a Session<'a>,
    marks: &'a SessionMarks,
    problems: &mut Vec<Problem>,
) -> Vec<Marked<'a>> {
    let mut all = Vec::new();
    for (number, frame) in session.frames.iter().enumerate() {
        for (rater, objects) in marks.of_image(&frame.image.file) {
            if frame.signals.pose.is_none() {
                problems.push(unusable(session, frame, rater));
                continue;
            }
            let inputs = inputs_of(session.study, frame);
            all.extend(objects.iter().map(|MarkedObject { marks, object, found, author }| {
                let (found, author) = (*found, *author);
                Marked { session, number, frame, rater, object, marks, found, author, inputs }
            }));
        }
    }
    all
}

fn unusable(session: &Session<'_>, frame: &Frame, rater: &str) -> Problem {
    Problem {
        severity: Severity::Loss,
        stage: Stage::Signals,
        code: ProblemCode::MarkedImageWithoutPose,
        place: session.place_of(&frame.image.file),
        fact: format!("marked by {rater}, but {}", frame.signals.reason.meaning()),
        remedy: "mark another image of the same object, or see frames.parquet for the numbers behind it".to_owned(),
    }
}
