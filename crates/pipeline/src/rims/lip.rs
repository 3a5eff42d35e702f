//! From a circle near the rim to the rim's outer edge, in the full picture.
//!
//! A rim has a thickness, often a printed ring, and an inner edge with a highlight along it, which may be stronger than the
//! outer edge. What is wanted is the outer one: the last edge about the centre before the table begins. Towards the wearer
//! the rim is seen against its own wall, where edges further out are the wall's, the foot's or a shadow's: so that third does
//! not choose the edge, and is not used for the fit.

use ingest::Picture;
use model::View;
use nalgebra::{Matrix3, Point2, Point3, Vector3};

use super::arcs::Arc;
use super::refine::colour;

/// Directions that are looked at.
const DIRECTIONS: u32 = 120;
/// Edges are looked for within these shares of the radius, inward and outward ...
const INWARD: f64 = 0.06;
const OUTWARD: f64 = 0.08;
/// ... but not further outward than this, in mm on Z = 0: lips are not thicker.
const THICKEST_MM: f64 = 11.0;
/// Pixels between samples, and half of what a change is taken over.
const STEP_PX: f64 = 0.5;
const HALF: usize = 2;
/// An edge changes by at least so many levels, and by this share of the strongest one in its direction.
const LEAST_LEVELS: f64 = 5.0;
const LEAST_SHARE: f64 = 0.15;
/// The table's own edges are counted from and to so many pixels further out.
const TABLE_PX: (f64, f64) = (2.5, 16.0);
/// The far edge of the wearer's third: cosine against the direction away from the wearer.
const NEAR_THIRD: f64 = -0.5;
/// The outer edge is seen in this share of the directions that show any, and in this share of those of the best edge.
const SEEN: f64 = 0.45;
const AS_SEEN: f64 = 0.6;
/// Edges within this many pixels of a circle are along it.
const ALONG_PX: f64 = 1.1;
/// Fewer directions with an edge fix no circle.
const LEAST_DIRECTIONS: usize = 24;

/// The edges in one direction: cosine and sine of its angle, and how far outside the circle they are, in mm on Z = 0.
struct Ray {
    unit: [f64; 2],
    off_mm: Vec<f64>,
}

/// The same circle moved to the outer edge of the rim; as it was where none is clear.
pub(super) fn outer_edge(picture: &Picture, view: &View, arc: Arc, factor: usize) -> Arc {
    let mut best = arc;
    for _ in 0..2 {
        let px_mm = std::f64::consts::TAU * best.disc.radius / (best.perimeter_px * factor as f64).max(1.0);
        let rays = rays(picture, view, &best, px_mm);
        let Some(off_mm) = outermost(&rays, px_mm, best.disc.radius) else { return best };
        let Some(moved) = fit(&rays, off_mm, px_mm) else { return best };
        best = shifted(best, moved);
    }
    best
}

fn rays(picture: &Picture, view: &View, arc: &Arc, px_mm: f64) -> Vec<Ray> {
    let away = arc.disc.y.atan2(arc.disc.x);
    // Seen from steeply above, no side is hidden.
    let steep = arc.disc.x.hypot(arc.disc.y) < arc.disc.radius;
    let directions = (0..DIRECTIONS).map(|i| f64::from(i) / f64::from(DIRECTIONS) * std::f64::consts::TAU);
    directions
        .filter(|angle| steep || (angle - away).cos() > NEAR_THIRD)
        .map(|angle| Ray { unit: [angle.cos(), angle.sin()], off_mm: edges(picture, view, arc, angle, px_mm) })
        .collect()
}

/// Where brightness or colour changes fastest along one direction.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "samples")]
fn edges(picture: &Picture, view: &View, arc: &Arc, angle: f64, px_mm: f64) -> Vec<f64> {
    let step_mm = STEP_PX * px_mm;
    let inward = (INWARD * arc.disc.radius / step_mm) as usize + HALF + 1;
    let outward = (furthest_mm(arc.disc.radius) / step_mm + TABLE_PX.1 / STEP_PX) as usize + HALF + 1;
    let radius = {
        let [x, y] = arc.at(angle);
        (x - arc.disc.x).hypot(y - arc.disc.y)
    };
    let off = |i: usize| (i as f64 - inward as f64) * step_mm;
    // The mean of five places along the rim, a pixel and a half apart, or less on a small one.
    let apart_mm = (1.5 * px_mm).min(0.015 * radius);
    let lines = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|beside| {
        let (sin, cos) = (angle + beside * apart_mm / radius).sin_cos();
        Line::new((inward + outward) / Line::EVERY + 1, |node| {
            let r = radius + off(node * Line::EVERY);
            view.pixel_of(Point3::new(arc.disc.x + r * cos, arc.disc.y + r * sin, 0.0)).ok()
        })
    });
    let sample = |i: usize| -> Option<[f64; 3]> {
        let mut sum = [0.0; 3];
        for line in &lines {
            let c = colour(picture, line.at(i)?)?;
            sum = [0, 1, 2].map(|k| sum[k] + c[k] / 5.0);
        }
        Some(sum)
    };
    let samples: Vec<Option<[f64; 3]>> = (0..=inward + outward).map(sample).collect();
    let change = |i: usize| match (samples[i - HALF], samples[i + HALF]) {
        (Some(a), Some(b)) => a.iter().zip(b).map(|(a, b)| (b - a).abs()).fold(0.0, f64::max),
        _ => 0.0,
    };
    let changes: Vec<f64> = (HALF..samples.len() - HALF).map(change).collect();
    let least = LEAST_LEVELS.max(LEAST_SHARE * changes.iter().copied().fold(0.0, f64::max));
    let is_edge = |i: &usize| changes[*i] > changes[i - 1] && changes[*i] >= changes[i + 1] && changes[*i] >= least;
    (1..changes.len() - 1)
        .filter(is_edge)
        .map(|i| {
            let (before, at, after) = (changes[i - 1], changes[i], changes[i + 1]);
            off(i + HALF) + 0.5 * (before - after) / (before - 2.0 * at + after) * step_mm
        })
        .collect()
}

