//! The evidence for a circle, and the confidence that it is the rim of a container.

use crate::weights::{FEATURES, ROUND_CONFIDENCE};

/// The evidence for a circle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Evidence {
    /// Share of the rim that lies in the picture.
    pub visible: f64,
    /// Share of what lies in the picture that has an edge along it.
    pub coverage: f64,
    /// The same share of the half that lies further from the wearer, which a container's own wall never hides: a foot has none.
    pub far: f64,
    /// Share of the whole rim that its longest unbroken arc covers: what hides a rim leaves long arcs, chance short ones.
    pub longest: f64,
    /// Share of the edges that agree with their neighbours on the side where it is brighter.
    pub steady: f64,
    /// Common logarithm of the expected number of circles as good as this one in a picture of chance edges.
    pub false_alarms_log10: f64,
    /// Root mean square distance of the edges from the circle, in pixels of the reduced scale.
    pub residual_px: f64,
    /// Mean strength of the edges, in levels per pixel of the reduced scale.
    pub contrast: f64,
    /// Share of the change across the rim that happens within a pixel to either side, of that within three (of the reduced
    /// scale; median): shadows are soft. 1 until the rim has been followed through the full picture.
    pub sharp: f64,
}

impl Evidence {
    /// The rank of a circle while circles are searched, from 0 to 1: the higher comes first.
    pub(crate) fn rank(&self) -> f64 {
        let score = 12.0 * (self.coverage * self.visible.sqrt() - 0.58)
            + 0.12 * ((-self.false_alarms_log10).min(60.0) - 18.0)
            + 3.0 * (self.steady - 0.8)
            - 8.0 * (self.residual_px - 0.45).max(0.0)
            - 8.0 * (0.4 - self.far).max(0.0)
            - 10.0 * (0.2 - self.longest).max(0.0);
        1.0 / (1.0 + (-score).exp())
    }

    /// The features that the confidence is worked out from; their weights are in weights.toml. They have no unit but those named on
    /// the fields.
    #[must_use]
    pub fn features(&self) -> [f64; FEATURES] {
        [
            1.0,
            self.coverage * self.visible.sqrt(),
            (-self.false_alarms_log10).clamp(0.0, 60.0) / 10.0,
            self.steady,
            (self.residual_px - 0.45).max(0.0),
            (0.4 - self.far).max(0.0),
            (0.2 - self.longest).max(0.0),
            self.sharp.min(0.8),
            (self.contrast / 10.0).max(0.1).ln(),
            self.visible,
        ]
    }

    /// From 0 to 1: how often a circle with such evidence is the rim of a container.
    pub(crate) fn confidence(&self) -> f64 {
        let score: f64 = self.features().iter().zip(*ROUND_CONFIDENCE).map(|(feature, weight)| feature * weight).sum();
        1.0 / (1.0 + (-score).exp())
    }
}
