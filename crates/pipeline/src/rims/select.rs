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

/// A circle raised above another one by this share of its radius (seen on Z = 0) stands in or on it.
const RAISED: f64 = 0.2;
/// ... if it is smaller than this share of it.
const STANDS_IN: f64 = 0.85;
/// An outer edge is about as likely as the inner one, this share of it at least ...
const AS_LIKELY: f64 = 0.7;
/// ... its edges cover as much of it, this share at least ...
const AS_COVERED: f64 = 0.6;
/// ... and are as strong, this share at least: a shadow's are soft ...
const AS_STRONG: f64 = 0.55;
/// ... and no larger than this multiple for the thickness of a rim, and this one for a rim around a well or floor.
const THICKEST: f64 = 1.3;
const WIDEST: f64 = 2.4;

/// Keeps one circle of each container, the likeliest first: of circles about one centre that are about as likely, the
/// largest. Those with less than the least confidence are none.
pub(super) fn one_per_container(mut all: Vec<Scored>, least_confidence: f64) -> Vec<Scored> {
    all.retain(|s| s.confidence >= least_confidence);
    all.sort_by(|a, b| b.confidence.total_cmp(&a.confidence));
    let mut kept: Vec<Scored> = Vec::new();
    for s in &all {
        if kept.iter().any(|k| !are_two(&k.arc, &s.arc)) {
            continue;
        }
        let is_like = |o: &&Scored| {
            o.confidence >= AS_LIKELY * s.confidence && (is_around(&o.arc, &s.arc) || is_around(&s.arc, &o.arc))
        };
        let mut group: Vec<&Scored> = all.iter().filter(is_like).chain([s]).collect();
        group.sort_by(|a, b| b.arc.disc.radius.total_cmp(&a.arc.disc.radius));
        let largest = group.iter().find(|o| !group.iter().any(|p| is_shadow(&o.arc, &p.arc))).unwrap_or(&s);
        if kept.iter().all(|k| are_two(&k.arc, &largest.arc)) {
            // The likeliest edge says how sure it is that there is a container.
            kept.push(Scored { confidence: s.confidence, ..(*largest).clone() });
        }
    }
    kept
}

/// Whether the outer circle is a shadow of the inner one: just outside it, much weaker, and in no way better.
pub(super) fn is_shadow(outer: &Arc, inner: &Arc) -> bool {
    let ratio = outer.disc.radius / inner.disc.radius;
    let is_weak = outer.contrast < AS_STRONG * inner.contrast;
    let is_worse = outer.coverage <= inner.coverage + 0.1 && outer.residual_px >= inner.residual_px;
    ratio > 1.01 && ratio < THICKEST && is_weak && is_worse
}

/// Whether a circle is the outer edge of what another one is the inner edge or the well of.
fn is_around(outer: &Arc, inner: &Arc) -> bool {
    let apart = (outer.disc.x - inner.disc.x).hypot(outer.disc.y - inner.disc.y);
    let wider = outer.disc.radius - inner.disc.radius;
    let edge_of_rim = outer.disc.radius < THICKEST * inner.disc.radius && apart <= 1.2 * wider;
    let rim_of_well = outer.disc.radius < WIDEST * inner.disc.radius && apart <= 0.5 * wider;
    let as_covered = outer.coverage >= AS_COVERED * inner.coverage;
    wider > 0.0 && (edge_of_rim || rim_of_well) && as_covered && !are_two(outer, inner)
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