/// Samples along a line: lenses bend slowly, so only every few of them are projected.
struct Line(Vec<Option<Point2<f64>>>);

impl Line {
    /// Samples from one that is projected to the next: four pixels.
    const EVERY: usize = 8;

    fn new(last: usize, pixel_of: impl Fn(usize) -> Option<Point2<f64>>) -> Self {
        Self((0..=last).map(pixel_of).collect())
    }

    fn at(&self, sample: usize) -> Option<Point2<f64>> {
        let (from, to) = (self.0[sample / Self::EVERY]?, self.0[sample / Self::EVERY + 1]?);
        #[expect(clippy::cast_precision_loss, reason = "a few samples")]
        let share = (sample % Self::EVERY) as f64 / Self::EVERY as f64;
        Some(from + (to - from) * share)
    }
}

/// How far outside the circle the outermost one is that edges lie along in enough directions.
fn outermost(rays: &[Ray], px_mm: f64, radius_mm: f64) -> Option<f64> {
    let showing = rays.iter().filter(|ray| !ray.off_mm.is_empty()).count();
    if showing < LEAST_DIRECTIONS {
        return None;
    }
    let is_along = |ray: &Ray, at: f64| nearest(ray, at).is_some_and(|off| off.abs() < ALONG_PX * px_mm);
    #[expect(clippy::cast_precision_loss, reason = "directions")]
    let share = |at: f64| rays.iter().filter(|ray| is_along(ray, at)).count() as f64 / showing as f64;
    let mut tried = Vec::new();
    let mut at = -INWARD * radius_mm;
    while at <= furthest_mm(radius_mm) {
        let by_chance: Vec<f64> = (0..10)
            .map(|i| TABLE_PX.0 + (TABLE_PX.1 - TABLE_PX.0) * f64::from(i) / 9.0)
            .map(|further_px| share(at + further_px * px_mm))
            .collect();
        let chance = by_chance.iter().sum::<f64>() / 10.0;
        tried.push((at, (share(at) - chance) / (1.0 - chance).max(0.05)));
        at += 0.25 * px_mm;
    }
    let most = tried.iter().map(|(_, seen)| *seen).fold(0.0, f64::max);
    let needed = SEEN.max(AS_SEEN * most);
    let last = tried.iter().rposition(|(_, seen)| *seen >= needed)?;
    // From the outer slope of the peak to its top.
    let reach = (2.0 * ALONG_PX / 0.25) as usize;
    tried[last.saturating_sub(reach)..=last].iter().max_by(|a, b| a.1.total_cmp(&b.1)).map(|(at, _)| *at)
}

fn furthest_mm(radius_mm: f64) -> f64 {
    (OUTWARD * radius_mm).min(THICKEST_MM)
}

/// Distance of a direction's edge that is nearest to a circle, outside it.
fn nearest(ray: &Ray, at: f64) -> Option<f64> {
    ray.off_mm.iter().map(|off| off - at).min_by(|a, b| a.abs().total_cmp(&b.abs()))
}

/// Centre and radius by which the circle moves to the edges about `off_mm` outside it: robust least squares.
fn fit(rays: &[Ray], off_mm: f64, px_mm: f64) -> Option<Vector3<f64>> {
    let mut moved = Vector3::new(0.0, 0.0, off_mm);
    for width_px in [2.5, 1.8, 1.3, 1.3] {
        let (mut normal, mut right, mut count) = (Matrix3::zeros(), Vector3::zeros(), 0_usize);
        for ray in rays {
            let row = Vector3::new(ray.unit[0], ray.unit[1], 1.0);
            let Some(left) = nearest(ray, row.dot(&moved)) else { continue };
            let share = left / (width_px * px_mm);
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

fn shifted(arc: Arc, moved: Vector3<f64>) -> Arc {
    let ratio = 1.0 + moved.z / arc.disc.radius;
    let mut arc = arc.scaled(ratio);
    (arc.disc.x, arc.disc.y) = (arc.disc.x + moved.x, arc.disc.y + moved.y);
    arc.perimeter_px *= ratio;
    arc
}
