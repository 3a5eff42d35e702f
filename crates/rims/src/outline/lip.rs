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
use super::rings::{Edge, Moved, at_px, odds};
use crate::circles::Arc;

/// Edges are looked for within these shares of the radius, inward and outward ...
const INWARD: f64 = 0.06;
const OUTWARD: f64 = 0.08;
/// ... but not further outward than this, in mm on Z = 0: lips are not thicker.
const THICKEST_MM: f64 = 11.0;
/// Pictures of many pixels are looked at in steps of this many pixels of the reduced scale: their lenses resolve no more.
const UNIT: f64 = 0.5;
/// What chance makes is counted from and to so many pixels further out.
const TABLE_PX: (f64, f64) = (2.5, 16.0);
/// Edges within this many pixels of a circle are along it.
const ALONG_PX: f64 = 1.0;
/// Pixels between the circles that fits start from, and how near an edge must be from fit to fit.
const STEP_PX: f64 = 1.0;
const WIDTHS_PX: [f64; 4] = [2.5, 1.8, 1.3, 1.1];
/// A centre moves by so many pixels at most, or by this share of the radius: edges of a rim share an axis.
const MOST_MOVED: (f64, f64) = (4.0, 0.04);
/// Fits that differ by less, in pixels, are the same; narrower rings tell nothing.
const SAME_PX: f64 = 0.4;
const NARROWEST_PX: f64 = 1.0;
/// Fewer directions with an edge fix no circle.
const LEAST_DIRECTIONS: usize = 20;
/// A rim's outer edge is seen in this share of the directions that show any, and this share as well as the best edge.
const SEEN: f64 = 0.35;
const AS_SEEN: f64 = 0.4;
/// Odds (logarithm) beyond this count as this.
const MOST_ODDS: f64 = 3.0;
/// Round circles are taken if the best of them is seen in so much more of the directions than the best oval one.
const BETTER_SEEN: f64 = 0.05;

/// The edge of a rim, and how well the circle is seen that is seen best.
#[derive(Clone, Copy)]
struct Outer {
    edge: Edge,
    best_seen: f64,
}

/// The same circle moved to the outer edge of the rim; as it was where none is clear.
pub(crate) fn outer_edge(picture: &Picture, view: &View, arc: Arc, factor: usize) -> Arc {
    #[expect(clippy::cast_precision_loss, reason = "a small factor")]
    let (unit_px, full_px) = ((UNIT * factor as f64).max(1.0), arc.perimeter_px * factor as f64);
    let px_mm = unit_px * std::f64::consts::TAU * arc.disc.radius / full_px.max(1.0);
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

/// The outer edge of the rim near a circle.
fn best_edge(picture: &Picture, view: &View, arc: &Arc, px_mm: f64) -> Option<Outer> {
    let radius_px = arc.disc.radius / px_mm;
    let furthest_px = (OUTWARD * radius_px).min(THICKEST_MM / px_mm);
    // A little more on both sides, for centres that move, and the rings' surroundings.
    let (inward_px, outward_px) = (1.5 * INWARD * radius_px + 4.0, furthest_px + TABLE_PX.1 + 4.0);
    let rays = rays(picture, view, arc, Span { inward_px, outward_px, px_mm });
    let edges = edges(&rays, radius_px, furthest_px);
    let best_seen = edges.iter().map(|edge| edge.seen).fold(0.0, f64::max);
    let edges: Vec<Edge> = edges.into_iter().filter(|edge| edge.seen >= SEEN.max(AS_SEEN * best_seen)).collect();
    likeliest(&rays, &edges).map(|edge| Outer { edge, best_seen })
}

/// All circles that edges lie along.
fn edges(rays: &[Ray], radius_px: f64, furthest_px: f64) -> Vec<Edge> {
    let showing = rays.iter().filter(|ray| !ray.edges_px.is_empty()).count();
    if showing < LEAST_DIRECTIONS {
        return Vec::new();
    }
    let most_moved = MOST_MOVED.0.max(MOST_MOVED.1 * radius_px);
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
    let chance =
        (0..10).map(|i| share(TABLE_PX.0 + (TABLE_PX.1 - TABLE_PX.0) * f64::from(i) / 9.0)).sum::<f64>() / 10.0;
    (share(0.0) - chance) / (1.0 - chance).max(0.05)
}

/// The edge that is the rim's against the others, on the mean.
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
