//! Sides of a rectangle followed through the full picture.

use ingest::Picture;
use model::View;
use nalgebra::{Point2, Point3, Vector2};

use super::quad::{Quad, Side, Straight};
use crate::colour::colour;

/// Pixels between places where a side is looked for, and how many there are at least and at most.
const SPACING_PX: f64 = 4.0;
const PLACES: (f64, f64) = (16.0, 48.0);
/// Shares of a side next to its corners, which may be rounded, are left out.
const CORNER_SHARE: f64 = 0.1;
/// The edge lies within this many scaled pixels of the side ...
const REACH_PX: f64 = 1.5;
/// ... and has this share of the median edge's strength.
const LEAST_STRENGTH: f64 = 0.3;
/// Samples per pixel of a profile.
const SAMPLES: f64 = 2.0;
/// Fewer places do not hold a side.
const LEAST_PLACES: usize = 6;
/// Steps of robust least squares, and where it gives a place no weight: in pixels of the reduced scale.
const STEPS: u32 = 4;
const ASTRAY_PX: f64 = 1.2;

/// Colours beside a side are taken so many pixels of the reduced scale from it.
const BESIDE_PX: f64 = 3.0;
/// Levels that are added to both of two colours before they are compared as a ratio: what is nearly black tells none.
const BLACK: f64 = 8.0;

/// An edge across a side.
struct Found {
    /// Along the side as a share of it, and out of it in mm on Z = 0.
    place: (f64, f64),
    strength: f64,
    sharp: f64,
    /// Colours out of the rectangle and within it.
    beside: [[f64; 3]; 2],
}

/// What a picture shows along a side.
#[derive(Debug, Clone, Copy)]
struct Along {
    sharp: f64,
    rough_in: f64,
    rough_out: f64,
    unlike: f64,
}

/// A rectangle in the full picture.
pub(super) struct Followed {
    pub quad: Quad,
    /// Share of the change across a side that happens within a pixel, of that within three (reduced scale): median along the
    /// side, and of the sides the least. A side that is a shadow's border is soft.
    pub sharp: f64,
    /// How much the colour changes from place to place just within a side, in levels: of the sides the most.
    pub rough_in: f64,
    /// The same just out of a side: their mean.
    pub rough_out: f64,
    /// How far what lies within a side is from a shadow of what lies out of it, of the sides the least: the difference between
    /// the colours' ratios, and how much brighter it is (logarithms).
    pub unlike: f64,
}

/// The sides as the full picture has them; none where too little is seen of one of them.
pub(super) fn follow(picture: &Picture, view: &View, quad: &Quad, factor: f64) -> Option<Followed> {
    let (mut lines, mut sides) = (Vec::new(), Vec::new());
    for side in quad.sides() {
        let (line, along) = line(picture, view, &side, factor)?;
        lines.push(line);
        sides.push(along);
    }
    let &[a, b, c, d] = lines.as_slice() else { return None };
    let quad = Quad::of_lines(&[a, b, c, d]).filter(Quad::is_convex)?;
    let least = |of: fn(&Along) -> f64| sides.iter().map(of).fold(f64::INFINITY, f64::min);
    Some(Followed {
        quad,
        sharp: least(|a| a.sharp),
        rough_in: sides.iter().map(|a| a.rough_in).fold(0.0, f64::max),
        rough_out: sides.iter().map(|a| a.rough_out).sum::<f64>() / 4.0,
        unlike: least(|a| a.unlike),
    })
}

/// A side's line, and how sharp the edges along it are.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "places")]
fn line(picture: &Picture, view: &View, side: &Side, factor: f64) -> Option<(Straight, Along)> {
    let pixel = |p: Point2<f64>| view.pixel_of(Point3::new(p.x, p.y, 0.0)).ok();
    let at = |share: f64| side.from + side.along * (share * side.length);
    let length_px = (pixel(at(1.0))? - pixel(at(0.0))?).norm();
    let count = (length_px / SPACING_PX).clamp(PLACES.0, PLACES.1) as usize;
    let share = |i: usize| CORNER_SHARE + (1.0 - 2.0 * CORNER_SHARE) * (i as f64 + 0.5) / count as f64;
    let mut found: Vec<Found> = (0..count)
        .filter_map(|i| {
            let (here, beside) = (pixel(at(share(i)))?, pixel(at(share(i)) + side.along)?);
            across(picture, view, side, here, (beside - here).try_normalize(1e-9)?, factor)
        })
        .collect();
    let strength = middle(&mut found.iter().map(|f| f.strength).collect::<Vec<_>>())?;
    found.retain(|f| f.strength >= LEAST_STRENGTH * strength);
    if found.len() < LEAST_PLACES {
        return None;
    }
    let astray_mm = ASTRAY_PX * factor * side.length / length_px.max(1.0);
    let (shift, turn) = robust(&found, astray_mm)?;
    let (from, to) = (at(0.0) + side.out * (shift - 0.5 * turn), at(1.0) + side.out * (shift + 0.5 * turn));
    Some(((from, (to - from).normalize()), along(&found)?))
}

