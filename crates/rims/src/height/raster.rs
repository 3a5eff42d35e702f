//! Edges drawn into a grid around one rim, so that one look tells whether an edge with some normal lies at a place.

use wide::{CmpGe, CmpLt, f32x4};

use crate::circles::{Buckets, Disc, angle_of};
use crate::edges::GroundEdge;

/// An edge counts for places within this many scaled pixels across it.
const ACROSS_PX: f32 = 1.5;
/// An edge counts for places within this multiple of its length along it.
const ALONG: f32 = 1.5;
/// An edge counts where a normal within 20 degrees of its own is asked for, to either side.
const WITHIN_RAD: f32 = 0.35;
/// The number of directions that are distinguished in half a turn.
const SECTORS: u32 = 16;
/// Cells per scaled pixel of the rim.
const CELLS_PER_PX: f64 = 1.5;
/// Cells along a side, at most.
const MOST_CELLS: f64 = 1200.0;

/// Components of normals count as this large at least: a strip is then longer than any raster.
const LEAST_NORMAL: f32 = 1e-5;

/// Places that are counted for [`Chances`]: around, and from ring to ring.
const TURNS: u32 = 60;
const RINGS: u32 = 16;

/// Limits of the chance that a place has an edge that means nothing, from 0 to 1.
#[derive(Debug, Clone, Copy)]
pub(super) struct ChanceLimits {
    pub least: f64,
    pub greatest: f64,
}

/// Chance of an edge that means nothing, by the direction of its normal.
pub(super) struct Chances([f64; SECTORS as usize]);

/// The odds that places give, where a given share of them shows an edge: for each direction of the normal, the logarithm of how much
/// likelier it is than by chance that no edge is seen there, and that one is.
pub(super) struct Odds([[f64; 2]; SECTORS as usize]);

impl Chances {
    pub(super) fn odds(&self, shows: f64) -> Odds {
        Odds(self.0.map(|chance| {
            let shows = shows.max(chance); // an edge speaks against nothing
            [((1.0 - shows) / (1.0 - chance)).ln(), (shows / chance).ln()]
        }))
    }
}

/// A direction of normals, to either side.
#[derive(Clone, Copy)]
pub(super) struct Sector(u8);

impl Sector {
    #[expect(clippy::cast_possible_truncation, reason = "an angle, a few sectors")]
    pub(super) fn from_normal(normal_rad: f64) -> Self {
        Self(sector(normal_rad as f32) as u8)
    }
}

/// The normals of edges, by place, within a window.
pub(super) struct Raster {
    left: f32,
    near: f32,
    /// Cells per mm.
    per_mm: f32,
    columns: usize,
    rows: usize,
    /// One bit per sector of directions.
    sectors: Vec<u16>,
}

/// Two corners in mm: the lowest x and y, and the highest.
pub(super) type Window = [[f64; 2]; 2];

impl Raster {
    /// The edges within `reach` (mm) of a centre, as far as they lie in the window, that are at least as strong as `least`
    /// (levels per scaled pixel). `scale`: mm per scaled pixel.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "cells")]
    pub(super) fn from_edges(
        buckets: &Buckets,
        center: [f64; 2],
        reach: f64,
        window: Window,
        scale: f64,
        least: f32,
    ) -> Self {
        let cell = (scale / CELLS_PER_PX).max(2.0 * reach / MOST_CELLS);
        // Cells are counted from the corner of the square about the centre, whatever the window.
        let cells = |axis: usize| {
            let corner = center[axis] - reach;
            let [first, last] = window.map(|place| ((place[axis] - corner).clamp(0.0, 2.0 * reach) / cell).floor());
            (corner + first * cell, (last - first) as usize + 1)
        };
        let ((left, columns), (near, rows)) = (cells(0), cells(1));
        let (left, near, per_mm) = (left as f32, near as f32, 1.0 / cell as f32);
        let sectors = vec![0; columns * rows];
        let mut raster = Self { left, near, per_mm, columns, rows, sectors };
        // All edges of the disc, as those near the rim of one half its size.
        let disc = Disc { x: center[0], y: center[1], radius: 0.75 * reach };
        buckets.near_rim(&disc, 0.76 * reach as f32, |e| {
            if e.contrast >= least {
                raster.draw(e);
            }
        });
        raster
    }

