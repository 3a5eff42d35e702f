//! How sure it is that a circle is a rim.

use model::View;
use nalgebra::Point3;

use super::arcs::{Arc, BINS};

/// Circles that a search tries, as a power of ten: cells of all layers.
const TESTS_LOG10: f64 = 6.0;
/// Edges nearer to each other than this many scaled pixels are not independent.
const INDEPENDENT_PX: f64 = 6.0;

/// A circle nearer to the point under the camera than this multiple of the camera's height is seen from steeply above.
const STEEP: f64 = 0.3;

/// Numbers that the confidence is worked out from.
pub const FEATURES: usize = 10;
/// Weights of [`Evidence::features`] in the logarithm of the odds that a circle is a rim: a logistic regression on rendered
/// tables (docs/rims.md has the command).
const CONFIDENCE: [f64; FEATURES] = [-14.53, 4.02, 1.07, 2.57, -5.88, -7.99, -9.41, 6.82, 1.31, 0.93];

/// What speaks for a circle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Evidence {
    /// Share of the rim that lies in the picture.
    pub visible: f64,
    /// Share of what lies in the picture that has an edge along it.
    pub coverage: f64,
    /// The same for the half that lies further from the wearer, which a container's own wall never hides: a foot has none.
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
    #[expect(clippy::cast_precision_loss, reason = "bins")]
    pub(super) fn of(view: &View, arc: &Arc) -> Self {
        let visible: Vec<bool> = (0..BINS).map(|bin| is_visible(view, arc, bin)).collect();
        let seen = visible.iter().filter(|v| **v).count();
        let held = (0..BINS).filter(|i| visible[*i] && arc.bins[*i] != 0).count();
        let pairs: Vec<bool> = (0..BINS)
            .filter(|i| arc.bins[*i] != 0 && arc.bins[(*i + 1) % BINS] != 0)
            .map(|i| arc.bins[i] == arc.bins[(i + 1) % BINS])
            .collect();
        let steady = pairs.iter().filter(|same| **same).count() as f64 / pairs.len().max(1) as f64;
        let away = arc.disc.y.atan2(arc.disc.x);
        let is_far = |i: usize| ((i as f64 + 0.5) / BINS as f64 * std::f64::consts::TAU - away).cos() > 0.3;
        let far = (0..BINS).filter(|i| visible[*i] && is_far(*i));
        let (far_seen, far_held) = far.fold((0_u32, 0_u32), |(n, held), i| (n + 1, held + u32::from(arc.bins[i] != 0)));
        // Looked at from steeply above, a wall hides nothing.
        let steep = arc.disc.x.hypot(arc.disc.y) < STEEP * view.pose().camera_height_mm();
        let share = seen as f64 / BINS as f64;
        let coverage = held as f64 / seen.max(1) as f64;
        let trials = (arc.perimeter_px * share / INDEPENDENT_PX).min(seen as f64);
        Self {
            visible: share,
            coverage,
            far: if far_seen > 0 && !steep { f64::from(far_held) / f64::from(far_seen) } else { 1.0 },
            longest: longest_run(&arc.bins) as f64 / BINS as f64,
            steady,
            false_alarms_log10: TESTS_LOG10 + binomial_tail_log10(trials, coverage, arc.chance),
            residual_px: arc.residual_px,
            contrast: arc.contrast,
            sharp: 1.0,
        }
    }

    /// From 0 to 1: what orders circles while they are searched.
    pub(super) fn rank(&self) -> f64 {
        let score = 12.0 * (self.coverage * self.visible.sqrt() - 0.58)
            + 0.12 * ((-self.false_alarms_log10).min(60.0) - 18.0)
            + 3.0 * (self.steady - 0.8)
            - 8.0 * (self.residual_px - 0.45).max(0.0)
            - 8.0 * (0.4 - self.far).max(0.0)
            - 10.0 * (0.2 - self.longest).max(0.0);
        1.0 / (1.0 + (-score).exp())
    }

    /// What the confidence is worked out from; see [`CONFIDENCE`].
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
    pub(super) fn confidence(&self) -> f64 {
        let score: f64 = self.features().iter().zip(CONFIDENCE).map(|(feature, weight)| feature * weight).sum();
        1.0 / (1.0 + (-score).exp())
    }
}

/// Whether the picture shows this part of a rim.
#[expect(clippy::cast_precision_loss, reason = "bins")]
fn is_visible(view: &View, arc: &Arc, bin: usize) -> bool {
    let angle = (bin as f64 + 0.5) / BINS as f64 * std::f64::consts::TAU;
    let [x, y] = arc.at(angle);
    let [width, height] = view.camera().size_px().map(f64::from);
    view.pixel_of(Point3::new(x, y, 0.0)).is_ok_and(|p| {
        (0.005 * width..0.995 * width).contains(&p.x) && (0.005 * width..height - 0.005 * width).contains(&p.y)
    })
}

/// Bins of the longest arc, over gaps of one bin.
fn longest_run(bins: &[i8; BINS]) -> usize {
    let (mut longest, mut run, mut gap) = (0, 0, 0);
    for i in 0..2 * BINS {
        if bins[i % BINS] != 0 {
            run += 1 + gap;
            gap = 0;
        } else if gap == 0 && run > 0 {
            gap = 1;
        } else {
            (run, gap) = (0, 0);
        }
        longest = longest.max(run);
    }
    longest.min(BINS)
}

/// Upper bound of log10 P(at least `share` of `trials` succeed by chance `p` each), by Hoeffding (1963, Theorem 1).
pub(super) fn binomial_tail_log10(trials: f64, share: f64, p: f64) -> f64 {
    let p = p.clamp(1e-3, 1.0);
    if share <= p {
        return 0.0;
    }
    let part = |share: f64, p: f64| if share > 0.0 { share * (share / p).log10() } else { 0.0 };
    -trials * (part(share, p) + part(1.0 - share, 1.0 - p))
}
