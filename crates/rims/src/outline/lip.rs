//! From a circle near the rim to the rim's outer edge, in the full picture.
//!
//! A rim has a thickness, often a printed ring, and an inner edge with a highlight along it, which may be stronger than the
//! outer edge; outside it lie edges of shadows and of the table. All circles near the one found are listed that edges lie
//! along; of any two, what lies between them tells which one is the rim's ([`rings`](super::rings)).
//!
//! The circle found may look oval for an error of the pose; but where it was fitted to inner edges here and outer ones there,
//! it looks oval for that alone, and follows neither. So round circles are tried as well.

use ingest::Picture;
use model::View;
use nalgebra::{Matrix3, Vector3};

use super::rays::{Ray, Span, rays};
use super::rings::{Edge, Moved, at_px, features, odds};
use crate::circles::Arc;
use crate::weights::RING_FEATURES;

/// Edges are looked for so far inward and outward of the circle, as shares of its radius.
const INWARD: f64 = 0.06;
const OUTWARD: f64 = 0.08;
/// Edges are not looked for further outward than this, in mm on Z = 0: lips are not thicker.
const THICKEST_MM: f64 = 11.0;
/// Pictures of many pixels are looked at in steps of this many pixels of the reduced scale: their lenses resolve no more.
const UNIT: f64 = 0.5;
/// The share that chance gives is counted on circles further out: the nearest one is so many pixels away.
const NEAREST_TABLE_PX: f64 = 2.5;
/// The furthest circle on which chance is counted is so many pixels away.
const FURTHEST_TABLE_PX: f64 = 16.0;
/// Edges within this many pixels of a circle are along it.
const ALONG_PX: f64 = 1.0;
/// Pixels between the circles that fits start from, and how near an edge must be from fit to fit.
const STEP_PX: f64 = 1.0;
const WIDTHS_PX: [f64; 4] = [2.5, 1.8, 1.3, 1.1];
/// A centre moves by so many pixels at most, or by [`MOST_MOVED_SHARE`] where that is more: edges of a rim share an axis.
const MOST_MOVED_PX: f64 = 4.0;
/// A centre moves by this share of the radius at most, likewise.
const MOST_MOVED_SHARE: f64 = 0.04;
/// Fits that differ by less, in pixels, are the same; narrower rings tell nothing.
const SAME_PX: f64 = 0.4;
const NARROWEST_PX: f64 = 1.0;
/// Fewer directions with an edge fix no circle.
const LEAST_DIRECTIONS: usize = 20;
/// A rim's outer edge is seen in this share of the directions that show any, and this share as well as the best edge.
const SEEN: f64 = 0.35;
const AS_SEEN: f64 = 0.4;
/// Logarithms of odds are held between minus this and this, so that no single pair decides.
const MOST_ODDS: f64 = 3.0;
/// Round circles are taken if the best of them is seen in so much more of the directions than the best oval one.
const BETTER_SEEN: f64 = 0.05;

/// The edge of a rim, and how well the circle is seen that is seen best.
#[derive(Clone, Copy)]
struct Outer {
    edge: Edge,
    best_seen: f64,
}

/// Returns the circle moved to the outer edge of the rim, or as it was where no outer edge is clear.
pub(crate) fn outer_edge(picture: &Picture, view: &View, arc: Arc, factor: usize) -> Arc {
    let px_mm = px_mm(&arc, factor);
    let round = Arc { oval: [0.0; 2], ..arc.clone() };
    let of_round = best_edge(picture, view, &round, px_mm);
    let move_to = |from: Arc, outer: Outer| shifted(from, outer.edge.moved * px_mm);
    match (of_round, best_edge(picture, view, &arc, px_mm)) {
        (Some(outer), Some(oval)) if oval.best_seen > outer.best_seen - BETTER_SEEN => move_to(arc, oval),
        (Some(outer), _) => move_to(round, outer),
        (None, Some(oval)) => move_to(arc, oval),
        (None, None) => arc,
    }
}