    /// Draws an edge: a rectangle along it, row by row.
    #[expect(clippy::cast_precision_loss, reason = "cells")]
    fn draw(&mut self, e: &GroundEdge) {
        // In cells, from the middle of the first one.
        let (x, y) = ((e.x - self.left) * self.per_mm - 0.5, (e.y - self.near) * self.per_mm - 0.5);
        let (across, along) = (ACROSS_PX * e.scale * self.per_mm, ALONG * e.length * self.per_mm);
        let reach = [across * e.nx.abs() + along * e.ny.abs(), across * e.ny.abs() + along * e.nx.abs()];
        if x + reach[0] < 0.0 || y + reach[1] < 0.0 || x - reach[0] > self.columns as f32 {
            return;
        }
        let bits = sectors_around(angle_of(e.nx, e.ny));
        // Each row meets the strip along the edge, and the one across it.
        let [by_x, by_y] = [e.nx, e.ny].map(|n| 1.0 / if n.abs() < LEAST_NORMAL { LEAST_NORMAL } else { n });
        let (along, across) = (along * by_y.abs(), across * by_x.abs());
        for row in cell_from(y - reach[1])..cells_up_to(y + reach[1]).min(self.rows) {
            let dy = row as f32 - y;
            let (a, b) = (-dy * e.ny * by_x, dy * e.nx * by_y);
            let first = cell_from(x + (a - across).max(b - along));
            let end = cells_up_to(x + (a + across).min(b + along)).min(self.columns);
            if first < end {
                for cell in &mut self.sectors[row * self.columns + first..row * self.columns + end] {
                    *cell |= bits;
                }
            }
        }
    }

    /// The evidence at a place, by whether it has an edge with such a normal.
    pub(super) fn says(&self, at: [f64; 2], normal: Sector, odds: &Odds) -> f64 {
        odds.0[usize::from(normal.0)][usize::from(self.sectors_at(at) >> normal.0 & 1)]
    }

    /// The sum of what edges say at four places, those that `counts` masks.
    pub(super) fn says_of_four(&self, [x, y]: [f32x4; 2], counts: f32x4, normals: [Sector; 4], odds: &Odds) -> f64 {
        let counts = counts.move_mask();
        if counts == 0 {
            return 0.0;
        }
        let [columns, rows] = [self.columns as f32, self.rows as f32].map(f32x4::splat);
        let column = (x - f32x4::splat(self.left)) * f32x4::splat(self.per_mm);
        let row = (y - f32x4::splat(self.near)) * f32x4::splat(self.per_mm);
        let is_positive = column.cmp_ge(f32x4::ZERO) & row.cmp_ge(f32x4::ZERO);
        let is_inside = (is_positive & column.cmp_lt(columns) & row.cmp_lt(rows)).move_mask();
        let [column, row] = [column, row].map(|cell| cell.fast_trunc_int().to_array());
        let mut sum = 0.0;
        for (lane, normal) in normals.into_iter().enumerate() {
            if counts >> lane & 1 == 1 {
                let cell = || row[lane] as usize * self.columns + column[lane] as usize;
                let bits = if is_inside >> lane & 1 == 1 { self.sectors[cell()] } else { 0 };
                sum += odds.0[usize::from(normal.0)][usize::from(bits >> normal.0 & 1)];
            }
        }
        sum
    }

    /// For each sector of directions, the share of the places in a ring about a circle that have an edge with such a normal:
    /// what chance makes of a look, on striped cloth much in one direction and little in others.
    pub(super) fn chances(&self, disc: &Disc, rings: [f64; 2], limits: ChanceLimits) -> Chances {
        let mut held = [0_u32; SECTORS as usize];
        for turn in 0..TURNS {
            let angle = f64::from(turn) / f64::from(TURNS) * std::f64::consts::TAU;
            for ring in 0..RINGS {
                let share = (f64::from(ring) + 0.5) / f64::from(RINGS);
                let radius = disc.radius * (rings[0] + (rings[1] - rings[0]) * share);
                let bits = self.sectors_at([disc.x + radius * angle.cos(), disc.y + radius * angle.sin()]);
                for (sector, held) in held.iter_mut().enumerate() {
                    *held += u32::from(bits >> sector & 1);
                }
            }
        }
        Chances(held.map(|held| (f64::from(held) / f64::from(TURNS * RINGS)).clamp(limits.least, limits.greatest)))
    }

    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "cells")]
    fn sectors_at(&self, at: [f64; 2]) -> u16 {
        let (column, row) = ((at[0] as f32 - self.left) * self.per_mm, (at[1] as f32 - self.near) * self.per_mm);
        // By way of i32, which is quicker.
        let (whole_column, whole_row) = (column as i32 as usize, row as i32 as usize);
        if column >= 0.0 && row >= 0.0 && whole_column < self.columns && whole_row < self.rows {
            self.sectors[whole_row * self.columns + whole_column]
        } else {
            0
        }
    }
}

