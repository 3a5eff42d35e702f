//! Voting for circles: every edge names the centres, on both sides of it, of all circles that it may be part of.

use super::ground::GroundEdge;

/// A circle on the plane Z = 0, in mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Disc {
    pub x: f64,
    pub y: f64,
    pub radius: f64,
}

/// Circles voted for, those with most votes for their length first.
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
/// Cells of a layer; a layer that would have more is not searched.
const MOST_CELLS: usize = 1 << 21;

/// Likely circles with radii between the limits (mm on the plane Z = 0).
pub(super) fn likely_discs(edges: &[GroundEdge], [smallest, largest]: [f64; 2]) -> Likely {
    let mut found = Vec::new();
    #[expect(clippy::cast_possible_truncation, reason = "mm")]
    let (mut radius, largest) = (smallest as f32, largest as f32);
    while radius <= largest {
        if let Some(layer) = Layer::of(edges, radius) {
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

impl Layer {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "cells of a layer")]
    fn of(edges: &[GroundEdge], radius: f32) -> Option<Self> {
        let fits = |e: &&GroundEdge| e.worst_scale * LEAST_RADIUS_PX <= radius;
        let (mut low, mut high) = ([f32::INFINITY; 2], [f32::NEG_INFINITY; 2]);
        for e in edges.iter().filter(fits) {
            low = [low[0].min(e.x), low[1].min(e.y)];
            high = [high[0].max(e.x), high[1].max(e.y)];
        }
        if low[0] > high[0] {
            return None;
        }
        let cell = CELL * radius;
        let cells = |axis: usize| ((high[axis] - low[axis] + 2.0 * radius) / cell) as usize + 5;
        let (columns, rows) = (cells(0), cells(1));
        if columns.saturating_mul(rows) > MOST_CELLS {
            return None;
        }
        let (left, near) = (low[0] - radius - 2.0 * cell, low[1] - radius - 2.0 * cell);
        let mut layer = Self { radius, left, near, columns, rows, shares: vec![0.0; columns * rows] };
        let per_mm = 1.0 / (std::f32::consts::TAU * radius);
        for e in edges.iter().filter(fits) {
            let share = e.length * per_mm;
            for side in [radius, -radius] {
                let column = ((e.x + side * e.nx - left) / cell) as usize;
                let row = ((e.y + side * e.ny - near) / cell) as usize;
                layer.shares[row * columns + column] += share;
            }
        }
        Some(layer)
    }

    /// The highest sums over three by three cells.
    #[expect(clippy::cast_precision_loss, reason = "cells of a layer")]
    fn peaks(&self) -> Vec<(Disc, f32)> {
        let sums = self.sums_of_nine();
        let mut peaks = Vec::new();
        for row in 1..self.rows - 1 {
            for column in 1..self.columns - 1 {
                let at = row * self.columns + column;
                let sum = sums[at];
                if sum < LEAST_SHARE || !is_peak(&sums, self.columns, at) {
                    continue;
                }
                let cell = CELL * self.radius;
                let disc = Disc {
                    x: f64::from(self.left + (column as f32 + 0.5) * cell),
                    y: f64::from(self.near + (row as f32 + 0.5) * cell),
                    radius: f64::from(self.radius),
                };
                peaks.push((disc, sum));
            }
        }
        peaks.sort_by(|a, b| b.1.total_cmp(&a.1));
        peaks.truncate(PEAKS);
        peaks
    }

    fn sums_of_nine(&self) -> Vec<f32> {
        let mut along = vec![0.0; self.shares.len()];
        for (row, out) in self.shares.chunks_exact(self.columns).zip(along.chunks_exact_mut(self.columns)) {
            for (w, o) in row.windows(3).zip(&mut out[1..]) {
                *o = w[0] + w[1] + w[2];
            }
        }
        let mut sums = vec![0.0; self.shares.len()];
        for row in 1..self.rows - 1 {
            let line = |r: usize| &along[r * self.columns..(r + 1) * self.columns];
            let (a, b, c) = (line(row - 1), line(row), line(row + 1));
            for (x, o) in sums[row * self.columns..(row + 1) * self.columns].iter_mut().enumerate() {
                *o = a[x] + b[x] + c[x];
            }
        }
        sums
    }
}

fn is_peak(sums: &[f32], columns: usize, at: usize) -> bool {
    let sum = sums[at];
    let before = [at - columns - 1, at - columns, at - columns + 1, at - 1];
    let after = [at + 1, at + columns - 1, at + columns, at + columns + 1];
    before.iter().all(|i| sum > sums[*i]) && after.iter().all(|i| sum >= sums[*i])
}
