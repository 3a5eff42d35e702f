//! What supports a circle: the edges along it, and what is around.

use wide::{CmpLe, CmpLt, f32x4};

use super::bins::{BINS, bin_length, bin_of};
use super::buckets::Buckets;
use super::lanes::{Circle, each};
use super::trial::{AROUND, Arc, RING_PX, Trial};

/// Edges along a circle by bins, and sums over them and over those around it.
struct Support {
    /// Lengths (mm) of those with brighter outside, and inside.
    bright_outside: [f32; BINS],
    bright_inside: [f32; BINS],
    /// Of length, and of length times squared distance (in scaled pixels) and times strength.
    length: f64,
    squares: f64,
    contrast: f64,
    /// Mean scale of all edges around, in mm per scaled pixel.
    scale: f64,
    /// Length of those that certainly belong to something else, in mm.
    other: f64,
}

impl Support {
    #[expect(clippy::cast_possible_truncation, reason = "mm")]
    fn of(buckets: &Buckets, trial: &Trial) -> Self {
        let (circle, edges) = (Circle::of(trial, [0.0; 2]), buckets.edges());
        let around = AROUND * trial.disc.radius as f32;
        let mut found = Self {
            bright_outside: [0.0; BINS],
            bright_inside: [0.0; BINS],
            length: 0.0,
            squares: 0.0,
            contrast: 0.0,
            scale: 0.0,
            other: 0.0,
        };
        let (mut scales, mut others, mut count) = (f32x4::ZERO, f32x4::ZERO, 0_u32);
        buckets.ranges_near(&trial.disc, around + trial.most_off(), |range| {
            for (first, block, some) in buckets.lanes().blocks(range) {
                let relative = circle.relative(block);
                let off = relative.off.abs();
                let is_around = off.cmp_lt(f32x4::splat(around)) & mask(some);
                scales += is_around & block.scale;
                others += is_around & relative.is_other() & block.length;
                count += is_around.move_mask().count_ones();
                let is_along = relative.is_along() & off.cmp_le(block.scale * f32x4::splat(RING_PX));
                each(is_along.move_mask() & some, |lane| {
                    let [cos, sin, cosine, off] =
                        [relative.cos, relative.sin, relative.cosine, off].map(|four| four.to_array()[lane]);
                    let e = &edges[first + lane];
                    let side = if cosine > 0.0 { &mut found.bright_outside } else { &mut found.bright_inside };
                    side[bin_of(cos, sin)] += e.length;
                    let length = f64::from(e.length);
                    found.length += length;
                    found.squares += length * f64::from(off / e.scale).powi(2);
                    found.contrast += length * f64::from(e.contrast);
                });
            }
        });
        found.scale = f64::from(scales.reduce_add()) / f64::from(count.max(1));
        found.other = f64::from(others.reduce_add());
        found
    }
}

/// Four masks, of as many bits.
#[inline(always)]
fn mask(bits: i32) -> f32x4 {
    if bits == 15 {
        return f32x4::ZERO.cmp_le(f32x4::ZERO);
    }
    let is_set = |lane: i32| if bits >> lane & 1 == 1 { -1.0 } else { 1.0 };
    f32x4::from([is_set(0), is_set(1), is_set(2), is_set(3)]).cmp_lt(f32x4::ZERO)
}

/// The edges along a circle.
#[expect(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "bins")]
pub(super) fn support(buckets: &Buckets, trial: &Trial) -> Arc {
    let found = Support::of(buckets, trial);
    let disc = trial.disc;
    let least = bin_length(disc.radius as f32);
    let bins: [i8; BINS] = std::array::from_fn(|bin| {
        let (outside, inside) = (found.bright_outside[bin], found.bright_inside[bin]);
        match outside.max(inside) >= least {
            true if outside > inside => 1,
            true => -1,
            false => 0,
        }
    });
    let covered = bins.iter().filter(|bin| **bin != 0).count();
    let ring_area = std::f64::consts::TAU * disc.radius * 2.0 * f64::from(AROUND) * disc.radius;
    // Other edges fill directions from 40 to 90 degrees off, those that would be taken for the rim's 0 to 18 degrees.
    let alike = found.other / ring_area * (18.0 / 50.0);
    Arc {
        disc,
        oval: trial.oval,
        bins,
        coverage: covered as f64 / BINS as f64,
        residual_px: (found.squares / found.length.max(1e-9)).sqrt(),
        contrast: found.contrast / found.length.max(1e-9),
        chance: (alike * 2.0 * f64::from(RING_PX) * found.scale).min(1.0),
        perimeter_px: std::f64::consts::TAU * disc.radius / found.scale.max(1e-9),
    }
}