/// The length on the plane Z = 0, in mm, of the unit in which a circle's surroundings are looked at.
fn px_mm(arc: &Arc, factor: usize) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "a small factor")]
    let (unit_px, full_px) = ((UNIT * factor as f64).max(1.0), arc.perimeter_px * factor as f64);
    unit_px * std::f64::consts::TAU * arc.disc.radius / full_px.max(1.0)
}

/// The outer edge of the rim near a circle.
fn best_edge(picture: &Picture, view: &View, arc: &Arc, px_mm: f64) -> Option<Outer> {
    let Candidates { rays, edges, best_seen } = candidates(picture, view, arc, px_mm);
    likeliest(&rays, &edges).map(|edge| Outer { edge, best_seen })
}

/// The edges near a circle that may be the rim's, and the rays across them.
struct Candidates {
    rays: Vec<Ray>,
    edges: Vec<Edge>,
    /// Share of the directions that show the edge that is seen best.
    best_seen: f64,
}

fn candidates(picture: &Picture, view: &View, arc: &Arc, px_mm: f64) -> Candidates {
    let radius_px = arc.disc.radius / px_mm;
    let furthest_px = (OUTWARD * radius_px).min(THICKEST_MM / px_mm);
    // A little more on both sides, for centres that move, and the rings' surroundings.
    let (inward_px, outward_px) = (1.5 * INWARD * radius_px + 4.0, furthest_px + FURTHEST_TABLE_PX + 4.0);
    let rays = rays(picture, view, arc, Span { inward_px, outward_px, px_mm });
    let edges = edges(&rays, radius_px, furthest_px);
    let best_seen = edges.iter().map(|edge| edge.seen).fold(0.0, f64::max);
    let edges: Vec<Edge> = edges.into_iter().filter(|edge| edge.seen >= SEEN.max(AS_SEEN * best_seen)).collect();
    Candidates { rays, edges, best_seen }
}

/// Two edges about one centre of which either may be the outer edge of a rim.
#[derive(Debug, Clone, PartialEq)]
pub struct RingPair {
    /// Centre (world X, Y) and radius of the inner edge on the plane Z = 0, in mm.
    pub inner_mm: ([f64; 2], f64),
    /// Centre and radius of the outer edge, likewise.
    pub outer_mm: ([f64; 2], f64),
    /// The features by which the pair is judged, in the order of the set `ring` of weights.toml.
    pub features: [f64; RING_FEATURES],
}

/// All pairs of edges near a round circle that are held against each other.
pub(crate) fn pairs(picture: &Picture, view: &View, arc: &Arc, factor: usize) -> Vec<RingPair> {
    let px_mm = px_mm(arc, factor);
    let round = Arc { oval: [0.0; 2], ..arc.clone() };
    let Candidates { rays, mut edges, .. } = candidates(picture, view, &round, px_mm);
    edges.sort_by(|a, b| a.moved.z.total_cmp(&b.moved.z));
    let circle = |edge: &Edge| {
        let disc = shifted(round.clone(), edge.moved * px_mm).disc;
        ([disc.x, disc.y], disc.radius)
    };
    let mut pairs = Vec::new();
    for (at, inner) in edges.iter().enumerate() {
        for outer in edges[at + 1..].iter().filter(|outer| outer.moved.z - inner.moved.z > NARROWEST_PX) {
            pairs.extend(features(&rays, inner, outer).map(|features| RingPair {
                inner_mm: circle(inner),
                outer_mm: circle(outer),
                features,
            }));
        }
    }
    pairs
}

/// All circles that edges lie along.
fn edges(rays: &[Ray], radius_px: f64, furthest_px: f64) -> Vec<Edge> {
    let showing = rays.iter().filter(|ray| !ray.edges_px.is_empty()).count();
    if showing < LEAST_DIRECTIONS {
        return Vec::new();
    }
    let most_moved = MOST_MOVED_PX.max(MOST_MOVED_SHARE * radius_px);
    let mut found: Vec<Edge> = Vec::new();
    let mut start = -INWARD * radius_px;
    while start <= furthest_px {
        let fitted = fit(rays, start);
        start += STEP_PX;
        let Some(moved) = fitted else { continue };
        let is_near = moved.xy().norm() <= most_moved
            && (-1.5 * INWARD * radius_px..=furthest_px + 1.0).contains(&moved.z)
            && found.iter().all(|other| (other.moved - moved).amax() >= SAME_PX);
        if is_near {
            found.push(Edge { moved, seen: seen(rays, &moved, showing) });
        }
    }
    found
}

