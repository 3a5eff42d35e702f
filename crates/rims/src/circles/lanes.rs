//! Edges as columns of numbers, so that a processor works on four of them at once.

use std::ops::Range;

use wide::{CmpGe, CmpLt, f32x4};

use super::trial::{LEAST_COSINE, OTHER_COSINE, RING_PX, Trial};
use crate::edges::GroundEdge;

/// Edges of a block.
pub(super) const LANES: usize = 4;

/// The values of four edges that fits need.
#[derive(Clone, Copy)]
pub(super) struct Block {
    pub x: f32x4,
    pub y: f32x4,
    pub nx: f32x4,
    pub ny: f32x4,
    pub length: f32x4,
    pub scale: f32x4,
    /// Length over the third power of the scale: of an edge in a fit.
    pub weight: f32x4,
}

/// Edges in blocks, in order.
pub(crate) struct Lanes(Vec<Block>);

impl Lanes {
    pub(super) fn from_edges(edges: &[GroundEdge]) -> Self {
        let block = |some: &[GroundEdge]| {
            let four = |of: fn(&GroundEdge) -> f32, none: f32| {
                f32x4::from(std::array::from_fn(|lane| some.get(lane).map_or(none, of)))
            };
            Block {
                x: four(|e| e.x, 0.0),
                y: four(|e| e.y, 0.0),
                nx: four(|e| e.nx, 0.0),
                ny: four(|e| e.ny, 0.0),
                length: four(|e| e.length, 0.0),
                scale: four(|e| e.scale, 1.0),
                weight: four(|e| e.length / (e.scale * e.scale * e.scale), 0.0),
            }
        };
        Self(edges.chunks(LANES).map(block).collect())
    }

    /// The blocks that hold a range of edges: the number of the first edge of each, and a bit for each edge of the range.
    #[inline(always)]
    pub(super) fn blocks(&self, range: Range<usize>) -> impl Iterator<Item = (usize, &Block, i32)> {
        let blocks = range.start / LANES..range.end.div_ceil(LANES);
        self.0[blocks.clone()].iter().zip(blocks).map(move |(block, at)| {
            let first = at * LANES;
            let (before, until) = (range.start.saturating_sub(first), (range.end - first).min(LANES));
            (first, block, (1 << until) - (1 << before))
        })
    }
}

impl Block {
    /// No edges: they have neither length nor weight.
    pub(super) const NONE: Self = Self {
        x: f32x4::ZERO,
        y: f32x4::ZERO,
        nx: f32x4::ZERO,
        ny: f32x4::ZERO,
        length: f32x4::ZERO,
        scale: f32x4::ONE,
        weight: f32x4::ZERO,
    };

    /// Takes an edge of another block for one of this, its place relative to a centre.
    #[inline(always)]
    pub(super) fn set(&mut self, at: usize, from: &Self, lane: usize, center: [f32; 2]) {
        let copy = |to: &mut f32x4, from: &f32x4| to.as_array_mut()[at] = from.as_array_ref()[lane];
        self.x.as_array_mut()[at] = from.x.as_array_ref()[lane] - center[0];
        self.y.as_array_mut()[at] = from.y.as_array_ref()[lane] - center[1];
        copy(&mut self.nx, &from.nx);
        copy(&mut self.ny, &from.ny);
        copy(&mut self.length, &from.length);
        copy(&mut self.scale, &from.scale);
        copy(&mut self.weight, &from.weight);
    }
}

/// Calls `take` with the number of each bit that is set.
#[inline(always)]
pub(super) fn each(mut bits: i32, mut take: impl FnMut(usize)) {
    while bits != 0 {
        take(bits.trailing_zeros() as usize);
        bits &= bits - 1;
    }
}

/// A trial circle in single precision, four times.
pub(super) struct Circle {
    x: f32x4,
    y: f32x4,
    pub radius: f32x4,
    oval: [f32x4; 2],
}

/// Four edges relative to a circle.
pub(super) struct Relative {
    pub cos: f32x4,
    pub sin: f32x4,
    /// Cosines and sines of twice the angle.
    pub cos2: f32x4,
    pub sin2: f32x4,
    /// Distance outside the curve in mm.
    pub off: f32x4,
    /// Cosine between normal and radius: positive where brighter lies outside.
    pub cosine: f32x4,
}

