//! The evidence for a circle: how much of it is seen, and how unlikely that is by chance.

use model::View;
use nalgebra::Point3;

use super::bins::BINS;
use super::trial::Arc;
use crate::evidence::{Evidence, binomial_tail_log10};

/// The common logarithm of the number of circles that a search tries: the cells of all layers.
const TESTS_LOG10: f64 = 6.0;
/// Edges nearer to each other than this many scaled pixels are not independent.
const INDEPENDENT_PX: f64 = 6.0;

/// A circle nearer to the point under the camera than this multiple of the camera's height is seen from steeply above.
const STEEP: f64 = 0.3;

/// The evidence for a circle, before it is followed through the full picture.
#[expect(clippy::cast_precision_loss, reason = "bins")]
pub(super) fn evidence(view: &View, arc: &Arc) -> Evidence {
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
    Evidence {
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

/// Whether the picture shows this part of a rim.
#[expect(clippy::cast_precision_loss, reason = "bins")]
fn is_visible(view: &View, arc: &Arc, bin: usize) -> bool {
    let angle = (bin as f64 + 0.5) / BINS as f64 * std::f64::consts::TAU;
    let [x, y] = arc.place_at(angle);
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
