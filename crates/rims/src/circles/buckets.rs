//! Edges on the plane, sorted into squares for quick finding.

use std::ops::Range;

use super::lanes::Lanes;
use super::trial::Disc;
use crate::edges::GroundEdge;

/// Squares along the longer side of the searched ground.
const SQUARES: f32 = 160.0;

/// Edges on the plane by square.
pub(crate) struct Buckets {
    left: f32,
    near: f32,
    side: f32,
    columns: usize,
    rows: usize,
    /// First edge of each square; one more at the end.
    starts: Vec<u32>,
    edges: Vec<GroundEdge>,
    lanes: Lanes,
}

impl Buckets {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "squares")]
    pub(crate) fn new(edges: &[GroundEdge]) -> Self {
        let bound = |of: fn(&GroundEdge) -> f32| {
            edges.iter().map(of).fold((f32::INFINITY, f32::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)))
        };
        let ((left, right), (near, far)) = (bound(|e| e.x), bound(|e| e.y));
        let side = ((right - left).max(far - near) / SQUARES).max(1.0);
        let cells = |extent: f32| if extent.is_finite() { (extent / side) as usize + 1 } else { 1 };
        let (columns, rows) = (cells(right - left), cells(far - near));
        let square = |e: &GroundEdge| ((e.y - near) / side) as usize * columns + ((e.x - left) / side) as usize;
        let squares: Vec<usize> = edges.iter().map(square).collect();
        let mut starts = vec![0_u32; columns * rows + 1];
        for square in &squares {
            starts[square + 1] += 1;
        }
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut places = starts.clone();
        let mut sorted: Vec<GroundEdge> = edges.to_vec();
        for (e, square) in edges.iter().zip(squares) {
            sorted[places[square] as usize] = *e;
            places[square] += 1;
        }
        let lanes = Lanes::of(&sorted);
        Self { left, near, side, columns, rows, starts, edges: sorted, lanes }
    }

    /// Calls `take` with each edge whose distance from the disc's rim is at most `width` (mm).
    #[expect(clippy::cast_possible_truncation, reason = "mm")]
    pub(crate) fn near_rim(&self, disc: &Disc, width: f32, mut take: impl FnMut(&GroundEdge)) {
        let (x, y, radius) = (disc.x as f32, disc.y as f32, disc.radius as f32);
        let (outer, inner) = (radius + width, (radius - width).max(0.0));
        self.ranges_near(disc, width, |range| {
            for e in &self.edges[range] {
                let (dx, dy) = (e.x - x, e.y - y);
                let squared = dx * dx + dy * dy;
                if squared <= outer * outer && squared >= inner * inner {
                    take(e);
                }
            }
        });
    }

    /// Calls `take` with places of edges among which are all that are within `width` (mm) of the disc's rim.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "squares")]
    pub(crate) fn ranges_near(&self, disc: &Disc, width: f32, mut take: impl FnMut(Range<usize>)) {
        let (x, y, radius) = (disc.x as f32, disc.y as f32, disc.radius as f32);
        let (outer, inner) = (radius + width, (radius - width).max(0.0));
        let index = |v: f32, most: usize| ((v / self.side).max(0.0) as usize).min(most);
        let mut pass = |row: usize, from: f32, to: f32| {
            let (first, last) =
                (index(from - self.left, self.columns), index(to - self.left + self.side, self.columns));
            let base = row * self.columns;
            let range = self.starts[base + first] as usize..self.starts[base + last.max(first)] as usize;
            if !range.is_empty() {
                take(range);
            }
        };
        for row in index(y - outer - self.near, self.rows)..index(y + outer - self.near + self.side, self.rows) {
            let low = self.near + row as f32 * self.side - y;
            let (nearest, furthest) = ((low.max(-low - self.side)).max(0.0), low.abs().max((low + self.side).abs()));
            let reach = (outer * outer - nearest * nearest).max(0.0).sqrt();
            // In the middle rows the disc's inside is left out, if that saves a square.
            let hole = (inner * inner - furthest * furthest).max(0.0).sqrt() - self.side;
            if hole > self.side {
                pass(row, x - reach, x - hole - self.side);
                pass(row, x + hole, x + reach);
            } else {
                pass(row, x - reach, x + reach);
            }
        }
    }

    /// Their numbers, in the order of [`Self::ranges_near`].
    pub(crate) fn lanes(&self) -> &Lanes {
        &self.lanes
    }

    /// All edges.
    pub(crate) fn edges(&self) -> &[GroundEdge] {
        &self.edges
    }
}
