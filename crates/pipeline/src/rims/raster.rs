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
    /// The edges within `reach` (mm) of a centre, as far as they lie in the window. `scale`: mm per scaled pixel.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "cells")]
    pub(super) fn of(buckets: &Buckets, center: [f64; 2], reach: f64, window: Window, scale: f64) -> Self {
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
        buckets.near_rim(&disc, 0.76 * reach as f32, |e| raster.draw(e));
        raster
    }

    /// Draws an edge.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "cells")]
    fn draw(&mut self, e: &GroundEdge) {
        let (across, along) = (ACROSS_PX * e.scale, ALONG * e.length);
        let half = |across_part: f32, along_part: f32| {
            ((across * across_part.abs() + along * along_part.abs()) / self.cell) as i64 + 1
        };
        let (half_columns, half_rows) = (half(e.nx, e.ny), half(e.ny, e.nx));
        let (column, row) = self.cell_of(e.x, e.y);
        let columns = (column - half_columns).max(0)..(column + half_columns + 1).min(self.columns);
        let rows = (row - half_rows).max(0)..(row + half_rows + 1).min(self.rows);
        if columns.is_empty() || rows.is_empty() {
            return;
        }
        let bits = sectors_around(e.ny.atan2(e.nx));
        for r in rows {
            let dy = self.near + (r as f32 + 0.5) * self.cell - e.y;
            let base = r * self.columns;
            let cells = &mut self.sectors[(base + columns.start) as usize..(base + columns.end) as usize];
            for (c, cell) in columns.clone().zip(cells) {
                let dx = self.left + (c as f32 + 0.5) * self.cell - e.x;
                if (dx * e.nx + dy * e.ny).abs() <= across && (dx * e.ny - dy * e.nx).abs() <= along {
                    *cell |= bits;
                }
            }
        }
    }

    /// Whether an edge with this normal (to either side) lies at a place.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "cells")]
    pub(super) fn has_edge(&self, at: [f64; 2], normal_rad: f64) -> bool {
        let (column, row) = self.cell_of(at[0] as f32, at[1] as f32);
        (0..self.columns).contains(&column)
            && (0..self.rows).contains(&row)
            && self.sectors[(row * self.columns + column) as usize] & (1 << sector(normal_rad as f32)) != 0
    }

    #[expect(clippy::cast_possible_truncation, reason = "cells")]
    fn cell_of(&self, x: f32, y: f32) -> (i64, i64) {
        (((x - self.left) / self.cell).floor() as i64, ((y - self.near) / self.cell).floor() as i64)
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "sectors")]
fn sector(angle: f32) -> u32 {
    let half_turns = angle * std::f32::consts::FRAC_1_PI;
    (((half_turns - half_turns.floor()) * SECTORS as f32) as u32).min(SECTORS - 1)
}

fn sectors_around(angle: f32) -> u16 {
    let mut bits = 0;
    for i in -2_i8..=2 {
        bits |= 1 << sector(angle + f32::from(i) * 0.5 * WITHIN_RAD);
    }
    bits
}
