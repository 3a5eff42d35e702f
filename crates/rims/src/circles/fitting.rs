//! Steps of a fit, four edges at a time.
//!
//! Places are relative to a centre nearby: single precision then holds a table to a ten-thousandth of a millimetre.

use nalgebra::{SMatrix, SVector};
use wide::{CmpGe, CmpLe, CmpLt, f32x4};

use super::bins::{BINS, bin_length, bin_of};
use super::buckets::Buckets;
use super::lanes::{Block, Circle, LANES, Relative, each};
use super::trial::{Disc, Trial};

/// Blocks that there is room for at first.
const ROOM: usize = 256;

/// The edges about a circle that a fit may meet.
pub(super) struct Within {
    /// The distance from the circle up to which edges count, in mm; or [`Self::width_px`] where that is more.
    pub width_mm: f32,
    /// The same distance in scaled pixels.
    pub width_px: f32,
    /// No edge counts beyond this distance, in mm.
    pub most_mm: f32,
    /// The least cosine between the normal of an edge and the radius.
    pub cosine: f32,
}

/// Edges near a circle.
pub(super) struct Near {
    center: [f32; 2],
    blocks: Vec<Block>,
    /// Edges in the last block.
    last: usize,
}

impl Near {
    /// The edges about a circle that a fit may meet.
    #[expect(clippy::cast_possible_truncation, reason = "mm")]
    pub(super) fn gather(edges: &Buckets, disc: &Disc, within: &Within) -> Self {
        let center = [disc.x as f32, disc.y as f32];
        let mut near = Self { center, blocks: Vec::with_capacity(ROOM), last: LANES };
        let [x, y, radius] = [center[0], center[1], disc.radius as f32].map(f32x4::splat);
        let squared_cosine = f32x4::splat(within.cosine * within.cosine);
        let [width_mm, width_px, most_mm] = [within.width_mm, within.width_px, within.most_mm].map(f32x4::splat);
        edges.ranges_near(disc, within.most_mm, |range| {
            for (_, block, some) in edges.lanes().blocks(range) {
                let (dx, dy) = (block.x - x, block.y - y);
                let squared = dx * dx + dy * dy;
                let dot = dx * block.nx + dy * block.ny;
                let reach = width_mm.fast_max(block.scale * width_px).fast_min(most_mm);
                let is_in = (squared.sqrt() - radius).abs().cmp_le(reach);
                let is_along = (dot * dot).cmp_ge(squared_cosine * squared);
                each((is_in & is_along).move_mask() & some, |lane| near.push(block, lane));
            }
        });
        near
    }

    #[inline(always)]
    fn push(&mut self, from: &Block, lane: usize) {
        if self.last == LANES {
            self.blocks.push(Block::NONE);
            self.last = 0;
        }
        if let Some(block) = self.blocks.last_mut() {
            block.set(self.last, from, lane, self.center);
            self.last += 1;
        }
    }

    fn circle(&self, trial: &Trial) -> Circle {
        Circle::from_trial(trial, self.center)
    }

    /// Leaves out what is further than so many rings from a curve, but for what shares blocks with others. `width`: of the
    /// ring, in radii.
    pub(super) fn keep(&mut self, trial: &Trial, width: f32, rings: f32) {
        let circle = self.circle(trial);
        self.blocks.retain(|block| {
            let reach = circle.ring(block, width) * f32x4::splat(rings);
            circle.relative(block).off.abs().cmp_lt(reach).any()
        });
    }

    /// The largest scale of them all (mm per scaled pixel).
    pub(super) fn largest_scale(&self) -> f32 {
        self.blocks.iter().flat_map(|block| block.scale.to_array()).fold(0.0, f32::max)
    }

    /// Length of the edges along a circle, relative to it. `width`: of the ring in which edges count, in radii.
    pub(super) fn share(&self, trial: &Trial, width: f32) -> f32 {
        let circle = self.circle(trial);
        let mut sum = f32x4::ZERO;
        for block in &self.blocks {
            let found = circle.relative(block);
            let counts = found.is_along() & found.off.abs().cmp_le(circle.ring(block, width));
            sum += counts & block.length;
        }
        sum.reduce_add() / (std::f32::consts::TAU * circle.radius.to_array()[0])
    }

    /// Share of the bins of a circle that have edges enough along it. `width`: of the ring in which edges count, in radii.
    #[expect(clippy::cast_precision_loss, reason = "bins")]
    pub(super) fn coverage(&self, trial: &Trial, width: f32) -> f64 {
        let circle = self.circle(trial);
        let mut lengths = [0.0_f32; BINS];
        for block in &self.blocks {
            let found = circle.relative(block);
            let counts = found.is_along() & found.off.abs().cmp_le(circle.ring(block, width));
            each(counts.move_mask(), |lane| {
                let bin = bin_of(found.cos.as_array_ref()[lane], found.sin.as_array_ref()[lane]);
                lengths[bin] += block.length.as_array_ref()[lane];
            });
        }
        let least = bin_length(circle.radius.to_array()[0]);
        lengths.iter().filter(|length| **length >= least).count() as f64 / BINS as f64
    }

