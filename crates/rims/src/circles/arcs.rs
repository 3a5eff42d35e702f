//! A likely circle fitted to the edges along it, and how much of it they cover.

use super::buckets::Buckets;
use super::fitting::{Near, Within};
use super::support::support;
use super::trial::{Arc, Disc, RING_PX, Trial};

/// Widths of the ring around the circle in which edges count, in radii, from pass to pass of a fit: in rough passes the circle
/// is round, in fine ones it may look oval. And steps of a pass.
const ROUGH: [f32; 2] = [0.12, 0.06];
const ROUGH_STEPS: u8 = 2;
const FINE: [f32; 2] = [0.03, 0.0];
const FINE_STEPS: u8 = 3;
/// The edges of a fit lie in a ring of this width around its start, in radii.
const GATHERED: f32 = 0.25;
/// The edges of a fit point to the centre of its start within about 30 degrees: the least cosine.
const GATHERED_COSINE: f32 = 0.86;
/// After the first steps, edges further from the circle than this, in radii, are left out.
const KEPT: f32 = 0.12;
/// Before the last steps, edges further from the circle than this many rings are left out.
const CLOSE: f32 = 2.0;
/// A circle is given up if it has less edge than this in its ring after the rough steps, relative to its length.
const LEAST_START: f32 = 0.25;
/// A circle is given up if a smaller share of its bins than this is covered after the rough steps.
const LEAST_START_COVERAGE: f64 = 0.22;
/// A circle is given up if it has less edge than this along it before the last steps, or after them, relative to its length.
const LEAST_SHARE: f32 = 0.2;
/// Circles with less of their bins covered are not looked at further.
const LEAST_COVERAGE: f64 = 0.3;
/// A likely circle after the rough steps, by pieces of chains.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rough {
    start: Disc,
    trial: Trial,
    /// Share of its bins that have edges in a wide ring.
    pub coverage: f64,
    /// Largest scale of the edges about it, in mm per scaled pixel.
    largest_scale: f32,
}

/// The rough steps of a fit to `pieces` of chains; none when there are too few, or it runs away.
#[expect(clippy::cast_possible_truncation, reason = "mm")]
pub(super) fn rough(pieces: &Buckets, start: &Disc) -> Option<Rough> {
    let mut near = Near::gather(pieces, start, &about(GATHERED * start.radius as f32));
    let mut trial = Trial { disc: *start, oval: [0.0; 2], most_oval: 0.0 };
    for (pass, width) in ROUGH.into_iter().enumerate() {
        if pass > 0 {
            near.keep(&trial, width, CLOSE);
        }
        trial = steps(&near, trial, start, width, ROUGH_STEPS)?;
    }
    let coverage = near.coverage(&trial, FINE[0]);
    let is_worth_it = near.share(&trial, FINE[0]) >= LEAST_START && coverage >= LEAST_START_COVERAGE;
    is_worth_it.then(|| Rough { start: *start, trial, coverage, largest_scale: near.largest_scale() })
}

/// The fine steps of a fit, to every edge; none when there are too few along the circle, or it runs away. `most_oval`: how far
/// from round, relative to its radius, it may look for an error of the pose.
#[expect(clippy::cast_possible_truncation, reason = "mm")]
pub(super) fn fine(buckets: &Buckets, rough: &Rough, most_oval: f64) -> Option<Arc> {
    let mut trial = Trial { most_oval, ..rough.trial };
    let mut near = close_to(buckets, &trial, FINE[0] * rough.start.radius as f32, rough.largest_scale);
    for (pass, width) in FINE.into_iter().enumerate() {
        if pass > 0 {
            near.keep(&trial, width, CLOSE);
            if near.share(&trial, width) < LEAST_SHARE {
                return None;
            }
        }
        trial = steps(&near, trial, &rough.start, width, FINE_STEPS)?;
    }
    if near.share(&trial, 0.0) < LEAST_SHARE || near.coverage(&trial, 0.0) < LEAST_COVERAGE {
        return None;
    }
    Some(support(buckets, &trial))
}

/// Takes some steps of the fit; none where the circle runs away from its start.
fn steps(near: &Near, mut trial: Trial, start: &Disc, width: f32, count: u8) -> Option<Trial> {
    for _ in 0..count {
        trial = near.step(&trial, width)?;
        let moved = (trial.disc.x - start.x).hypot(trial.disc.y - start.y);
        if moved > 0.3 * start.radius || !(0.75..1.33).contains(&(trial.disc.radius / start.radius)) {
            return None;
        }
    }
    Some(trial)
}

/// Edges in a ring of fixed width (mm) that may belong to a circle.
fn about(width_mm: f32) -> Within {
    Within { width_mm, width_px: 0.0, most_mm: width_mm, cosine: GATHERED_COSINE }
}

/// The edges that fine steps may meet: a few times as far from the circle as they look. `ring`: the width of theirs in mm.
#[expect(clippy::cast_possible_truncation, reason = "mm")]
fn close_to(buckets: &Buckets, trial: &Trial, ring: f32, largest_scale: f32) -> Near {
    let (width_mm, width_px) = (CLOSE * ring, CLOSE * RING_PX);
    let most_mm = width_mm.max(width_px * largest_scale).min(GATHERED * trial.disc.radius as f32);
    Near::gather(buckets, &trial.disc, &Within { width_mm, width_px, most_mm, cosine: GATHERED_COSINE })
}

/// Fits a circle again, from a start close to it.
pub(super) fn refit(buckets: &Buckets, start: &Arc, most_oval: f64) -> Option<Arc> {
    #[expect(clippy::cast_possible_truncation, reason = "mm")]
    let radius = start.disc.radius as f32;
    let near = Near::gather(buckets, &start.disc, &about(KEPT * radius));
    let mut trial = Trial { disc: start.disc, oval: start.oval, most_oval };
    for width in [0.02, 0.0, 0.0, 0.0] {
        trial = near.step(&trial, width)?;
    }
    Some(support(buckets, &trial))
}
