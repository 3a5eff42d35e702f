//! From an inner edge to the outer one: rims have a thickness, plates a well, cans a groove.

use super::arcs::{self, Arc, Trial};
use super::buckets::Buckets;
use super::ground::GroundEdge;
use super::votes::Disc;

/// A rim is looked for out to this multiple of an inner edge's radius: a well or groove further in is a circle of its own.
const FURTHEST: f64 = 1.3;
/// Nearer edges are the same one.
const NEAREST: f64 = 1.02;
/// Steps of the radius.
const STEP: f64 = 0.01;
/// An outer edge has at least this share of the inner one's support.
const LEAST_SUPPORT: f64 = 0.6;
/// Chance rings about the same centre have less support than this, whatever the inner one has.
const LEAST_COVERAGE: f64 = 0.4;

/// The outermost edge about the same centre that is about as well supported.
pub(super) fn outermost(buckets: &Buckets, arc: Arc, most_oval: f64) -> Arc {
    let mut best = arc;
    // A groove leads to the rim's inner edge, and that to the outer one.
    for _ in 0..3 {
        match next_outward(buckets, &best, most_oval) {
            Some(outer) => best = outer,
            None => break,
        }
    }
    best
}

fn next_outward(buckets: &Buckets, arc: &Arc, most_oval: f64) -> Option<Arc> {
    let needed = (LEAST_SUPPORT * arc.coverage).max(LEAST_COVERAGE);
    #[expect(clippy::cast_possible_truncation, reason = "mm")]
    let near: Vec<GroundEdge> = buckets.near_rim(&arc.disc, (FURTHEST + 0.1 - 1.0) as f32 * arc.disc.radius as f32).copied().collect();
    let ring = |ratio: f64| {
        let disc = Disc { radius: arc.disc.radius * ratio, ..arc.disc };
        let oval = arc.oval.map(|o| o * ratio);
        arcs::support(&near, &Trial { disc, oval, most_oval })
    };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few dozen steps")]
    let steps = ((FURTHEST - NEAREST) / STEP) as u32;
    let rings: Vec<Arc> = (0..=steps).map(|i| ring(NEAREST + STEP * f64::from(i))).collect();
    (1..rings.len().saturating_sub(1)).rev().find_map(|i| {
        let coverage = rings[i].coverage;
        // Half of what is needed is enough to start from: the centre moves a little.
        if coverage < 0.5 * needed || coverage < rings[i - 1].coverage || coverage < rings[i + 1].coverage {
            return None;
        }
        let outer = arcs::refit(buckets, &rings[i], most_oval)?;
        let shift = (outer.disc.x - arc.disc.x).hypot(outer.disc.y - arc.disc.y);
        let grown = outer.disc.radius / arc.disc.radius;
        (outer.coverage >= needed && grown >= NEAREST && shift <= 1.2 * (outer.disc.radius - arc.disc.radius)).then_some(outer)
    })
}