    /// One Gauss-Newton step with Tukey's weights, of centre and radius and, where the circle may look oval, of that.
    pub(super) fn step(&self, trial: &Trial, width: f32) -> Option<Trial> {
        if trial.most_oval > 0.0 {
            let (mut normal, mut right) = self.moments::<true>(trial, width).oval();
            let sigma = 0.5 * trial.most_oval * trial.disc.radius;
            for i in 3..5 {
                normal[(i, i)] += 1.0 / (sigma * sigma);
                right[i] -= trial.oval[i - 3] / (sigma * sigma);
            }
            let change = normal.cholesky()?.solve(&right);
            trial.moved([change[0], change[1], change[2]], [change[3], change[4]])
        } else {
            let (normal, right) = self.moments::<false>(trial, width).round();
            let change = normal.cholesky()?.solve(&right);
            trial.moved([change[0], change[1], change[2]], [0.0; 2])
        }
    }

    /// Sums over the edges in the ring; those that only the oval asks for if it does.
    fn moments<const OVAL: bool>(&self, trial: &Trial, width: f32) -> Moments {
        let circle = self.circle(trial);
        let mut sums = [f32x4::ZERO; 14];
        for block in &self.blocks {
            let found = circle.relative(block);
            let Relative { cos, sin, cos2, sin2, off, .. } = found;
            let away = off / circle.ring(block, width);
            let inside = (f32x4::ONE - away * away).fast_max(f32x4::ZERO);
            // Tukey's weight. An edge stands for its length; its place is uncertain by pixels.
            let weight = found.is_along() & (inside * inside * block.weight);
            let weighted = weight * off;
            let terms = [weight, weight * cos, weight * sin, weight * cos2, weight * sin2];
            let right = [weighted, weighted * cos, weighted * sin];
            for (sum, term) in sums.iter_mut().zip(terms.into_iter().chain(right)) {
                *sum += term;
            }
            if OVAL {
                let (wc2, ws2) = (terms[3], terms[4]);
                let fourth = [wc2 * cos2 - ws2 * sin2, wc2 * sin2 + ws2 * cos2];
                let third = [wc2 * cos - ws2 * sin, wc2 * sin + ws2 * cos];
                let right = [weighted * cos2, weighted * sin2];
                for (sum, term) in sums[8..].iter_mut().zip(right.into_iter().chain(third).chain(fourth)) {
                    *sum += term;
                }
            }
        }
        let [w, c1, s1, c2, s2, r, rc1, rs1, rc2, rs2, c3, s3, c4, s4] = sums.map(|sum| f64::from(sum.reduce_add()));
        Moments { w, cos: [c1, c2, c3, c4], sin: [s1, s2, s3, s4], right: [rc1, rs1, r, rc2, rs2] }
    }
}

/// Sums of weights, of weights times cosines and sines of one to four times the angle, and of weighted distances times the
/// derivatives (cos, sin, 1, cos of twice the angle, sin of that). The normal equations follow from them, since products of
/// sines and cosines are sums of others.
struct Moments {
    w: f64,
    cos: [f64; 4],
    sin: [f64; 4],
    right: [f64; 5],
}

impl Moments {
    /// Of centre and radius.
    fn round(&self) -> (SMatrix<f64, 3, 3>, SVector<f64, 3>) {
        let Self { w, cos: [c1, c2, ..], sin: [s1, s2, ..], right } = *self;
        let mut normal = 0.5
            * SMatrix::<f64, 3, 3>::new(
                w + c2,
                s2,
                2.0 * c1, //
                s2,
                w - c2,
                2.0 * s1, //
                2.0 * c1,
                2.0 * s1,
                2.0 * w,
            );
        damp(&mut normal);
        (normal, SVector::from([right[0], right[1], right[2]]))
    }

    /// Of centre, radius, and how far from round it is.
    fn oval(&self) -> (SMatrix<f64, 5, 5>, SVector<f64, 5>) {
        let Self { w, cos: [c1, c2, c3, c4], sin: [s1, s2, s3, s4], right } = *self;
        #[rustfmt::skip]
        let mut normal = 0.5 * SMatrix::<f64, 5, 5>::from_row_slice(&[
            w + c2, s2, 2.0 * c1, c1 + c3, s3 + s1,
            s2, w - c2, 2.0 * s1, s3 - s1, c1 - c3,
            2.0 * c1, 2.0 * s1, 2.0 * w, 2.0 * c2, 2.0 * s2,
            c1 + c3, s3 - s1, 2.0 * c2, w + c4, s4,
            s3 + s1, c1 - c3, 2.0 * s2, s4, w - c4,
        ]);
        damp(&mut normal);
        (normal, SVector::from(right))
    }
}

/// Too short an arc does not fix a circle: keep it still rather than let it run.
fn damp<const N: usize>(normal: &mut SMatrix<f64, N, N>) {
    let damping = 1e-3 * normal[(2, 2)];
    for i in 0..3 {
        normal[(i, i)] += damping;
    }
}
