//! Voting for circles: every piece of a chain names the centres, on both sides of it, of all circles that it may be part of.

use wide::{CmpLe, f32x4};

use super::trial::Disc;
use crate::edges::GroundEdge;

/// The number of circles that are voted for.
pub(super) struct Likely {
    /// One for each group of neighbours, by its place among all.
    pub peaks: Vec<usize>,
    /// All of them.
    pub all: Vec<Disc>,
}

/// Ratio of the radii of two layers.
const LAYER_RATIO: f32 = 1.1;
/// Side of a cell, in radii: a normal that is wrong by three degrees stays within one.
const CELL: f32 = 0.1;
/// Peaks in layers nearer than this may be one.
const NEIGHBOUR_RATIO: f64 = 1.12;
/// A circle has at least this many scaled pixels from its centre to its rim, in the direction where it has fewest.
const LEAST_RADIUS_PX: f32 = 5.0;
/// Peaks kept per layer, and of all layers.
const PEAKS: usize = 20;
const MOST: usize = 160;
/// A peak is at least this share of a circle; chance included.
const LEAST_SHARE: f32 = 0.2;
/// Cells of a row that are looked at together.
const GROUP: usize = 32;
/// Cells of a layer; a layer that would have more is not searched.
const MOST_CELLS: usize = 1 << 21;

/// Likely circles with radii between the limits (mm on the plane Z = 0).
pub(super) fn likely_discs(edges: &[GroundEdge], [smallest, largest]: [f64; 2]) -> Likely {
    let mut found = Vec::new();
    let voters = Voters::from_edges(edges);
    #[expect(clippy::cast_possible_truncation, reason = "mm")]
    let (mut radius, largest) = (smallest as f32, largest as f32);
    while radius <= largest {
        if let Some(layer) = Layer::from_votes(&voters, radius) {
            found.extend(layer.peaks());
        }
        radius *= LAYER_RATIO;
    }
    found.sort_by(|a, b| b.1.total_cmp(&a.1));
    let all: Vec<Disc> = found.into_iter().map(|(disc, _)| disc).collect();
    let mut peaks: Vec<usize> = Vec::new();
    for (i, disc) in all.iter().enumerate() {
        if peaks.len() < MOST && !peaks.iter().any(|other| are_neighbours(disc, &all[*other])) {
            peaks.push(i);
        }
    }
    Likely { peaks, all }
}

/// Whether two peaks are one, seen in neighbouring layers or cells.
fn are_neighbours(a: &Disc, b: &Disc) -> bool {
    let ratio = a.radius / b.radius;
    (1.0 / NEIGHBOUR_RATIO..NEIGHBOUR_RATIO).contains(&ratio)
        && (a.x - b.x).powi(2) + (a.y - b.y).powi(2) < (1.1 * f64::from(CELL) * a.radius).powi(2)
}

struct Layer {
    radius: f32,
    left: f32,
    near: f32,
    columns: usize,
    rows: usize,
    shares: Vec<f32>,
}

/// Voters worked on together.
const LANES: usize = 4;

/// Some of those that vote, number by number, so that a processor takes several at once.
#[derive(Clone, Copy)]
struct Voters {
    x: [f32; LANES],
    y: [f32; LANES],
    nx: [f32; LANES],
    ny: [f32; LANES],
    length: [f32; LANES],
    worst_scale: [f32; LANES],
}

impl Voters {
    /// In blocks; what fills the last one up never votes.
    fn from_edges(edges: &[GroundEdge]) -> Vec<Self> {
        let nobody = [0.0; LANES];
        let empty =
            Self { x: nobody, y: nobody, nx: nobody, ny: nobody, length: nobody, worst_scale: [f32::INFINITY; LANES] };
        let block = |some: &[GroundEdge]| {
            let mut block = empty;
            for (lane, e) in some.iter().enumerate() {
                (block.x[lane], block.y[lane], block.nx[lane], block.ny[lane]) = (e.x, e.y, e.nx, e.ny);
                (block.length[lane], block.worst_scale[lane]) = (e.length, e.worst_scale);
            }
            block
        };
        edges.chunks(LANES).map(block).collect()
    }

    /// Masks: whether each voter's place is known well enough for circles of this radius (mm).
    fn fits(&self, radius: f32) -> f32x4 {
        (f32x4::from(self.worst_scale) * f32x4::splat(LEAST_RADIUS_PX)).cmp_le(f32x4::splat(radius))
    }
}

