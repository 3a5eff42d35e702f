//! Set-ups that can hardly be: numbers of a session that no wearer, sensor or camera has, each with its likely cause. They pass every
//! check of form, and every size would be wrong.

mod camera;
mod limits;
mod pose;
#[cfg(test)]
mod tests;

use model::{Problem, ProblemCode, Severity, Stage};

use super::frames::Session;
use super::prepared::Prepared;

/// The problems of a session whose camera, gravity, angles or ranges cannot be. `mount_pitch_deg` is the mount offset that was used.
pub(super) fn problems(session: &Session<'_>, prepared: &Prepared, mount_pitch_deg: f64) -> Vec<Problem> {
    let signals: Vec<_> = session.frames.iter().map(|frame| &frame.signals).collect();
    let looked = pose::Looked::new(&signals);
    let select = &session.study.spec.select;
    let setup_pitch_deg = session.spec.setup_pitch_deg;
    let mut doubts = pose::doubts(&looked, select, setup_pitch_deg, mount_pitch_deg);
    let cameras = [Some(&prepared.camera), (session.marks_camera != prepared.camera).then_some(&session.marks_camera)];
    doubts.extend(cameras.into_iter().flatten().flat_map(camera::doubts));
    doubts.into_iter().map(|doubt| doubt.problem(&format!("cards/{}", session.dir.name))).collect()
}

/// A number that cannot be, and its likely cause.
#[derive(Debug, Clone, PartialEq)]
struct SetupDoubt {
    severity: Severity,
    code: ProblemCode,
    fact: String,
    cause: String,
}

impl SetupDoubt {
    fn problem(self, place: &str) -> Problem {
        Problem {
            severity: self.severity,
            stage: Stage::Signals,
            code: self.code,
            place: place.to_owned(),
            fact: self.fact,
            remedy: self.cause,
        }
    }
}
