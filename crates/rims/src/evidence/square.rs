//! What speaks for a rectangle, and how sure it is by that that it is the rim of a plate.

use super::round::Evidence;

/// Numbers that the confidence is worked out from.
pub const SQUARE_FEATURES: usize = 15;
/// Weights of [`SquareEvidence::features`] in the logarithm of the odds that a rectangle is a rim: a logistic regression on
/// rendered tables (docs/rims.md has the command).
const CONFIDENCE: [f64; SQUARE_FEATURES] =
    [-4.86, 3.09, -2.29, -3.44, -9.14, 1.24, 6.85, 1.01, 2.96, -19.67, -2.74, 0.75, -3.05, 1.12, 1.89];

/// What speaks for a rectangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SquareEvidence {
    /// Share of all sides that has an edge along it.
    pub coverage: f64,
    /// The same of the side that shows least.
    pub least_side: f64,
    /// Common logarithm of the expected number of rectangles as good as this one in a picture of chance edges.
    pub false_alarms_log10: f64,
    /// Share of the edges that agree with their neighbours on the side where it is brighter.
    pub steady: f64,
    /// Root mean square distance of the edges from the sides, in pixels of the reduced scale.
    pub residual_px: f64,
    /// Share of the sides' continuations beyond the corners that have an edge along them: lines of a table go on.
    pub beyond: f64,
    /// Corners of which both sides are seen.
    pub corners: f64,
    /// Share of the sides that have a line within and below them, as a well is.
    pub below: f64,
    /// The same of the side that shows least of it.
    pub least_below: f64,
    /// The same on their own level, as a printed border is.
    pub level: f64,
    /// The same above them, as a plate on a mat is.
    pub above: f64,
    /// Share of the sides that have a line, over all places within: cloth has many, and a plate few.
    pub clutter: f64,
    /// Mean strength of the edges, in levels per pixel of the reduced scale.
    pub contrast: f64,
    /// Share of the change across the sides that happens within a pixel to either side, of that within three (of the reduced
    /// scale; median): shadows are soft. 1 until the sides have been followed through the full picture.
    pub sharp: f64,
    /// How much the colour changes from place to place just within a side, in levels: of the sides the most.
    pub rough_in: f64,
    /// The same just out of the sides: their mean.
    pub rough_out: f64,
    /// How far what lies within a side is from a shadow of what lies out of it, of the sides the least.
    pub unlike: f64,
}

impl SquareEvidence {
    /// What it has in common with what speaks for a circle.
    pub(crate) fn as_of_a_rim(&self) -> Evidence {
        Evidence {
            visible: 1.0,
            coverage: self.coverage,
            far: 1.0,
            longest: 0.25 * self.least_side,
            steady: self.steady,
            false_alarms_log10: self.false_alarms_log10,
            residual_px: self.residual_px,
            contrast: self.contrast,
            sharp: self.sharp,
        }
    }

    /// What the confidence is worked out from; see [`CONFIDENCE`].
    #[must_use]
    pub fn features(&self) -> [f64; SQUARE_FEATURES] {
        [
            1.0,
            self.coverage,
            self.least_side,
            self.steady,
            self.beyond,
            self.corners,
            self.below,
            self.least_below,
            self.below - self.level.max(self.above),
            self.clutter,
            self.sharp.min(0.8),
            (self.contrast / 10.0).max(0.1).ln(),
            (1.0 + self.rough_in).ln(),
            (1.0 + self.rough_out).ln(),
            (self.unlike / 0.1).min(2.0),
        ]
    }

    /// From 0 to 1: how often a rectangle with such evidence is the rim of a plate.
    pub(crate) fn confidence(&self) -> f64 {
        let score: f64 = self.features().iter().zip(CONFIDENCE).map(|(feature, weight)| feature * weight).sum();
        1.0 / (1.0 + (-score).exp())
    }
}