impl Layer {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "cells of a layer")]
    fn from_votes(voters: &[Voters], radius: f32) -> Option<Self> {
        let (low, high) = bounds(voters, radius)?;
        let cell = CELL * radius;
        let cells = |axis: usize| ((high[axis] - low[axis] + 2.0 * radius) / cell) as usize + 5;
        let (columns, rows) = (cells(0), cells(1));
        if columns.saturating_mul(rows) > MOST_CELLS {
            return None;
        }
        let (left, near) = (low[0] - radius - 2.0 * cell, low[1] - radius - 2.0 * cell);
        let mut shares = vec![0.0; columns * rows];
        let [per_mm, per_cell] = [1.0 / (std::f32::consts::TAU * radius), 1.0 / cell].map(f32x4::splat);
        let [left4, near4, stride] = [left, near, columns as f32].map(f32x4::splat);
        for block in voters {
            let fits = block.fits(radius).move_mask();
            if fits == 0 {
                continue;
            }
            let share = (f32x4::from(block.length) * per_mm).to_array();
            for side in [radius, -radius] {
                let side = f32x4::splat(side);
                let column = (f32x4::from(block.x) + side * f32x4::from(block.nx) - left4) * per_cell;
                let row = (f32x4::from(block.y) + side * f32x4::from(block.ny) - near4) * per_cell;
                let at = (whole(row) * stride + whole(column)).fast_trunc_int().to_array();
                for lane in 0..LANES {
                    if fits >> lane & 1 == 1 {
                        shares[at[lane] as usize] += share[lane];
                    }
                }
            }
        }
        Some(Self { radius, left, near, columns, rows, shares })
    }

    /// The highest sums over three by three cells.
    #[expect(clippy::cast_precision_loss, reason = "cells of a layer")]
    fn peaks(&self) -> Vec<(Disc, f32)> {
        let sums = self.sums_of_nine();
        let cell = CELL * self.radius;
        let mut peaks = Vec::new();
        for (row, line) in sums.chunks_exact(self.columns).enumerate().take(self.rows - 1).skip(1) {
            for (group, some) in line.chunks(GROUP).enumerate() {
                // Few are high enough: many are passed over at once.
                if some.iter().fold(false, |any, sum| any | (*sum >= LEAST_SHARE)) {
                    let columns = (group * GROUP).max(1)..(group * GROUP + some.len()).min(self.columns - 1);
                    for column in columns {
                        let at = row * self.columns + column;
                        if sums[at] >= LEAST_SHARE && is_peak(&sums, self.columns, at) {
                            let disc = Disc {
                                x: f64::from(self.left + (column as f32 + 0.5) * cell),
                                y: f64::from(self.near + (row as f32 + 0.5) * cell),
                                radius: f64::from(self.radius),
                            };
                            peaks.push((disc, sums[at]));
                        }
                    }
                }
            }
        }
        peaks.sort_by(|a, b| b.1.total_cmp(&a.1));
        peaks.truncate(PEAKS);
        peaks
    }

    fn sums_of_nine(&self) -> Vec<f32> {
        let mut sums = vec![0.0; self.shares.len()];
        let mut three = vec![0.0; self.columns];
        for row in 1..self.rows - 1 {
            let line = |r: usize| &self.shares[r * self.columns..(r + 1) * self.columns];
            for (((o, a), b), c) in three.iter_mut().zip(line(row - 1)).zip(line(row)).zip(line(row + 1)) {
                *o = a + b + c;
            }
            let out = &mut sums[row * self.columns + 1..(row + 1) * self.columns - 1];
            for (o, ((a, b), c)) in out.iter_mut().zip(three.iter().zip(&three[1..]).zip(&three[2..])) {
                *o = a + b + c;
            }
        }
        sums
    }
}

/// The whole parts of numbers of cells.
fn whole(v: f32x4) -> f32x4 {
    v.fast_trunc_int().round_float()
}

/// Corners (lowest and highest x and y, in mm) of what holds all that vote for circles of a radius.
fn bounds(voters: &[Voters], radius: f32) -> Option<([f32; 2], [f32; 2])> {
    let (mut low, mut high) = ([f32x4::splat(f32::INFINITY); 2], [f32x4::splat(f32::NEG_INFINITY); 2]);
    for block in voters {
        let fits = block.fits(radius);
        for (axis, place) in [block.x, block.y].into_iter().enumerate() {
            low[axis] = fits.blend(low[axis].fast_min(f32x4::from(place)), low[axis]);
            high[axis] = fits.blend(high[axis].fast_max(f32x4::from(place)), high[axis]);
        }
    }
    let low = low.map(|lanes| lanes.to_array().into_iter().fold(f32::INFINITY, f32::min));
    let high = high.map(|lanes| lanes.to_array().into_iter().fold(f32::NEG_INFINITY, f32::max));
    (low[0] <= high[0]).then_some((low, high))
}

fn is_peak(sums: &[f32], columns: usize, at: usize) -> bool {
    let sum = sums[at];
    let before = [at - columns - 1, at - columns, at - columns + 1, at - 1];
    let after = [at + 1, at + columns - 1, at + columns, at + columns + 1];
    before.iter().all(|i| sum > sums[*i]) && after.iter().all(|i| sum >= sums[*i])
}
