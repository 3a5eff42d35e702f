//! The choice of the circles that are rims: one per container.

use super::trial::Arc;
use crate::evidence::Evidence;

/// A circle with the evidence for it.
#[derive(Debug, Clone)]
pub(crate) struct Scored {
    pub arc: Arc,
    pub evidence: Evidence,
    /// The evidence for the likeliest edge of the same container, which may be another one: the confidence follows from that one.
    pub best: Evidence,
    pub confidence: f64,
}

/// A circle raised above another one by this share of its radius (seen on Z = 0) stands in or on it.
const RAISED: f64 = 0.2;
/// A circle stands in or on another one only if it is smaller than this share of it.
const STANDS_IN: f64 = 0.85;
/// An outer edge is taken if it is at least this share as likely as the inner one.
const AS_LIKELY: f64 = 0.7;
/// A rim that hands hide is taken if it is at least this share as likely as the circle that it holds.
const AS_LIKELY_OVER: f64 = 0.4;
/// The edges of the outer circle cover at least this share of what those of the inner one cover.
const AS_COVERED: f64 = 0.65;
/// The edges of the outer circle are at least this share as strong as those of the inner one: those of a shadow are soft.
const AS_STRONG: f64 = 0.55;
/// ... and no larger than this multiple for the thickness of a rim, and this one for a rim around a well or floor.
const THICKEST: f64 = 1.3;
const WIDEST: f64 = 2.4;
/// The greatest number of steps from foot or food to the rim.
const STEPS_OUT: usize = 4;
/// Cups are as high as this multiple of their diameter.
const HIGHEST: f64 = 1.2;
/// Two circles share an axis if the line through their centres passes the point under the camera within this share of the radius.
const OFF_AXIS: f64 = 0.12;
/// Feet and floors are wider than this share of the rim, shadows narrower than this multiple (seen on Z = 0).
const INNERMOST: f64 = 0.35;
const OUTERMOST: f64 = 1.25;
/// Nothing of a container is seen beyond its rim, which reaches further from the wearer by this share of its radius (thickness
/// and prints of the rim itself are looked at later) ...
const FURTHER: f64 = 0.05;
/// The rim is seen at least this share as well there.
const AS_FAR: f64 = 0.6;
/// Of a rim before another one at least this share of the far half is seen.
const SHOWN: f64 = 0.5;

/// Keeps one circle of each container, the likeliest first: of circles about one upright axis that are about as likely, the
/// rim, which is the one that reaches furthest from the wearer. `camera_mm`: height of the camera above the table.
pub(crate) fn one_per_container(mut all: Vec<Scored>, camera_mm: f64, least_confidence: f64) -> Vec<Scored> {
    all.retain(|s| s.confidence >= least_confidence);
    all.sort_by(|a, b| b.confidence.total_cmp(&a.confidence));
    let mut kept: Vec<Scored> = Vec::new();
    for s in &all {
        if !kept.iter().all(|k| are_two(k, s, camera_mm)) {
            continue;
        }
        let rim = rim_of(s, &all, camera_mm);
        if kept.iter().all(|k| are_two(k, rim, camera_mm)) {
            // The likeliest edge says how sure it is that there is a container.
            kept.push(Scored { confidence: s.confidence, best: s.best, ..rim.clone() });
        }
    }
    kept
}

/// From a groove, well, floor or surface of food to the rim about the same axis.
fn rim_of<'a>(s: &'a Scored, all: &'a [Scored], camera_mm: f64) -> &'a Scored {
    let mut rim = s;
    for _ in 0..STEPS_OUT {
        let is_further = |o: &&Scored| {
            let is_rim = (o.confidence >= AS_LIKELY * s.confidence && is_around(&o.arc, &rim.arc))
                || (o.confidence >= AS_LIKELY_OVER * s.confidence && is_over(o, rim, camera_mm));
            is_rim
                && o.arc.coverage >= AS_COVERED * rim.arc.coverage
                && far_edge(&o.arc) - far_edge(&rim.arc) > FURTHER * o.arc.disc.radius
                && !is_shadow(&o.arc, &rim.arc)
        };
        match all.iter().filter(is_further).max_by(|a, b| far_edge(&a.arc).total_cmp(&far_edge(&b.arc))) {
            Some(further) => rim = further,
            None => break,
        }
    }
    rim
}

/// Distance of a circle's far edge from the point under the camera.
fn far_edge(arc: &Arc) -> f64 {
    arc.disc.x.hypot(arc.disc.y) + arc.disc.radius
}

/// Whether one circle can be the rim of what the other one is the foot, floor, food or shadow of: about the same upright
/// axis, which runs to the point under the camera, and higher up.
fn is_over(upper: &Scored, lower: &Scored, camera_mm: f64) -> bool {
    let (u, l) = (&upper.arc.disc, &lower.arc.disc);
    let away = u.x.hypot(u.y);
    if away < 1e-6 {
        return false;
    }
    let (dx, dy) = (u.x - l.x, u.y - l.y);
    let (along, across) = ((dx * u.x + dy * u.y) / away, (dx * u.y - dy * u.x).abs() / away);
    let highest = 1.0 + 2.0 * HIGHEST * u.radius / camera_mm;
    let ratio = l.radius / u.radius;
    across < OFF_AXIS * u.radius
        && along > 0.0
        && along <= away * (1.0 - 1.0 / highest)
        && (INNERMOST..OUTERMOST).contains(&ratio)
        && upper.evidence.far >= AS_FAR * lower.evidence.far
}

/// Whether the outer circle is a shadow of the inner one: just outside it, much weaker, and in no way better.
pub(crate) fn is_shadow(outer: &Arc, inner: &Arc) -> bool {
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
    wider > 0.0 && (edge_of_rim || rim_of_well) && !is_raised(inner, outer)
}

/// Whether two circles can be the rims of two containers.
fn are_two(a: &Scored, b: &Scored, camera_mm: f64) -> bool {
    // What stands before another container hides part of it, and shows all of its own rim: its foot and its shadow do not.
    let is_below = |upper: &Scored, lower: &Scored| {
        lower.evidence.far < SHOWN && far_edge(&upper.arc) > far_edge(&lower.arc) && is_over(upper, lower, camera_mm)
    };
    if is_below(a, b) || is_below(b, a) {
        return false;
    }
    let (a, b) = (&a.arc, &b.arc);
    let apart = (a.disc.x - b.disc.x).hypot(a.disc.y - b.disc.y);
    let (small, large) = if a.disc.radius < b.disc.radius { (a, b) } else { (b, a) };
    apart >= 0.8 * large.disc.radius || is_raised(small, large)
}

/// A cup on its saucer: smaller, and higher, so seen further from the point under the camera.
fn is_raised(small: &Arc, large: &Arc) -> bool {
    let raised = small.disc.x.hypot(small.disc.y) - large.disc.x.hypot(large.disc.y);
    small.disc.radius < STANDS_IN * large.disc.radius && raised > RAISED * small.disc.radius
}
