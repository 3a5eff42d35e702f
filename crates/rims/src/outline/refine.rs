//! A rim followed through the full picture.

use ingest::Picture;
use model::View;
use nalgebra::{Point2, Point3, Vector2};

use crate::circles::{Arc, BINS};
use crate::colour::colour;

/// Pixels between places where the rim is looked for.
const SPACING_PX: f64 = 4.0;
/// The least number of such places.
const FEWEST_PLACES: f64 = 48.0;
/// The greatest number of such places.
const MOST_PLACES: f64 = 96.0;
/// The edge at a place lies within this many scaled pixels of the fitted circle.
const REACH_PX: f64 = 1.2;
/// The edge at a place has at least this share of the median strength of all of them.
const LEAST_STRENGTH: f64 = 0.3;
/// Places further from the others than this many deviations belong to something else.
const OUTLIER: f64 = 3.0;
/// Cosine of the angle to the direction away from the wearer, beyond which a place is on the near side.
const NEAR_THIRD: f64 = -0.5;
/// Samples per pixel of a profile.
const SAMPLES: f64 = 2.0;

/// A point of the rim: where it was predicted, along which normal, and how far from there it is.
struct Found {
    point_px: Point2<f64>,
    off_px: f64,
    strength: f64,
    /// Whether it lies towards the wearer, where the container's own wall is behind the rim.
    is_near: bool,
    /// Share of the change about it that happens within a pixel to either side (of the reduced scale).
    sharp: f64,
}

/// A rim in the full picture.
pub(crate) struct Followed {
    /// Points along it, in order, where it has an edge.
    pub points_px: Vec<Point2<f64>>,
    /// Median over them of the share of the change across the rim that happens within a pixel to either side, of that within
    /// three (pixels of the reduced scale): a border of things is sharp, one of a shadow is not.
    pub sharp: f64,
}

/// Points of the rim in the full picture, in order, where it has an edge.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "places")]
pub(crate) fn follow(picture: &Picture, view: &View, arc: &Arc, factor: usize) -> Followed {
    let perimeter_px = arc.perimeter_px * factor as f64;
    let places = (perimeter_px / SPACING_PX).clamp(FEWEST_PLACES, MOST_PLACES) as usize;
    let found: Vec<Found> = (0..places)
        .map(|i| i as f64 / places as f64)
        .filter(|turn| arc.bins[((turn * BINS as f64) as usize).min(BINS - 1)] != 0)
        .filter_map(|turn| across(picture, view, arc, turn * std::f64::consts::TAU, factor as f64))
        .collect();
    let none = Followed { points_px: Vec::new(), sharp: 0.0 };
    let Some(strength) = middle(found.iter().map(|f| f.strength)) else { return none };
    let found: Vec<Found> = found.into_iter().filter(|f| f.strength >= LEAST_STRENGTH * strength).collect();
    // Edges of the wall just below the rim may be taken for it on the near side: the others say where it is.
    let sides = |f: &&Found| !f.is_near;
    let Some(off) = middle(found.iter().filter(sides).map(|f| f.off_px)) else { return none };
    // 1.48: standard deviation over median absolute deviation of a normal distribution.
    let spread = 1.48 * middle(found.iter().filter(sides).map(|f| (f.off_px - off).abs())).unwrap_or(0.0);
    let limit = OUTLIER * spread.max(0.1);
    let sharp = middle(found.iter().map(|f| f.sharp)).unwrap_or(0.0);
    let points_px = found.into_iter().filter(|f| (f.off_px - off).abs() <= limit).map(|f| f.point_px).collect();
    Followed { points_px, sharp }
}

fn middle(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut values: Vec<f64> = values.collect();
    let half = values.len() / 2;
    (!values.is_empty()).then(|| *values.select_nth_unstable_by(half, f64::total_cmp).1)
}

/// The strongest edge across the rim at one angle.
fn across(picture: &Picture, view: &View, arc: &Arc, angle: f64, factor: f64) -> Option<Found> {
    let pixel = |angle: f64| {
        let [x, y] = arc.place_at(angle);
        view.pixel_of(Point3::new(x, y, 0.0)).ok()
    };
    let here = pixel(angle)?;
    let along = (pixel(angle + 0.01)? - pixel(angle - 0.01)?).try_normalize(1e-9)?;
    let normal = Vector2::new(-along.y, along.x);
    #[expect(clippy::cast_possible_truncation, reason = "a few pixels")]
    let half = (REACH_PX * factor * SAMPLES).ceil() as i32 + 1;
    let sample = |i: i32| colour(picture, here + normal * (f64::from(i) / SAMPLES));
    // Change over two pixels, of the colour that changes most; what is near the prediction counts more.
    let changes: Vec<f64> = (-half..=half)
        .map(|i| {
            let (a, b) = (sample(i - 2)?, sample(i + 2)?);
            Some(a.iter().zip(b).map(|(a, b)| (b - a).abs()).fold(0.0, f64::max))
        })
        .collect::<Option<_>>()?;
    let nearness = |i: usize| {
        #[expect(clippy::cast_precision_loss, reason = "a few pixels")]
        let off = (i as f64 - f64::from(half)) / f64::from(half + 1);
        1.0 - 0.7 * off * off
    };
    let best = (1..changes.len() - 1)
        .filter(|i| changes[*i] > changes[i - 1] && changes[*i] >= changes[i + 1])
        .max_by(|a, b| (changes[*a] * nearness(*a)).total_cmp(&(changes[*b] * nearness(*b))))?;
    let (before, at, after) = (changes[best - 1], changes[best], changes[best + 1]);
    let top = 0.5 * (before - after) / (before - 2.0 * at + after);
    #[expect(clippy::cast_precision_loss, reason = "a few pixels")]
    let off_px = (best as f64 - f64::from(half) + top) / SAMPLES;
    let point_px = here + normal * off_px;
    let change = |half_px: f64| {
        let side = normal * (half_px * factor);
        let (a, b) = (colour(picture, point_px - side)?, colour(picture, point_px + side)?);
        Some(a.iter().zip(b).map(|(a, b)| (b - a).abs()).fold(0.0, f64::max))
    };
    let sharp = match (change(1.0), change(3.0)) {
        (Some(within), Some(about)) => (within / about.max(within).max(1.0)).min(1.0),
        _ => 1.0,
    };
    let is_near = (angle - arc.disc.y.atan2(arc.disc.x)).cos() < NEAR_THIRD;
    Some(Found { point_px, off_px, strength: at, is_near, sharp })
}
