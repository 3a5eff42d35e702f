//! Edges drawn into a grid around one rim: whether an edge with some normal lies at a place is then one look.

use super::buckets::Buckets;
use super::ground::GroundEdge;
use super::votes::Disc;

/// An edge answers for places within this many scaled pixels across it ...
const ACROSS_PX: f32 = 1.5;
/// ... and this multiple of its length along it ...
const ALONG: f32 = 1.5;
/// ... that ask for a normal within 20 degrees of its own, to either side.
const WITHIN_RAD: f32 = 0.35;
/// Directions that are told apart in half a turn.
const SECTORS: u32 = 16;
/// Cells per scaled pixel of the rim.
const CELLS_PER_PX: f64 = 1.5;
/// Cells along a side, at most.
const MOST_CELLS: f64 = 1200.0;

/// Places that are counted for [`Chances`]: around, and from ring to ring.
const TURNS: u32 = 60;
const RINGS: u32 = 16;

/// Chance of an edge that means nothing, by the direction of its normal.
pub(super) struct Chances([f64; SECTORS as usize]);

/// What places say that show an edge at a given share of them: for each direction of the normal, the logarithm of how much
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
    pub(super) fn of(normal_rad: f64) -> Self {
        Self(sector(normal_rad as f32) as u8)
    }
}

/// Which normals edges have, by place, within a window.
pub(super) struct Raster {
    left: f32,
    near: f32,
    cell: f32,
    columns: i64,
    rows: i64,
    /// One bit per sector of directions.
    sectors: Vec<u16>,
}

/// Two corners in mm: the lowest x and y, and the highest.
pub(super) type Window = [[f64; 2]; 2];

impl Raster {
    /// The edges within `reach` (mm) of a centre, as far as they lie in the window, that are at least as strong as `least`
    /// (levels per scaled pixel). `scale`: mm per scaled pixel.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "cells")]
    pub(super) fn of(buckets: &Buckets, center: [f64; 2], reach: f64, window: Window, scale: f64, least: f32) -> Self {
        let cell = (scale / CELLS_PER_PX).max(2.0 * reach / MOST_CELLS);
        // Cells are counted from the corner of the square about the centre, whatever the window.
        let cells = |axis: usize| {
            let corner = center[axis] - reach;
            let [first, last] = window.map(|place| ((place[axis] - corner).clamp(0.0, 2.0 * reach) / cell).floor());
            (corner + first * cell, (last - first) as i64 + 1)
        };
        let ((left, columns), (near, rows)) = (cells(0), cells(1));
        let (left, near, cell) = (left as f32, near as f32, cell as f32);
        let sectors = vec![0; (columns * rows) as usize];
        let mut raster = Self { left, near, cell, columns, rows, sectors };
        // All edges of the disc, as those near the rim of one half its size.
        let disc = Disc { x: center[0], y: center[1], radius: 0.75 * reach };
        buckets.near_rim(&disc, 0.76 * reach as f32, |e| {
            if e.contrast >= least {
                raster.draw(e);
            }
        });
        raster
    }

    /// Draws an edge.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "cells")]
    fn draw(&mut self, e: &GroundEdge) {
        let (across, along) = (ACROSS_PX * e.scale, ALONG * e.length);
        let half = ((across + along) / self.cell) as i64 + 1;
        let (column, row) = self.cell_of(e.x, e.y);
        let rows = (row - half).max(0)..(row + half + 1).min(self.rows);
        let columns = (column - half).max(0)..(column + half + 1).min(self.columns);
        if rows.is_empty() || columns.is_empty() {
            return;
        }
        let bits = sectors_around(e.ny.atan2(e.nx));
        for r in rows {
            for c in columns.clone() {
                let dx = self.left + (c as f32 + 0.5) * self.cell - e.x;
                let dy = self.near + (r as f32 + 0.5) * self.cell - e.y;
                if (dx * e.nx + dy * e.ny).abs() <= across && (dx * e.ny - dy * e.nx).abs() <= along {
                    self.sectors[(r * self.columns + c) as usize] |= bits;
                }
            }
        }
    }

    /// What an edge with such a normal says at a place, or that there is none.
    pub(super) fn says(&self, at: [f64; 2], normal: Sector, odds: &Odds) -> f64 {
        odds.0[usize::from(normal.0)][usize::from(self.sectors_at(at) >> normal.0 & 1)]
    }

    /// For each sector of directions, the share of the places in a ring about a circle that have an edge with such a normal:
    /// what chance makes of a look, on striped cloth much in one direction and little in others.
    pub(super) fn chances(&self, disc: &Disc, rings: [f64; 2], limits: (f64, f64)) -> Chances {
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
        Chances(held.map(|held| (f64::from(held) / f64::from(TURNS * RINGS)).clamp(limits.0, limits.1)))
    }

    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "cells")]
    fn sectors_at(&self, at: [f64; 2]) -> u16 {
        let (column, row) = self.cell_of(at[0] as f32, at[1] as f32);
        let is_inside = (0..self.columns).contains(&column) && (0..self.rows).contains(&row);
        if is_inside { self.sectors[(row * self.columns + column) as usize] } else { 0 }
    }

    #[expect(clippy::cast_possible_truncation, reason = "cells")]
    fn cell_of(&self, x: f32, y: f32) -> (i64, i64) {
        (((x - self.left) / self.cell).floor() as i64, ((y - self.near) / self.cell).floor() as i64)
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "sectors")]
fn sector(angle: f32) -> u32 {
    ((angle.rem_euclid(std::f32::consts::PI) / std::f32::consts::PI * SECTORS as f32) as u32).min(SECTORS - 1)
}

fn sectors_around(angle: f32) -> u16 {
    let mut bits = 0;
    for i in -2_i8..=2 {
        bits |= 1 << sector(angle + f32::from(i) * 0.5 * WITHIN_RAD);
    }
    bits
}
