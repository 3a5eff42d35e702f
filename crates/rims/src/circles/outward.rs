//! From an inner edge to the outer one: rims have a thickness, plates a well, cans a groove.

use super::arcs::refit;
use super::bins::{BINS, bin_length};
use super::buckets::Buckets;
use super::select::is_shadow;
use super::trial::{Arc, RING_PX, Trial};

/// A rim is looked for out to this multiple of an inner edge's radius: a well or groove further in is a circle of its own.
const FURTHEST: f64 = 1.3;
/// Nearer edges are the same one.
const NEAREST: f64 = 1.02;
/// The step from one radius that is tried to the next, as a share of the radius.
const STEP: f64 = 0.01;
/// Radii that are tried.
const RINGS: usize = 29;
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
    let ratio = |ring: usize| NEAREST + STEP * f64::from(u32::try_from(ring).unwrap_or(u32::MAX));
    let rings = coverage_of_rings(buckets, arc, most_oval);
    (1..RINGS - 1).rev().find_map(|i| {
        // Half of what is needed is enough to start from: the centre moves a little.
        if rings[i] < 0.5 * needed || rings[i] < rings[i - 1] || rings[i] < rings[i + 1] {
            return None;
        }
        let outer = refit(buckets, &arc.scaled(ratio(i)), most_oval)?;
        let shift = (outer.disc.x - arc.disc.x).hypot(outer.disc.y - arc.disc.y);
        let (wider, grown) = (outer.disc.radius - arc.disc.radius, outer.disc.radius / arc.disc.radius);
        (outer.coverage >= needed && !is_shadow(&outer, arc) && grown >= NEAREST && shift <= 1.2 * wider)
            .then_some(outer)
    })
}

/// Share of each ring about the centre that has an edge along it.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "rings, bins")]
fn coverage_of_rings(buckets: &Buckets, arc: &Arc, most_oval: f64) -> [f64; RINGS] {
    let (trial, radius) = (Trial { disc: arc.disc, oval: arc.oval, most_oval }, arc.disc.radius as f32);
    let mut lengths = vec![[0.0_f32; BINS]; RINGS];
    buckets.near_rim(&arc.disc, (FURTHEST + 0.1 - 1.0) as f32 * radius, |e| {
        let Some((off, bin)) = trial.along(e) else { return };
        let ring_of = |off: f32| ((off / radius + 1.0 - NEAREST as f32) / STEP as f32).max(0.0);
        let reach = RING_PX * e.scale;
        let (first, last) = (ring_of(off - reach).ceil() as usize, ring_of(off + reach).floor() as usize);
        if off + reach >= (NEAREST as f32 - 1.0) * radius {
            for ring in &mut lengths[first.min(RINGS)..(last + 1).min(RINGS).max(first.min(RINGS))] {
                ring[bin] += e.length;
            }
        }
    });
    let mut coverage = [0.0; RINGS];
    for (ring, share) in coverage.iter_mut().enumerate() {
        let needed = bin_length(radius * (NEAREST + STEP * ring as f64) as f32);
        *share = lengths[ring].iter().filter(|l| **l >= needed).count() as f64 / BINS as f64;
    }
    coverage
}
