//! Four lines on the plane Z = 0 that are about a rectangle.

use nalgebra::{Matrix2, Point2, Vector2};

use crate::edges::GroundEdge;

/// A distance from a side: so many mm on the plane Z = 0, and at least so many scaled pixels.
#[derive(Clone, Copy)]
struct Reach {
    mm: f64,
    px: f64,
}

/// The distances within which edges count, from pass to pass of a fit.
const PASSES: [Reach; 4] =
    [Reach { mm: 4.0, px: 4.0 }, Reach { mm: 2.5, px: 3.0 }, Reach { mm: 0.0, px: 2.0 }, Reach { mm: 0.0, px: 1.5 }];
/// Edges that a fit may meet lie within this distance of a side's start.
const GATHERED: Reach = Reach { mm: 10.0, px: 6.0 };
/// Edges along a side within 12 degrees of its direction are its own.
const LEAST_COSINE: f64 = 0.978;
/// Parts of a side next to its corners, which may be rounded, do not say where it is.
const CORNER_SHARE: f64 = 0.08;
/// A side with less edge along it than this share stays where it was.
const LEAST_SHARE: f64 = 0.15;
/// A fit turns a side by no more than this in one step (tangent).
const MOST_TURN: f64 = 0.03;

/// A point of a line, and its direction.
pub(super) type Straight = (Point2<f64>, Vector2<f64>);

/// A quadrilateral by its corners, in mm, counter-clockwise as seen from above. Side `k` runs from corner `k` to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Quad {
    pub corners: [Point2<f64>; 4],
}

/// A side of a quad.
#[derive(Debug, Clone, Copy)]
pub(super) struct Side {
    pub from: Point2<f64>,
    pub along: Vector2<f64>,
    /// Points out of the quad.
    pub out: Vector2<f64>,
    pub length: f64,
}

impl Side {
    /// Place along it (0 to its length) and distance out of the quad, in mm.
    pub(super) fn place(&self, at: Point2<f64>) -> (f64, f64) {
        let to = at - self.from;
        (self.along.dot(&to), self.out.dot(&to))
    }

    /// An edge along the side's direction: where, how far out, and whether brighter lies out there.
    pub(super) fn parallel(&self, e: &GroundEdge) -> Option<(f64, f64, bool)> {
        let cosine = self.out.x * f64::from(e.nx) + self.out.y * f64::from(e.ny);
        if cosine.abs() < LEAST_COSINE {
            return None;
        }
        let (t, off) = self.place(Point2::new(f64::from(e.x), f64::from(e.y)));
        Some((t, off, cosine > 0.0))
    }
}

impl Quad {
    /// The corners where the lines meet; none where two sides next to each other are parallel.
    pub(super) fn of_lines(lines: &[Straight; 4]) -> Option<Self> {
        let meet = |a: &Straight, b: &Straight| {
            let solved = Matrix2::from_columns(&[a.1, -b.1]).try_inverse()? * (b.0 - a.0);
            Some(a.0 + a.1 * solved.x)
        };
        let corner = |k: usize| meet(&lines[(k + 3) % 4], &lines[k]);
        Some(Self { corners: [corner(0)?, corner(1)?, corner(2)?, corner(3)?] })
    }

    pub(super) fn side(&self, k: usize) -> Side {
        let (from, to) = (self.corners[k], self.corners[(k + 1) % 4]);
        let way = to - from;
        let length = way.norm();
        let along = way / length.max(1e-9);
        Side { from, along, out: Vector2::new(along.y, -along.x), length }
    }

    pub(super) fn sides(&self) -> [Side; 4] {
        [0, 1, 2, 3].map(|k| self.side(k))
    }

    pub(super) fn center(&self) -> Point2<f64> {
        Point2::from(self.corners.iter().map(|c| c.coords).sum::<Vector2<f64>>() / 4.0)
    }

    /// Lengths of its sides, the mean of opposite ones: those of sides 0 and 2, of 1 and 3.
    pub(super) fn extent(&self) -> [f64; 2] {
        let [a, b, c, d] = self.sides().map(|side| side.length);
        [0.5 * (a + c), 0.5 * (b + d)]
    }

