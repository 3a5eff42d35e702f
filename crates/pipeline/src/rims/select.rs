//! Which of the circles found are rims: one per container.

use super::arcs::Arc;
use super::significance::Evidence;

/// A circle with what speaks for it.
#[derive(Debug, Clone)]
pub(super) struct Scored {
    pub arc: Arc,
    pub evidence: Evidence,
    pub confidence: f64,
}

/// A circle less likely than this is none.
const LEAST_CONFIDENCE: f64 = 0.2;
/// A circle raised above another one by this share of its radius (seen on Z = 0) stands in or on it.
const RAISED: f64 = 0.2;
/// ... if it is smaller than this share of it.
const STANDS_IN: f64 = 0.85;

/// Keeps the most likely circle of each container.
pub(super) fn rims(mut all: Vec<Scored>) -> Vec<Scored> {
    all.retain(|s| s.confidence >= LEAST_CONFIDENCE);
    all.sort_by(|a, b| rank(b).total_cmp(&rank(a)));
    let mut kept: Vec<Scored> = Vec::new();
    for s in all {
        if kept.iter().all(|k| are_two(&k.arc, &s.arc)) {
            kept.push(s);
        }
    }
    kept
}

/// Of circles about one centre with like support, the larger one is the rim.
fn rank(s: &Scored) -> f64 {
    s.confidence
}

/// Whether two circles can be the rims of two containers.
fn are_two(a: &Arc, b: &Arc) -> bool {
    let apart = (a.disc.x - b.disc.x).hypot(a.disc.y - b.disc.y);
    if apart >= 0.8 * a.disc.radius.max(b.disc.radius) {
        return true;
    }
    // A cup on its saucer: smaller, and higher, so seen further from the point under the camera.
    let (small, large) = if a.disc.radius < b.disc.radius { (a, b) } else { (b, a) };
    let raised = small.disc.x.hypot(small.disc.y) - large.disc.x.hypot(large.disc.y);
    small.disc.radius < STANDS_IN * large.disc.radius && raised > RAISED * small.disc.radius
}
