//! Steps of a fit, many edges at a time.
//!
//! Edges lie in blocks, number by number, so that a processor takes several at once. Places are relative to a centre nearby:
//! single precision then holds a table to a ten-thousandth of a millimetre.

use nalgebra::{SMatrix, SVector};

use super::arcs::{LEAST_COSINE, RING_PX, Trial};
use super::ground::GroundEdge;

/// Edges of a block.
const LANES: usize = 4;

/// What a fit needs of [`GroundEdge`]s.
#[derive(Default)]
struct Block {
    x: [f32; LANES],
    y: [f32; LANES],
    nx: [f32; LANES],
    ny: [f32; LANES],
    length: [f32; LANES],
    scale: [f32; LANES],
}

/// Edges near a circle.
pub(super) struct Near {
    center: [f64; 2],
    blocks: Vec<Block>,
    /// Edges in the last block; those behind them have no length.
    last: usize,
}

/// An edge relative to a trial circle.
struct Relative {
    cos: f32,
    sin: f32,
    /// Cosines and sines of twice the angle.
    cos2: f32,
    sin2: f32,
    /// Distance outside the curve in mm.
    off: f32,
    /// Whether it runs along circles about the centre.
    is_along: bool,
}

/// A trial in single precision.
#[derive(Clone, Copy)]
struct Circle {
    x: f32,
    y: f32,
    radius: f32,
    oval: [f32; 2],
}

impl Circle {
    #[inline(always)]
    fn relative(&self, block: &Block, lane: usize) -> Relative {
        let (dx, dy) = (block.x[lane] - self.x, block.y[lane] - self.y);
        let squared = dx * dx + dy * dy + 1e-12;
        let distance = squared.sqrt();
        let inverse = 1.0 / distance;
        let (cos, sin) = (dx * inverse, dy * inverse);
        let (cos2, sin2) = (cos * cos - sin * sin, 2.0 * cos * sin);
        let off = distance - self.radius - self.oval[0] * cos2 - self.oval[1] * sin2;
        let is_along = (cos * block.nx[lane] + sin * block.ny[lane]).abs() >= LEAST_COSINE;
        Relative { cos, sin, cos2, sin2, off, is_along }
    }

    /// What a block adds to the sums of [`Moments`].
    #[inline(always)]
    fn terms<const H: usize>(&self, block: &Block, width: f32) -> [[f32; LANES]; 14] {
        let mut terms = [[0.0; LANES]; 14];
        for lane in 0..LANES {
            let Relative { cos, sin, cos2, sin2, off, is_along } = self.relative(block, lane);
            let scale = block.scale[lane];
            let ring = larger(width * self.radius, RING_PX * scale);
            let away = off / ring;
            let inside = larger(1.0 - away * away, 0.0);
            // Tukey's weight. An edge stands for its length; its place is uncertain by pixels.
            let full = inside * inside * block.length[lane] / (scale * scale * scale);
            let weight = if is_along { full } else { 0.0 };
            let weighted = weight * off;
            let mut set = |moment: usize, value: f32| terms[moment][lane] = value;
            set(0, weight);
            set(1, weight * cos);
            set(2, weight * sin);
            set(3, weight * cos2);
            set(4, weight * sin2);
            set(5, weighted);
            set(6, weighted * cos);
            set(7, weighted * sin);
            if H > 2 {
                set(8, weighted * cos2);
                set(9, weighted * sin2);
                set(10, weight * (cos * cos2 - sin * sin2));
                set(11, weight * (sin * cos2 + cos * sin2));
                set(12, weight * (cos2 * cos2 - sin2 * sin2));
                set(13, weight * (2.0 * cos2 * sin2));
            }
        }
        terms
    }
}

/// The larger of two numbers, neither of which is NaN.
#[inline(always)]
fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

impl Near {
    /// None yet, about a centre in mm.
    pub(super) fn new(center: [f64; 2]) -> Self {
        Self { center, blocks: Vec::new(), last: LANES }
    }

