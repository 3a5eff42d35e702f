//! Whether what lies between two edges about one centre is part of the container or of the table.
//!
//! A lip or a printed ring looks like what is within it, or like neither; the table between a rim and the edge of a shadow or
//! a stripe looks like the table further out, but for its brightness. So the colour of the ring is held against the colours
//! inside and outside, as it is and with the brightness left free.

use super::rays::Ray;

/// Colours are taken this far from an edge, in pixels, or this share of a narrow ring.
const CLEAR_PX: f64 = 0.7;
const CLEAR: f64 = 0.35;
/// They are compared over at least so many pixels.
const LEAST_PX: f64 = 1.0;
/// Fewer directions tell nothing.
const LEAST_DIRECTIONS: usize = 15;
/// Logarithm of the odds that the outer of two edges is the rim's: constant, and weights of the ring's likeness ([`Likeness`])
/// and of how well the inner and the outer edge are seen. A logistic regression on rendered tables.
const ODDS: [f64; 5] = [-3.41, 0.85, 1.36, 1.34, 6.13];

/// A circle near another one: how far its centre is moved and its radius is larger, in pixels.
pub(super) type Moved = nalgebra::Vector3<f64>;

/// A circle along which edges lie.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    pub moved: Moved,
    /// Share of the directions that show it, less what chance makes.
    pub seen: f64,
}

/// Medians over the directions of the logarithm of how much more a ring differs from what is outside it than from what is
/// inside: in colour, and in colour whatever the brightness.
struct Likeness {
    colour: f64,
    hue: f64,
}

/// How far outside the circle that rays start from another one is, in a direction.
pub(super) fn at_px(ray: &Ray, moved: &Moved) -> f64 {
    ray.unit[0] * moved.x + ray.unit[1] * moved.y + moved.z
}

/// Logarithm of the odds that the outer one of two edges is the rim's outer edge rather than the inner one; none where the
/// picture does not tell.
pub(super) fn odds(rays: &[Ray], inner: &Edge, outer: &Edge) -> Option<f64> {
    let Likeness { colour, hue } = likeness(rays, &inner.moved, &outer.moved)?;
    let features = [1.0, colour, hue, inner.seen, outer.seen];
    Some(ODDS.iter().zip(features).map(|(weight, feature)| weight * feature).sum())
}

fn likeness(rays: &[Ray], inner: &Moved, outer: &Moved) -> Option<Likeness> {
    let told: Vec<[f64; 2]> =
        rays.iter().filter_map(|ray| compared(ray, at_px(ray, inner), at_px(ray, outer))).collect();
    if told.len() < LEAST_DIRECTIONS {
        return None;
    }
    let [colour, hue] = [0, 1].map(|which| {
        let mut values: Vec<f64> = told.iter().map(|t| t[which]).collect();
        let half = values.len() / 2;
        *values.select_nth_unstable_by(half, f64::total_cmp).1
    });
    Some(Likeness { colour, hue })
}

/// The same in one direction.
fn compared(ray: &Ray, inner_px: f64, outer_px: f64) -> Option<[f64; 2]> {
    let width_px = outer_px - inner_px;
    if width_px < 2.0 * CLEAR_PX * (1.0 - CLEAR) {
        return None;
    }
    let clear_px = CLEAR_PX.min(CLEAR * width_px);
    let (near, far) = (CLEAR_PX, CLEAR_PX + (width_px - 2.0 * clear_px).max(LEAST_PX));
    let ring = ray.mean(inner_px + clear_px, outer_px - clear_px)?;
    let outside = ray.mean(outer_px + near, outer_px + far)?;
    let inside = ray.mean(inner_px - far, inner_px - near)?;
    // One level more on both sides: equal colours differ by noise.
    let more = |apart: fn([f64; 3], [f64; 3]) -> f64| ((apart(ring, outside) + 1.0) / (apart(ring, inside) + 1.0)).ln();
    Some([more(apart), more(apart_in_hue)])
}

fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

/// Distance of two colours if the first one may be brighter or darker: a shadow changes no more.
fn apart_in_hue(a: [f64; 3], b: [f64; 3]) -> f64 {
    let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let brighter = dot(a, b) / dot(a, a).max(1e-9);
    apart(a.map(|level| level * brighter), b)
}
