//! The support that the edges of a picture give to a rectangle.

use super::quad::{Quad, Side};
use crate::edges::GroundEdge;

/// The number of bins that a side is divided into.
pub(super) const BINS: usize = 24;
/// Those that say something of lines beside a side: without the quarter next to each corner.
const MIDDLE: u32 = ((1 << (BINS / 2)) - 1) << (BINS / 4);
/// Share of a bin's length that must be edges.
const BIN_SHARE: f64 = 0.4;
/// Edges along a side are within so many scaled pixels of it.
const ALONG_PX: f64 = 1.5;
/// Lines along a side are looked at so far into the rectangle, in mm.
const INSIDE_MM: i32 = 90;
/// A stretch outside of a side or beyond a corner, in two units since edges are as wide as pixels, and tables are not.
struct Stretch {
    /// Where it begins, in scaled pixels.
    from_px: f64,
    /// Where it ends, in mm on the plane Z = 0.
    to_mm: f64,
}

/// The table's own edges are counted in this stretch outside of a side.
const TABLE: Stretch = Stretch { from_px: 4.0, to_mm: 28.0 };
/// A side that goes on in this stretch beyond its corner is a line of the table.
const BEYOND: Stretch = Stretch { from_px: 5.0, to_mm: 32.0 };
/// A corner is seen if both sides have an edge in one of as many bins next to it.
const CORNER_BINS: usize = 5;

/// Lines along one side: for every millimetre into the rectangle, the share of its middle that has an edge there.
pub(super) struct Lines(Vec<f64>);

impl Lines {
    pub(super) fn beside(side: &Side, near: &[GroundEdge]) -> Self {
        let mut held = vec![0_u32; usize::try_from(INSIDE_MM + 1).unwrap_or(0)];
        let bin = side.length / f64::from(u8::try_from(BINS).unwrap_or(u8::MAX));
        for e in near {
            let Some((t, off, _)) = side.parallel(e).filter(|(t, ..)| (0.0..side.length).contains(t)) else { continue };
            let half = 0.5 * f64::from(e.length);
            let bits = bits(((t - half) / bin).max(0.0), (t + half) / bin);
            let across = ALONG_PX.min(1.0) * f64::from(e.scale);
            #[expect(clippy::cast_possible_truncation, reason = "mm")]
            let (low, high) = ((off - across).round() as i32, (off + across).round() as i32);
            for mm in low.max(-INSIDE_MM)..=high.min(0) {
                if let Some(held) = usize::try_from(-mm).ok().and_then(|at| held.get_mut(at)) {
                    *held |= bits;
                }
            }
        }
        let share = |bits: u32| f64::from((bits & MIDDLE).count_ones()) / f64::from(MIDDLE.count_ones());
        Self(held.into_iter().map(share).collect())
    }

    /// Share of the middle of the side that has an edge so far within it.
    pub(super) fn share(&self, inward_mm: f64) -> f64 {
        #[expect(clippy::cast_possible_truncation, reason = "mm")]
        let at = usize::try_from(inward_mm.round() as i32).ok();
        at.and_then(|at| self.0.get(at)).copied().unwrap_or(0.0)
    }
}

/// Bits of the bins from one place to another.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "bins")]
fn bits(from: f64, to: f64) -> u32 {
    let (first, last) = (from as u32, (to as u32).min(BINS as u32 - 1));
    (first..=last).fold(0, |bits, bin| bits | 1 << bin)
}

/// Support of a rectangle.
pub(super) struct Support {
    /// Share of each side that has edges along it.
    pub coverage: [f64; 4],
    /// Share of the edges that agree with their neighbours on the side where it is brighter.
    pub steady: f64,
    /// Root mean square distance of the edges from the sides, in scaled pixels.
    pub residual_px: f64,
    /// Mean strength of the edges, in levels per scaled pixel.
    pub contrast: f64,
    /// Chance that a place on a side has an edge along it that means nothing.
    pub chance: f64,
    /// Length of all sides in scaled pixels.
    pub perimeter_px: f64,
    /// Mean share of the sides' continuations beyond the corners that have an edge along them.
    pub beyond: f64,
    /// Corners of which both sides are seen.
    pub corners: u8,
}

/// Sums over one side.
#[derive(Default)]
struct Sums {
    bright_out: [f64; BINS],
    bright_in: [f64; BINS],
    squares: f64,
    contrast: f64,
    length: f64,
    scales: f64,
    table: f64,
    beyond: [f64; 2],
}