    #[expect(clippy::cast_possible_truncation, reason = "mm")]
    pub(super) fn push(&mut self, e: &GroundEdge) {
        if self.last == LANES {
            self.blocks.push(Block { scale: [1.0; LANES], ..Block::default() });
            self.last = 0;
        }
        if let Some(block) = self.blocks.last_mut() {
            let at = self.last;
            block.x[at] = e.x - self.center[0] as f32;
            block.y[at] = e.y - self.center[1] as f32;
            (block.nx[at], block.ny[at]) = (e.nx, e.ny);
            (block.length[at], block.scale[at]) = (e.length, e.scale);
            self.last += 1;
        }
    }

    #[expect(clippy::cast_possible_truncation, reason = "mm")]
    fn circle(&self, trial: &Trial) -> Circle {
        Circle {
            x: (trial.disc.x - self.center[0]) as f32,
            y: (trial.disc.y - self.center[1]) as f32,
            radius: trial.disc.radius as f32,
            oval: trial.oval.map(|o| o as f32),
        }
    }

    /// Those within so many radii of a curve, and what shares their blocks.
    pub(super) fn kept(self, trial: &Trial, width: f32) -> Self {
        let circle = self.circle(trial);
        let is_near = |block: &Block| {
            (0..LANES).any(|lane| {
                let found = circle.relative(block, lane);
                found.off.abs() < larger(width * circle.radius, 2.0 * RING_PX * block.scale[lane])
            })
        };
        let blocks = self.blocks.into_iter().filter(is_near).collect();
        Self { blocks, last: LANES, ..self }
    }

    /// Length of the edges along a circle, relative to it. `width`: of the ring in which edges count, in radii.
    pub(super) fn share(&self, trial: &Trial, width: f32) -> f32 {
        let circle = self.circle(trial);
        let mut sums = [0.0_f32; LANES];
        for block in &self.blocks {
            for lane in 0..LANES {
                let found = circle.relative(block, lane);
                let ring = larger(width * circle.radius, RING_PX * block.scale[lane]);
                let counts = found.is_along & (found.off.abs() <= ring);
                sums[lane] += if counts { block.length[lane] } else { 0.0 };
            }
        }
        sums.iter().sum::<f32>() / (std::f32::consts::TAU * circle.radius)
    }

    /// One Gauss-Newton step with Tukey's weights, of centre and radius and, where the circle may look oval, of that.
    pub(super) fn step(&self, trial: &Trial, width: f32) -> Option<Trial> {
        if trial.most_oval > 0.0 {
            let (mut normal, mut right) = self.moments::<4>(trial, width).oval();
            let sigma = 0.5 * trial.most_oval * trial.disc.radius;
            for i in 3..5 {
                normal[(i, i)] += 1.0 / (sigma * sigma);
                right[i] -= trial.oval[i - 3] / (sigma * sigma);
            }
            let change = normal.cholesky()?.solve(&right);
            trial.moved([change[0], change[1], change[2]], [change[3], change[4]])
        } else {
            let (normal, right) = self.moments::<2>(trial, width).round();
            let change = normal.cholesky()?.solve(&right);
            trial.moved([change[0], change[1], change[2]], [0.0; 2])
        }
    }

    /// Sums over the edges in the ring, with harmonics of the angle up to order H.
    fn moments<const H: usize>(&self, trial: &Trial, width: f32) -> Moments {
        let circle = self.circle(trial);
        let mut sums = [[0.0_f32; LANES]; 14];
        for block in &self.blocks {
            let terms = circle.terms::<H>(block, width);
            // Term by term: compilers then see additions side by side.
            for (sum, term) in sums.iter_mut().zip(&terms) {
                for lane in 0..LANES {
                    sum[lane] += term[lane];
                }
            }
        }
        let [w, c1, s1, c2, s2, r, rc1, rs1, rc2, rs2, c3, s3, c4, s4] =
            sums.map(|lanes| lanes.iter().map(|sum| f64::from(*sum)).sum::<f64>());
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