/// The number of cells up to a place.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "cells")]
fn cells_up_to(place: f32) -> usize {
    if place >= 0.0 { place as i32 as usize + 1 } else { 0 }
}

/// The first cell from a place on; the first of all for places before it.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "cells")]
fn cell_from(place: f32) -> usize {
    let place = place.max(0.0);
    let whole = place as i32;
    whole as usize + usize::from((whole as f32) < place)
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "sectors")]
fn sector(angle: f32) -> u32 {
    ((angle.rem_euclid(std::f32::consts::PI) / std::f32::consts::PI * SECTORS as f32) as u32).min(SECTORS - 1)
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "sectors")]
fn sectors_around(angle: f32) -> u16 {
    let per_rad = SECTORS as f32 / std::f32::consts::PI;
    // Two turns on, so that nothing is negative.
    let middle = angle * per_rad + 4.0 * SECTORS as f32;
    let mut bits = 0;
    for i in -2_i8..=2 {
        bits |= 1 << ((middle + f32::from(i) * (0.5 * WITHIN_RAD * per_rad)) as i32 as u32 % SECTORS);
    }
    bits
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each cell whose middle lies in the rectangle along an edge has its directions, and no other one.
    #[test]
    fn edges_are_rectangles_of_cells() {
        for turn in 0..32_u8 {
            let angle = f32::from(turn) * 0.2;
            let (x, y) = (13.3 + f32::from(turn % 7) * 9.1, 41.7);
            let (nx, ny) = (angle.cos(), angle.sin());
            let e = GroundEdge { x, y, nx, ny, length: 3.1, scale: 1.3, worst_scale: 1.3, contrast: 9.0 };
            let (columns, rows) = (60, 50);
            let mut raster =
                Raster { left: 5.0, near: 4.0, per_mm: 1.1, columns, rows, sectors: vec![0; columns * rows] };
            raster.draw(&e);
            for (at, bits) in raster.sectors.iter().enumerate() {
                let [column, row] = [at % columns, at / columns].map(|cell| (cell as f32 + 0.5) / 1.1);
                let (dx, dy) = (5.0 + column - x, 4.0 + row - y);
                let within = [ACROSS_PX * 1.3 - (dx * nx + dy * ny).abs(), ALONG * 3.1 - (dx * ny - dy * nx).abs()];
                let inside = within[0].min(within[1]);
                assert!(inside.abs() < 1e-3 || (inside > 0.0) == (*bits != 0), "turn {turn}, cell {at}: {inside}");
            }
        }
    }

    /// Four looks at once see what each of them does, also beside the raster.
    #[test]
    fn four_looks_are_four_times_one() {
        let sectors = (0..60 * 50).map(|cell: u32| (cell * 40_503 % 65_521) as u16).collect();
        let raster = Raster { left: -20.0, near: 7.0, per_mm: 0.8, columns: 60, rows: 50, sectors };
        let odds = Chances(std::array::from_fn(|sector| 0.1 + 0.03 * sector as f64)).odds(0.7);
        for step in 0..200_u8 {
            let places = [0.0, 31.0, 62.0, 93.0].map(|more: f32| [f32::from(step) - 60.0 + more, 60.0 - more * 0.7]);
            let normals = [0, 1, 2, 3].map(|i| Sector::from_normal(f64::from(step) * 0.1 + f64::from(i)));
            let four = [0, 1].map(|axis| f32x4::from(places.map(|place| place[axis])));
            let counts = four[0].cmp_lt(f32x4::splat(40.0));
            let one = |lane: usize| raster.says(places[lane].map(f64::from), normals[lane], &odds);
            let expected: f64 = (0..4).filter(|lane| places[*lane][0] < 40.0).map(one).sum();
            assert!((raster.says_of_four(four, counts, normals, &odds) - expected).abs() < 1e-12);
        }
    }
}