impl Support {
    pub(super) fn from_edges(quad: &Quad, near: &[GroundEdge]) -> Self {
        let sides = quad.sides();
        let sums = sides.map(|side| sums(&side, near));
        let total = |of: fn(&Sums) -> f64| sums.iter().map(of).sum::<f64>();
        let length = total(|s| s.length).max(1e-9);
        let scale = total(|s| s.scales) / length;
        let perimeter = sides.iter().map(|side| side.length).sum::<f64>();
        let bins: Vec<[i8; BINS]> = sides.iter().zip(&sums).map(|(side, sums)| sums.bins(side.length)).collect();
        let held = |k: usize| bins[k].iter().filter(|bin| **bin != 0).count();
        #[expect(clippy::cast_precision_loss, reason = "bins")]
        let coverage = [0, 1, 2, 3].map(|k| held(k) as f64 / BINS as f64);
        let ends = |k: usize| {
            let seen = |mut bins: std::slice::Iter<'_, i8>| bins.any(|bin| *bin != 0);
            seen(bins[k][..CORNER_BINS].iter()) && seen(bins[(k + 3) % 4][BINS - CORNER_BINS..].iter())
        };
        let corners = (0..4).filter(|k| ends(*k)).count();
        // Length of the table's parallel edges per area, times the width in which an edge counts.
        let around = (TABLE.to_mm - TABLE.from_px * scale).max(1.0) * perimeter;
        Self {
            coverage,
            steady: steady(&bins),
            residual_px: (total(|s| s.squares) / length).sqrt(),
            contrast: total(|s| s.contrast) / length,
            chance: (total(|s| s.table) / around * 2.0 * ALONG_PX * scale).min(1.0),
            perimeter_px: perimeter / scale.max(1e-9),
            beyond: sums.iter().flat_map(|s| s.beyond).map(|share| share.min(1.0)).sum::<f64>() / 8.0,
            corners: u8::try_from(corners).unwrap_or(4),
        }
    }
}

fn sums(side: &Side, near: &[GroundEdge]) -> Sums {
    let mut sums = Sums::default();
    for e in near {
        let Some((t, off, is_bright_out)) = side.parallel(e) else { continue };
        let (length, scale) = (f64::from(e.length), f64::from(e.scale));
        let is_beside = (0.0..side.length).contains(&t);
        if off.abs() > ALONG_PX * scale {
            if is_beside && (TABLE.from_px * scale..TABLE.to_mm).contains(&off) {
                sums.table += length;
            }
            continue;
        }
        if !is_beside {
            let out = if t < 0.0 { -t } else { t - side.length };
            let from = BEYOND.from_px * scale;
            if (from..BEYOND.to_mm).contains(&out) {
                sums.beyond[usize::from(t > 0.0)] += length / (BEYOND.to_mm - from);
            }
            continue;
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            clippy::cast_precision_loss,
            reason = "bins"
        )]
        let bin = ((t / side.length * BINS as f64) as usize).min(BINS - 1);
        (if is_bright_out { &mut sums.bright_out } else { &mut sums.bright_in })[bin] += length;
        sums.squares += length * (off / scale).powi(2);
        sums.contrast += length * f64::from(e.contrast);
        sums.scales += length * scale;
        sums.length += length;
    }
    sums
}

impl Sums {
    /// Per bin: 1 where brighter lies outside, -1 where inside, 0 where no edge is.
    #[expect(clippy::cast_precision_loss, reason = "bins")]
    fn bins(&self, side_length: f64) -> [i8; BINS] {
        let least = BIN_SHARE * side_length / BINS as f64;
        std::array::from_fn(|i| {
            let (out, inside) = (self.bright_out[i], self.bright_in[i]);
            if out.max(inside) < least {
                0
            } else if out > inside {
                1
            } else {
                -1
            }
        })
    }
}

#[expect(clippy::cast_precision_loss, reason = "bins")]
fn steady(bins: &[[i8; BINS]]) -> f64 {
    let pairs: Vec<bool> = bins
        .iter()
        .flat_map(|side| side.windows(2).filter(|pair| pair[0] != 0 && pair[1] != 0).map(|pair| pair[0] == pair[1]))
        .collect();
    pairs.iter().filter(|same| **same).count() as f64 / pairs.len().max(1) as f64
}
