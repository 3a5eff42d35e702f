//! Rectangles that straight pieces may be the sides of: from corners, and from pairs of corners across.

use nalgebra::{Matrix2, Point2, Vector2};

use super::pieces::Piece;
use super::quad::Quad;

/// Sides of a corner stand at right angles within this sine (7 degrees: the pose may be wrong).
const RIGHT_ANGLE: f64 = 0.12;
/// A side ends at the corner: it reaches no further beyond it than this (mm, scaled pixels) ...
const BEYOND_MM: f64 = 3.0;
const BEYOND_PX: f64 = 3.0;
/// ... and no less than this (mm), or this share of its length: corners are rounded, or hidden.
const SHORT_MM: f64 = 40.0;
const SHORT_SHARE: f64 = 0.6;
/// As many corners, those of the longest pieces, are paired.
const MOST_CORNERS: usize = 400;
/// Sides that are looked for on the plane Z = 0, in mm, and the longest in proportion to the other.
pub(super) const SIDES_MM: [f64; 2] = [60.0, 450.0];
pub(super) const LONGEST: f64 = 2.8;
/// Sides across from a corner are parallel to its own within this sine ...
const PARALLEL: f64 = 0.12;
/// ... and pieces are of one side if they are as near to each other (mm).
const ONE_SIDE_MM: f64 = 4.0;
/// As many places are tried for each of the two sides across, and as many rectangles of one corner.
const MOST_ACROSS: usize = 8;
const MOST_OF_CORNER: usize = 6;
/// A side that goes on beyond its corner is a table's line: looked for so far beyond, in mm.
const BEYOND_CORNER_MM: [f64; 2] = [6.0, 32.0];
/// Of each side, pieces cover this share, and of all four this mean.
const LEAST_OF_SIDE: f64 = 0.15;
const LEAST_OF_ALL: f64 = 0.4;
/// As many rectangles are looked at closely.
const MOST_QUADS: usize = 160;
/// Rectangles are the same if their corners are nearer than this share of half the way across.
const SAME: f64 = 0.03;

/// Two pieces that end where they meet.
struct Corner {
    at: Point2<f64>,
    /// Along the sides away from the corner; the second is the first turned to the left.
    sides: [Vector2<f64>; 2],
    /// The shorter of what edges cover of both, in mm.
    held: f64,
}

/// A piece parallel to a side of a corner: its distance from that, where it begins and ends along it (mm from the corner), and
/// the share of its length that edges cover.
struct Beside {
    away: f64,
    span: [f64; 2],
    share: f64,
}

/// Likely rectangles, the best covered first.
pub(super) fn quads(pieces: &[Piece]) -> Vec<Quad> {
    let mut found: Vec<(f64, Quad)> = corners(pieces).iter().flat_map(|corner| completed(corner, pieces)).collect();
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut distinct: Vec<Quad> = Vec::new();
    for (_, quad) in found {
        if distinct.len() >= MOST_QUADS {
            break;
        }
        if !distinct.iter().any(|other| quad.apart(other) < SAME * quad.reach()) {
            distinct.push(quad);
        }
    }
    distinct
}

fn corners(pieces: &[Piece]) -> Vec<Corner> {
    let mut found: Vec<Corner> = Vec::new();
    for (i, a) in pieces.iter().enumerate() {
        found.extend(pieces[i + 1..].iter().filter_map(|b| corner(a, b)));
    }
    found.sort_by(|a, b| b.held.total_cmp(&a.held));
    found.truncate(MOST_CORNERS);
    found
}

fn corner(a: &Piece, b: &Piece) -> Option<Corner> {
    if a.along.dot(&b.along).abs() > RIGHT_ANGLE {
        return None;
    }
    let solved = Matrix2::from_columns(&[a.along, -b.along]).try_inverse()? * (b.ends[0] - a.ends[0]);
    let at = a.ends[0] + a.along * solved.x;
    let (one, two) = (from_corner(a, solved.x)?, from_corner(b, solved.y)?);
    let is_left = one.perp(&two) > 0.0;
    let (first, second) = if is_left { (one, two) } else { (two, one) };
    Some(Corner { at, sides: [first, second], held: a.covered.min(b.covered) })
}