/// Share of the directions that show an edge along a circle, less what chance makes a little further out.
#[expect(clippy::cast_precision_loss, reason = "directions")]
fn seen(rays: &[Ray], moved: &Moved, showing: usize) -> f64 {
    let share = |further_px: f64| {
        let is_along = |ray: &&Ray| ray.nearest(at_px(ray, moved) + further_px).is_some_and(|off| off.abs() < ALONG_PX);
        rays.iter().filter(is_along).count() as f64 / showing as f64
    };
    let chance = (0..10)
        .map(|i| share(NEAREST_TABLE_PX + (FURTHEST_TABLE_PX - NEAREST_TABLE_PX) * f64::from(i) / 9.0))
        .sum::<f64>()
        / 10.0;
    (share(0.0) - chance) / (1.0 - chance).max(0.05)
}

/// The edge that is the likeliest one of the rim, by the mean of its odds against the others.
fn likeliest(rays: &[Ray], edges: &[Edge]) -> Option<Edge> {
    let against = |a: &Edge, b: &Edge| {
        let (inner, outer, sign) = if a.moved.z < b.moved.z { (a, b, -1.0) } else { (b, a, 1.0) };
        if outer.moved.z - inner.moved.z <= NARROWEST_PX {
            return None;
        }
        odds(rays, inner, outer).map(|odds| sign * odds.clamp(-MOST_ODDS, MOST_ODDS))
    };
    #[expect(clippy::cast_precision_loss, reason = "a few edges")]
    let score = |(at, edge): (usize, &Edge)| {
        let others = edges.iter().enumerate().filter(|(other, _)| *other != at);
        let odds: Vec<f64> = others.filter_map(|(_, other)| against(edge, other)).collect();
        // An edge that cannot be held against any other one is only taken where there is no other one.
        let mean = if odds.is_empty() { -2.0 * MOST_ODDS } else { odds.iter().sum::<f64>() / odds.len() as f64 };
        (mean, edge.seen)
    };
    let scored = edges.iter().enumerate().map(|edge| (score(edge), edge.1));
    scored.max_by(|(a, _), (b, _)| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))).map(|(_, edge)| *edge)
}

/// The circle that edges about `start` pixels outside the first one lie along: robust least squares.
fn fit(rays: &[Ray], start: f64) -> Option<Moved> {
    let mut moved = Vector3::new(0.0, 0.0, start);
    for width_px in WIDTHS_PX {
        let (mut normal, mut right, mut count) = (Matrix3::zeros(), Vector3::zeros(), 0_usize);
        for ray in rays {
            let row = Vector3::new(ray.unit[0], ray.unit[1], 1.0);
            let Some(left) = ray.nearest(row.dot(&moved)) else { continue };
            let share = left / width_px;
            if share.abs() < 1.0 {
                let weight = (1.0 - share * share).powi(2);
                normal += weight * row * row.transpose();
                right += weight * left * row;
                count += 1;
            }
        }
        if count < LEAST_DIRECTIONS {
            return None;
        }
        moved += normal.cholesky()?.solve(&right);
    }
    Some(moved)
}

/// A circle moved, in mm.
fn shifted(arc: Arc, moved: Moved) -> Arc {
    let ratio = 1.0 + moved.z / arc.disc.radius;
    let mut arc = arc.scaled(ratio);
    (arc.disc.x, arc.disc.y) = (arc.disc.x + moved.x, arc.disc.y + moved.y);
    arc.perimeter_px *= ratio;
    arc
}

#[cfg(test)]
mod tests;