fn along(found: &[Found]) -> Option<Along> {
    let of = |of: &dyn Fn(&Found) -> f64| middle(&mut found.iter().map(of).collect::<Vec<_>>());
    let rough = |side: usize| {
        let change = |pair: &[Found]| largest(&pair[0].beside[side], &pair[1].beside[side]);
        middle(&mut found.windows(2).map(change).collect::<Vec<_>>())
    };
    let mut ratios = [0.0; 3];
    for (c, ratio) in ratios.iter_mut().enumerate() {
        *ratio = of(&|f| ((f.beside[1][c] + BLACK) / (f.beside[0][c] + BLACK)).ln())?;
    }
    let (low, high) = ratios.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), r| (l.min(*r), h.max(*r)));
    let brighter = (ratios.iter().sum::<f64>() / 3.0).max(0.0);
    Some(Along { sharp: of(&|f| f.sharp)?, rough_in: rough(1)?, rough_out: rough(0)?, unlike: high - low + brighter })
}

fn largest(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (b - a).abs()).fold(0.0, f64::max)
}

/// Offset in the middle and difference between the ends, by Tukey's weights about the median.
fn robust(found: &[Found], astray_mm: f64) -> Option<(f64, f64)> {
    let (mut shift, mut turn) = (middle(&mut found.iter().map(|f| f.place.1).collect::<Vec<_>>())?, 0.0);
    for _ in 0..STEPS {
        let mut sums = [0.0; 5];
        for f in found {
            let u = f.place.0 - 0.5;
            let off = f.place.1 - shift - turn * u;
            let weight = (1.0 - (off / astray_mm).powi(2)).max(0.0).powi(2);
            for (sum, term) in sums.iter_mut().zip([1.0, u, u * u, off, u * off]) {
                *sum += weight * term;
            }
        }
        let [w, wu, wuu, wo, wuo] = sums;
        let wuu = wuu + 0.002 * w; // places close together tell no turn
        let det = w * wuu - wu * wu;
        if det <= 1e-12 {
            return None;
        }
        turn += (w * wuo - wu * wo) / det;
        shift += (wuu * wo - wu * wuo) / det;
    }
    Some((shift, turn))
}

/// The strongest edge across a side at one pixel of it.
fn across(
    picture: &Picture,
    view: &View,
    side: &Side,
    here: Point2<f64>,
    along: Vector2<f64>,
    factor: f64,
) -> Option<Found> {
    let normal = Vector2::new(-along.y, along.x);
    #[expect(clippy::cast_possible_truncation, reason = "a few pixels")]
    let half = (REACH_PX * factor * SAMPLES).ceil() as i32 + 1;
    let change = |at: Point2<f64>, half_px: f64| {
        let (a, b) = (colour(picture, at - normal * half_px)?, colour(picture, at + normal * half_px)?);
        Some(largest(&a, &b))
    };
    let place = |i: f64| here + normal * (i / SAMPLES);
    let changes: Vec<f64> = (-half..=half).map(|i| change(place(f64::from(i)), 1.0)).collect::<Option<_>>()?;
    let best = (1..changes.len() - 1)
        .filter(|i| changes[*i] > changes[i - 1] && changes[*i] >= changes[i + 1])
        .max_by(|a, b| changes[*a].total_cmp(&changes[*b]))?;
    let (before, at, after) = (changes[best - 1], changes[best], changes[best + 1]);
    let top = 0.5 * (before - after) / (before - 2.0 * at + after);
    #[expect(clippy::cast_precision_loss, reason = "a few pixels")]
    let pixel = place(best as f64 - f64::from(half) + top);
    let sharp = match (change(pixel, factor), change(pixel, 3.0 * factor)) {
        (Some(within), Some(about)) => (within / about.max(within).max(1.0)).min(1.0),
        _ => 1.0,
    };
    let on_ground = |pixel: Point2<f64>| view.on_plane(pixel, 0.0).ok();
    let (t, off) = side.place(on_ground(pixel)?);
    let beside = |px: f64| Some((pixel + normal * px, colour(picture, pixel + normal * px)?));
    let (left, right) = (beside(-BESIDE_PX * factor)?, beside(BESIDE_PX * factor)?);
    let is_left_out = side.place(on_ground(left.0)?).1 > off;
    let beside = if is_left_out { [left.1, right.1] } else { [right.1, left.1] };
    Some(Found { place: (t / side.length, off), strength: at, sharp, beside })
}

fn middle(values: &mut [f64]) -> Option<f64> {
    let half = values.len() / 2;
    (!values.is_empty()).then(|| *values.select_nth_unstable_by(half, f64::total_cmp).1)
}
