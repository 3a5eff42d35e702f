//! The sizes of a session that are known, for a calibration to learn from.

use model::calibrate::physical::BenchSize;
use model::{Estimate, Method, Pose, Quantity, View, best_of, estimate};

use super::frames::Session;
use super::marked::Marked;
use super::output::BenchSession;

/// The sizes that have a truth, each by the surest exact method whose assumptions hold, and the angles that were set.
pub(super) fn bench_session(session: &Session<'_>, marked: &[Marked<'_>]) -> BenchSession {
    let spec = &session.spec;
    let sizes = |pose: fn(&Marked<'_>) -> Option<Pose>| {
        marked.iter().filter_map(|m| Some((m, pose(m)?))).flat_map(|(m, pose)| known_sizes(session, m, pose)).collect()
    };
    let measured = session.frames.iter().filter_map(|frame| frame.signals.pitch_roll_rad);
    let angles = spec.setup_pitch_deg.into_iter();
    BenchSession {
        declared: spec.setup_pitch_deg.is_some() || spec.setup_height_mm.is_some(),
        sizes: sizes(|m| m.frame.signals.pose),
        cone_sizes: sizes(|m| m.frame.signals.cone_pose),
        angles_deg: angles.flat_map(|set| measured.clone().map(move |(pitch, _)| (set, pitch.to_degrees()))).collect(),
    }
}

fn known_sizes(session: &Session<'_>, m: &Marked<'_>, pose: Pose) -> Vec<BenchSize> {
    let view = View::new(session.marks_camera, pose);
    let sizes: Vec<(Quantity, Estimate)> = [Method::Coaxial, Method::Ray]
        .into_iter()
        .flat_map(|method| estimate(&view, method, &m.object.container, m.marks, &m.inputs))
        .filter_map(|(quantity, size)| Some((quantity, size.ok()?)))
        .filter(|(_, size)| size.doubts.is_empty())
        .collect();
    let known = |(quantity, true_mm): (&Quantity, &f64)| {
        let of_quantity = sizes.iter().filter(|(q, _)| q == quantity).map(|(_, size)| size);
        Some(BenchSize {
            object: m.marks.object.clone(),
            setup: session.dir.name.clone(),
            view,
            method: best_of(of_quantity)?.method,
            container: m.object.container,
            marks: m.marks.clone(),
            quantity: *quantity,
            true_mm: *true_mm,
            inputs: m.inputs,
        })
    };
    m.object.truth_mm.iter().filter_map(known).collect()
}
