//! The evidence for a rectangle in the reduced picture.

use super::levels::Levels;
use super::support::Support;
use crate::evidence::{SquareEvidence, binomial_tail_log10};

/// Rectangles that a search tries, as a power of ten.
const TESTS_LOG10: f64 = 7.0;
/// Edges nearer to each other than this many scaled pixels are not independent.
const INDEPENDENT_PX: f64 = 6.0;

/// The sharpness of a side that is common, until the full picture shows its own.
const COMMON_SHARPNESS: f64 = 0.72;
/// The roughness on either side that is common, in levels, likewise.
const COMMON_ROUGHNESS: f64 = 6.0;
/// The distance from a shadow that is common, likewise.
const COMMON_UNLIKENESS: f64 = 0.1;

/// The evidence for a rectangle, before it is followed through the full picture.
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
        sharp: COMMON_SHARPNESS,
        rough_in: COMMON_ROUGHNESS,
        rough_out: COMMON_ROUGHNESS,
        unlike: COMMON_UNLIKENESS,
    }
}