impl Circle {
    /// `center`: places are relative to it.
    #[expect(clippy::cast_possible_truncation, reason = "mm")]
    pub(super) fn from_trial(trial: &Trial, center: [f32; 2]) -> Self {
        Self {
            x: f32x4::splat((trial.disc.x - f64::from(center[0])) as f32),
            y: f32x4::splat((trial.disc.y - f64::from(center[1])) as f32),
            radius: f32x4::splat(trial.disc.radius as f32),
            oval: trial.oval.map(|o| f32x4::splat(o as f32)),
        }
    }

    #[inline(always)]
    pub(super) fn relative(&self, block: &Block) -> Relative {
        let (dx, dy) = (block.x - self.x, block.y - self.y);
        let distance = (dx * dx + dy * dy + f32x4::splat(1e-12)).sqrt();
        let inverse = f32x4::ONE / distance;
        let (cos, sin) = (dx * inverse, dy * inverse);
        let (cos2, half_sin2) = (cos * cos - sin * sin, cos * sin);
        let sin2 = half_sin2 + half_sin2;
        let off = distance - self.radius - self.oval[0] * cos2 - self.oval[1] * sin2;
        Relative { cos, sin, cos2, sin2, off, cosine: cos * block.nx + sin * block.ny }
    }

    /// Half the width of the ring in which edges count. `width`: in radii.
    #[inline(always)]
    pub(super) fn ring(&self, block: &Block, width: f32) -> f32x4 {
        (self.radius * f32x4::splat(width)).fast_max(block.scale * f32x4::splat(RING_PX))
    }
}

impl Relative {
    /// Masks: whether they run along circles about the centre.
    #[inline(always)]
    pub(super) fn is_along(&self) -> f32x4 {
        self.cosine.abs().cmp_ge(f32x4::splat(LEAST_COSINE))
    }

    /// Masks: whether they run across them, so that they certainly belong to something else.
    #[inline(always)]
    pub(super) fn is_other(&self) -> f32x4 {
        self.cosine.abs().cmp_lt(f32x4::splat(OTHER_COSINE))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::circles::trial::Disc;

    fn edges() -> Vec<GroundEdge> {
        let edge = |i: u8| {
            let angle = 0.7 * f32::from(i);
            GroundEdge {
                x: 100.0 + 60.0 * angle.cos() + f32::from(i % 5),
                y: 300.0 + 60.0 * angle.sin(),
                nx: angle.cos(),
                ny: angle.sin(),
                length: 1.0,
                scale: 1.0,
                worst_scale: 1.0,
                contrast: 9.0,
            }
        };
        (0..23).map(edge).collect()
    }

    /// Whatever a range begins and ends with, each of its edges has one bit, and no other one has.
    #[test]
    fn blocks_hold_the_edges_of_a_range() {
        let lanes = Lanes::from_edges(&edges());
        for start in 0..23 {
            for end in start + 1..=23 {
                let mut found = Vec::new();
                for (first, _, bits) in lanes.blocks(start..end) {
                    each(bits, |lane| found.push(first + lane));
                }
                assert_eq!(found, (start..end).collect::<Vec<_>>());
            }
        }
    }

    #[test]
    fn four_edges_are_where_each_of_them_is() {
        let disc = Disc { x: 103.0, y: 298.0, radius: 57.0 };
        let trial = Trial { disc, oval: [1.5, -0.8], most_oval: 0.1 };
        let (edges, circle) = (edges(), Circle::from_trial(&trial, [0.0; 2]));
        let lanes = Lanes::from_edges(&edges);
        for (first, block, bits) in lanes.blocks(0..edges.len()) {
            let found = circle.relative(block);
            each(bits, |lane| {
                let e = &edges[first + lane];
                let (dx, dy) = (f64::from(e.x) - disc.x, f64::from(e.y) - disc.y);
                let angle = dy.atan2(dx);
                let off = dx.hypot(dy) - 57.0 - 1.5 * (2.0 * angle).cos() + 0.8 * (2.0 * angle).sin();
                let cosine = (dx * f64::from(e.nx) + dy * f64::from(e.ny)) / dx.hypot(dy);
                assert!((f64::from(found.off.to_array()[lane]) - off).abs() < 1e-3);
                assert!((f64::from(found.cosine.to_array()[lane]) - cosine).abs() < 1e-5);
            });
        }
    }
}