/// The direction of a piece away from a corner that lies `at` mm from its first end along it; none where it does not end there.
fn from_corner(piece: &Piece, at: f64) -> Option<Vector2<f64>> {
    let (short, beyond) = (SHORT_MM.max(SHORT_SHARE * piece.length), BEYOND_MM.max(BEYOND_PX * piece.scale));
    let ends = -beyond..=short;
    if ends.contains(&-at) {
        Some(piece.along)
    } else if ends.contains(&(at - piece.length)) {
        Some(-piece.along)
    } else {
        None
    }
}

/// The rectangles that have a corner and a side across from each of its own, the best covered first.
fn completed(corner: &Corner, pieces: &[Piece]) -> Vec<(f64, Quad)> {
    let [one, two] = [0, 1].map(|k| beside(corner, k, pieces));
    let (wide, high) = (likely(&one), likely(&two));
    let mut found = Vec::new();
    for &w in &wide {
        for &h in high.iter().filter(|h| w.max(**h) <= LONGEST * w.min(**h)) {
            let sides = [held(&two, 0.0, w), held(&one, w, h), held(&two, h, w), held(&one, 0.0, h)];
            let covered = sides.iter().map(|side| side.0).sum::<f64>() / 4.0;
            let beyond = sides.iter().map(|side| side.1).sum::<f64>() / 4.0;
            if covered < LEAST_OF_ALL || sides.iter().any(|side| side.0 < LEAST_OF_SIDE) {
                continue;
            }
            let (along, up) = (corner.sides[0] * w, corner.sides[1] * h);
            let corners = [corner.at, corner.at + along, corner.at + along + up, corner.at + up];
            found.push((covered - beyond, Quad { corners }));
        }
    }
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    found.truncate(MOST_OF_CORNER);
    found
}

/// Pieces parallel to one side of a corner, at their distance from it along the other side, `k`.
fn beside(corner: &Corner, k: usize, pieces: &[Piece]) -> Vec<Beside> {
    let (along, own) = (corner.sides[k], corner.sides[1 - k]);
    let parallel = pieces.iter().filter(|piece| piece.along.perp(&own).abs() < PARALLEL);
    let placed = parallel.filter_map(|piece| {
        let ends = piece.ends.map(|end| own.dot(&(end - corner.at)));
        let away = along.dot(&(nalgebra::center(&piece.ends[0], &piece.ends[1]) - corner.at));
        let span = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        let is_within =
            away > -ONE_SIDE_MM && away < SIDES_MM[1] && span[1] > -BEYOND_CORNER_MM[1] && span[0] < SIDES_MM[1];
        is_within.then_some(Beside { away, span, share: piece.covered / piece.length })
    });
    placed.collect()
}

/// Distances at which most is covered.
fn likely(beside: &[Beside]) -> Vec<f64> {
    let length = |b: &Beside| (b.span[1] - b.span[0].max(0.0)).max(0.0) * b.share;
    let near = |away: f64| beside.iter().filter(move |b| (b.away - away).abs() < ONE_SIDE_MM);
    let across = beside.iter().filter(|b| b.away >= SIDES_MM[0]);
    let mut sums: Vec<(f64, f64)> = across.map(|a| (near(a.away).map(length).sum::<f64>(), a.away)).collect();
    sums.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.total_cmp(&b.1)));
    let mut found: Vec<f64> = Vec::new();
    for (_, away) in sums {
        if found.len() < MOST_ACROSS && found.iter().all(|other| (other - away).abs() >= ONE_SIDE_MM) {
            found.push(away);
        }
    }
    found
}

/// Shares that pieces cover of a side at a distance that is so long, and of where it would go on beyond its corners.
fn held(beside: &[Beside], away: f64, length: f64) -> (f64, f64) {
    let overlap = |b: &Beside, from: f64, to: f64| (b.span[1].min(to) - b.span[0].max(from)).max(0.0) * b.share;
    let [near, far] = BEYOND_CORNER_MM;
    let (mut held, mut beyond) = (0.0, 0.0);
    for b in beside.iter().filter(|b| (b.away - away).abs() < ONE_SIDE_MM) {
        held += overlap(b, 0.0, length);
        beyond += overlap(b, -far, -near) + overlap(b, length + near, length + far);
    }
    ((held / length).min(1.0), (beyond / (2.0 * (far - near))).min(1.0))
}
