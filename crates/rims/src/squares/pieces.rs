//! Straight pieces of the edges on the plane Z = 0.

use nalgebra::{Point2, Vector2};

use crate::edges::GroundEdge;

/// Neighbours on a chain are nearer to each other than this multiple of the length that one of them stands for.
const NEXT: f32 = 4.0;
/// A piece is straight if its edges are within this many scaled pixels of its chord.
const STRAIGHT_PX: f64 = 1.2;
/// A piece is looked at if it has so many edges, and is so long (mm).
const LEAST_EDGES: usize = 8;
const LEAST_MM: f64 = 10.0;
/// Pieces are of one line if their directions differ by less than this (sine).
const SAME_SINE: f64 = 0.06;
/// Pieces are of one line if their ends are within so many scaled pixels of it, and within this share of the way to them.
const SAME_PX: f64 = 1.5;
const SAME_SHARE: f64 = 0.012;
/// Pieces are of one line if the gap between them is no wider than this (mm), or than this share of the shorter.
const GAP_MM: f64 = 14.0;
const GAP_SHARE: f64 = 0.5;
/// Sides of a rectangle are seldom among the shorter pieces beyond this many.
const MOST: usize = 600;

/// A straight piece of edge.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    /// Its ends, in mm.
    pub ends: [Point2<f64>; 2],
    /// Unit vector from the first to the second.
    pub along: Vector2<f64>,
    pub length: f64,
    /// Length that edges cover.
    pub covered: f64,
    /// Millimetres per scaled pixel across it.
    pub scale: f64,
}

/// The pieces, the longest first. `edges` are in the order of their chains.
pub(super) fn pieces(edges: &[GroundEdge]) -> Vec<Piece> {
    let mut found = Vec::new();
    let is_next = |a: &GroundEdge, b: &GroundEdge| (b.x - a.x).hypot(b.y - a.y) <= NEXT * a.length.max(b.length);
    for chain in edges.chunk_by(is_next) {
        split(chain, &mut found);
    }
    found.sort_by(|a, b| b.length.total_cmp(&a.length));
    found.truncate(2 * MOST);
    let mut joined = joined(&found);
    joined.sort_by(|a, b| b.length.total_cmp(&a.length));
    joined.truncate(MOST);
    joined
}

fn place(e: &GroundEdge) -> Point2<f64> {
    Point2::new(f64::from(e.x), f64::from(e.y))
}

/// Splits a chain where it is furthest from its chord, until what is left is straight (Ramer 1972).
fn split(chain: &[GroundEdge], found: &mut Vec<Piece>) {
    let mut open = vec![chain];
    while let Some(part) = open.pop() {
        let (Some(first), Some(last)) = (part.first(), part.last()) else { continue };
        if part.len() < LEAST_EDGES {
            continue;
        }
        let (a, chord) = (place(first), place(last) - place(first));
        let off = |e: &GroundEdge| {
            let to = place(e) - a;
            let off = chord.try_normalize(1e-9).map_or(to.norm(), |along| along.perp(&to).abs());
            off / f64::from(e.scale)
        };
        let furthest = part.iter().map(off).enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
        match furthest {
            Some((at, off)) if off > STRAIGHT_PX => {
                let (before, after) = part.split_at(at.clamp(1, part.len() - 1));
                open.extend([before, after]);
            }
            _ => found.extend(fitted(part)),
        }
    }
}

/// The line through edges, as long as they are.
#[expect(clippy::cast_precision_loss, reason = "edges")]
fn fitted(part: &[GroundEdge]) -> Option<Piece> {
    let count = part.len() as f64;
    let middle = part.iter().map(|e| place(e).coords).sum::<Vector2<f64>>() / count;
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for e in part {
        let d = place(e).coords - middle;
        (xx, xy, yy) = (xx + d.x * d.x, xy + d.x * d.y, yy + d.y * d.y);
    }
    let angle = 0.5 * (2.0 * xy).atan2(xx - yy);
    let along = Vector2::new(angle.cos(), angle.sin());
    let reach = part.iter().map(|e| along.dot(&(place(e).coords - middle)));
    let (low, high) = reach.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
    let length = high - low;
    let scale = part.iter().map(|e| f64::from(e.scale)).sum::<f64>() / count;
    let ends = [low, high].map(|t| Point2::from(middle + along * t));
    (length >= LEAST_MM).then_some(Piece { ends, along, length, covered: length, scale })
}

/// Pieces of one line become one.
fn joined(pieces: &[Piece]) -> Vec<Piece> {
    let mut used = vec![false; pieces.len()];
    let mut found = Vec::new();
    for first in 0..pieces.len() {
        if used[first] {
            continue;
        }
        used[first] = true;
        let mut whole = pieces[first];
        loop {
            let next = (first + 1..pieces.len()).find(|i| !used[*i] && is_of_one_line(&whole, &pieces[*i]));
            let Some(next) = next else { break };
            used[next] = true;
            whole = both(&whole, &pieces[next]);
        }
        found.push(whole);
    }
    found
}

fn is_of_one_line(whole: &Piece, other: &Piece) -> bool {
    if whole.along.perp(&other.along).abs() > SAME_SINE {
        return false;
    }
    let middle = nalgebra::center(&whole.ends[0], &whole.ends[1]);
    let px = SAME_PX * whole.scale.max(other.scale);
    let is_on = |end: &Point2<f64>| {
        let to = end - middle;
        whole.along.perp(&to).abs() <= px + SAME_SHARE * to.norm()
    };
    let reach = other.ends.map(|end| whole.along.dot(&(end - whole.ends[0])));
    let (low, high) = (reach[0].min(reach[1]), reach[0].max(reach[1]));
    let gap = (low - whole.length).max(-high);
    gap <= GAP_MM.max(GAP_SHARE * other.length.min(whole.length)) && other.ends.iter().all(is_on)
}

/// The line through both, weighed by what covers them.
fn both(a: &Piece, b: &Piece) -> Piece {
    let (w, v) = (a.covered, b.covered);
    let middles = [a, b].map(|p| nalgebra::center(&p.ends[0], &p.ends[1]).coords);
    let middle = (middles[0] * w + middles[1] * v) / (w + v);
    // Scatter of two uniform pieces: the directions by their own length, the line between them by its own.
    let other = if a.along.dot(&b.along) < 0.0 { -b.along } else { b.along };
    let mut between = middles[1] - middles[0];
    if between.dot(&a.along) < 0.0 {
        between = -between;
    }
    let spread = w * v / (w + v) * between.norm();
    let sum = a.along * (w * a.length * a.length / 12.0) + other * (v * b.length * b.length / 12.0) + between * spread;
    let along = sum.try_normalize(1e-9).unwrap_or(a.along);
    let reach = a.ends.iter().chain(&b.ends).map(|end| along.dot(&(end.coords - middle)));
    let (low, high) = reach.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), t| (l.min(t), h.max(t)));
    let ends = [low, high].map(|t| Point2::from(middle + along * t));
    Piece { ends, along, length: high - low, covered: w + v, scale: (a.scale * w + b.scale * v) / (w + v) }
}
