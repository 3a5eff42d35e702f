//! What speaks for a rectangle of the reduced picture.

use super::levels::Levels;
use super::support::Support;
use crate::evidence::{SquareEvidence, binomial_tail_log10};

/// Rectangles that a search tries, as a power of ten.
const TESTS_LOG10: f64 = 7.0;
/// Edges nearer to each other than this many scaled pixels are not independent.
const INDEPENDENT_PX: f64 = 6.0;

/// Sharpness, roughness and unlikeness before the full picture tells them: what is common.
const UNSEEN: (f64, f64, f64) = (0.72, 6.0, 0.1);

/// What speaks for a rectangle, before it is followed through the full picture.
pub(super) fn evidence(support: &Support, levels: &Levels) -> SquareEvidence {
    let coverage = support.coverage.iter().sum::<f64>() / 4.0;
    let trials = support.perimeter_px / INDEPENDENT_PX;
    SquareEvidence {
        coverage,
        least_side: support.coverage.into_iter().fold(1.0, f64::min),
        false_alarms_log10: TESTS_LOG10 + binomial_tail_log10(trials, coverage, support.chance),
        steady: support.steady,
        residual_px: support.residual_px,
        beyond: support.beyond,
        corners: f64::from(support.corners),
        below: levels.below,
        least_below: levels.least_below,
        level: levels.level,
        above: levels.above,
        clutter: levels.clutter,
        contrast: support.contrast,
        sharp: UNSEEN.0,
        rough_in: UNSEEN.1,
        rough_out: UNSEEN.1,
        unlike: UNSEEN.2,
    }
}