    /// Half of the longest way across.
    pub(super) fn reach(&self) -> f64 {
        let center = self.center();
        self.corners.iter().map(|c| (c - center).norm()).fold(0.0, f64::max)
    }

    /// The departure from a rectangle: the largest cosine between neighbours, and difference of opposite sides, as a share.
    pub(super) fn skew(&self) -> f64 {
        let sides = self.sides();
        let corner = (0..4).map(|k| sides[k].along.dot(&sides[(k + 1) % 4].along).abs()).fold(0.0, f64::max);
        let unlike = |a: &Side, b: &Side| (a.length - b.length).abs() / (0.5 * (a.length + b.length)).max(1e-9);
        corner.max(unlike(&sides[0], &sides[2])).max(unlike(&sides[1], &sides[3]))
    }

    /// Largest distance between corners of both.
    pub(super) fn apart(&self, other: &Self) -> f64 {
        let way =
            |turn: usize| (0..4).map(|k| (self.corners[k] - other.corners[(k + turn) % 4]).norm()).fold(0.0, f64::max);
        (0..4).map(way).fold(f64::INFINITY, f64::min)
    }

    /// Returns the quad fitted to the edges along its sides, each side by itself; none where it falls apart.
    pub(super) fn fitted(&self, near: &[GroundEdge]) -> Option<Self> {
        let mut quad = *self;
        let sides = self.sides();
        let is_beside = |side: &Side, e: &GroundEdge| {
            side.parallel(e).is_some_and(|(_, off, _)| off.abs() < GATHERED.mm.max(GATHERED.px * f64::from(e.scale)))
        };
        let near: Vec<GroundEdge> =
            near.iter().filter(|e| sides.iter().any(|side| is_beside(side, e))).copied().collect();
        for Reach { mm, px } in PASSES {
            let lines = quad.sides().map(|side| line(&side, &near, mm, px));
            quad = Self::of_lines(&lines)?;
        }
        (quad.apart(self) < 0.15 * self.reach() && quad.is_convex()).then_some(quad)
    }

    pub(super) fn is_convex(&self) -> bool {
        let sides = self.sides();
        (0..4).all(|k| sides[k].along.perp(&sides[(k + 1) % 4].along) > 0.5)
    }
}

/// The line of a side after one step of robust least squares (Tukey's weights).
fn line(side: &Side, near: &[GroundEdge], mm: f64, px: f64) -> Straight {
    let inner = CORNER_SHARE * side.length..(1.0 - CORNER_SHARE) * side.length;
    let (mut sums, mut length) = ([0.0; 5], 0.0);
    for e in near {
        let ring = mm.max(px * f64::from(e.scale));
        let Some((t, off, _)) = side.parallel(e).filter(|(t, off, _)| inner.contains(t) && off.abs() < ring) else {
            continue;
        };
        let tukey = (1.0 - (off / ring).powi(2)).powi(2);
        let weight = tukey * f64::from(e.length / (e.scale * e.scale));
        let u = t / side.length - 0.5;
        for (sum, term) in sums.iter_mut().zip([1.0, u, u * u, off, u * off]) {
            *sum += weight * term;
        }
        length += f64::from(e.length);
    }
    let [w, wu, wuu, wo, wuo] = sums;
    // A turn is believed as far as the edges reach along the side.
    let wuu = wuu + 0.002 * w;
    let det = w * wuu - wu * wu;
    if length < LEAST_SHARE * side.length || det <= 1e-12 {
        return (side.from, side.along);
    }
    let turn = ((w * wuo - wu * wo) / det).clamp(-MOST_TURN * side.length, MOST_TURN * side.length);
    let shift = (wo - turn * wu) / w;
    let from = side.from + side.out * (shift - 0.5 * turn);
    let to = side.from + side.along * side.length + side.out * (shift + 0.5 * turn);
    (from, (to - from).normalize())
}
