//! Edges on the plane, sorted into squares for quick finding.

use super::ground::GroundEdge;
use super::votes::Disc;

/// Edges on the plane by square.
pub(super) struct Buckets {
    left: f32,
    near: f32,
    side: f32,
    columns: usize,
    rows: usize,
    /// First edge of each square; one more at the end.
    starts: Vec<u32>,
    edges: Vec<GroundEdge>,
}

impl Buckets {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "squares")]
    /// `squares`: how many along the longer side of the searched ground; many for places, few for circles.
    pub(super) fn new(edges: &[GroundEdge], squares: u16) -> Self {
        let bound = |of: fn(&GroundEdge) -> f32| {
            edges.iter().map(of).fold((f32::INFINITY, f32::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)))
        };
        let ((left, right), (near, far)) = (bound(|e| e.x), bound(|e| e.y));
        let side = ((right - left).max(far - near) / f32::from(squares)).max(1.0);
        let cells = |extent: f32| if extent.is_finite() { (extent / side) as usize + 1 } else { 1 };
        let (columns, rows) = (cells(right - left), cells(far - near));
        let square = |e: &GroundEdge| ((e.y - near) / side) as usize * columns + ((e.x - left) / side) as usize;
        let mut starts = vec![0_u32; columns * rows + 1];
        for e in edges {
            starts[square(e) + 1] += 1;
        }
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut sorted: Vec<GroundEdge> = edges.to_vec();
        sorted.sort_by_key(square);
        Self { left, near, side, columns, rows, starts, edges: sorted }
    }

    /// Edges whose distance from the disc's rim is at most `width` (mm).
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "squares")]
    pub(super) fn near_rim<'a>(&'a self, disc: &Disc, width: f32) -> impl Iterator<Item = &'a GroundEdge> {
        let (x, y, radius) = (disc.x as f32, disc.y as f32, disc.radius as f32);
        let reach = radius + width;
        let index = |v: f32, most: usize| (v / self.side).max(0.0).min(most as f32) as usize;
        let columns = index(x - reach - self.left, self.columns)..index(x + reach - self.left + self.side, self.columns);
        let rows = index(y - reach - self.near, self.rows)..index(y + reach - self.near + self.side, self.rows);
        let half_diagonal = 0.708 * self.side;
        let squares = rows.flat_map(move |row| columns.clone().map(move |column| (row, column)));
        squares
            .filter(move |(row, column)| {
                let dx = self.left + (*column as f32 + 0.5) * self.side - x;
                let dy = self.near + (*row as f32 + 0.5) * self.side - y;
                (dx.hypot(dy) - radius).abs() <= width + half_diagonal
            })
            .flat_map(move |(row, column)| {
                let at = row * self.columns + column;
                &self.edges[self.starts[at] as usize..self.starts[at + 1] as usize]
            })
            .filter(move |e| ((e.x - x).hypot(e.y - y) - radius).abs() <= width)
    }

    /// All edges.
    pub(super) fn edges(&self) -> &[GroundEdge] {
        &self.edges
    }

    /// Edges in the square of a place and the squares around it.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "squares")]
    pub(super) fn around(&self, x: f32, y: f32) -> impl Iterator<Item = &GroundEdge> {
        let index = |v: f32| (v / self.side).floor().clamp(-2.0, 1e6) as i64;
        let (column, row) = (index(x - self.left), index(y - self.near));
        (row - 1..=row + 1).flat_map(move |row| {
            let columns = (column - 1).max(0)..(column + 2).min(self.columns as i64);
            let inside = (0..self.rows as i64).contains(&row) && !columns.is_empty();
            let range = if inside {
                let base = row as usize * self.columns;
                self.starts[base + columns.start as usize] as usize..self.starts[base + columns.end as usize] as usize
            } else {
                0..0
            };
            &self.edges[range]
        })
    }
}
