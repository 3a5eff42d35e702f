//! The ring between two edges about one centre: whether it is a part of the container or of the table.
//!
//! A lip or a printed ring looks like what is within it, or like neither; the table between a rim and the edge of a shadow or
//! a stripe looks like the table further out, but for its brightness. So the colour of the ring is held against the colours
//! inside and outside, as it is and with the brightness left free.

use super::rays::Ray;
use crate::weights::{RING_FEATURES, RING_ODDS};

/// Colours are taken this far from an edge, in pixels, or this share of a narrow ring.
const CLEAR_PX: f64 = 0.7;
const CLEAR: f64 = 0.35;
/// They are compared over at least so many pixels.
const LEAST_PX: f64 = 1.0;
/// A ring is judged by at least so many directions.
const LEAST_DIRECTIONS: usize = 15;

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

/// The distance of a circle outside the one from which rays start, along a ray, in pixels.
pub(super) fn at_px(ray: &Ray, moved: &Moved) -> f64 {
    ray.unit[0] * moved.x + ray.unit[1] * moved.y + moved.z
}

/// Logarithm of the odds that the outer one of two edges is the rim's outer edge rather than the inner one; none where too few
/// directions show both.
pub(super) fn odds(rays: &[Ray], inner: &Edge, outer: &Edge) -> Option<f64> {
    let features = features(rays, inner, outer)?;
    Some(RING_ODDS.iter().zip(features).map(|(weight, feature)| weight * feature).sum())
}

/// The features of a pair of edges, by which [`odds`] judges it: one, the ring's likeness in colour and in hue, and the shares of the
/// directions that show the inner and the outer edge; none where too few directions show both.
pub(super) fn features(rays: &[Ray], inner: &Edge, outer: &Edge) -> Option<[f64; RING_FEATURES]> {
    let Likeness { colour, hue } = likeness(rays, &inner.moved, &outer.moved)?;
    Some([1.0, colour, hue, inner.seen, outer.seen])
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

/// The likeness in one direction: in colour and in hue.
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

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

    use super::{Edge, Moved, Ray, odds};

    const CONTAINER: [f64; 3] = [190.0, 120.0, 100.0];
    const TABLE: [f64; 3] = [90.0, 130.0, 100.0];

    /// Rays over a container, a ring of four pixels outside it and the table; one direction in three shows something else.
    fn rays(ring: [f64; 3]) -> Vec<Ray> {
        let directions = (0..60).map(|i| f64::from(i) / 60.0 * std::f64::consts::TAU);
        directions
            .enumerate()
            .map(|(i, angle)| {
                let is_hidden = i % 3 == 0;
                let colour = |px: f64| match px {
                    _ if is_hidden => [40.0 + 2.0 * px, 40.0, 60.0],
                    _ if px < 0.0 => CONTAINER,
                    _ if px < 4.0 => ring,
                    _ => TABLE,
                };
                let colours = (0..80).map(|k| Some(colour(0.5 * f64::from(k) - 20.0))).collect();
                Ray::new([angle.cos(), angle.sin()], vec![0.0, 4.0], colours, 20.0)
            })
            .collect()
    }

    fn odds_of(ring: [f64; 3], outer_seen: f64) -> f64 {
        let edge = |px: f64, seen: f64| Edge { moved: Moved::new(0.0, 0.0, px), seen };
        odds(&rays(ring), &edge(0.0, 0.9), &edge(4.0, outer_seen)).unwrap()
    }

    #[test]
    fn a_lip_belongs_to_the_rim_and_a_shadow_does_not() {
        assert!(odds_of([200.0, 130.0, 110.0], 0.5) > 1.0, "a lip, a little brighter than what is within");
        assert!(odds_of(TABLE.map(|level| 0.6 * level), 0.5) < -1.0, "a shadow on the table");
        assert!(odds_of(TABLE.map(|level| level + 6.0), 0.5) < -1.0, "a brighter stripe of the table");
        assert!(odds_of([30.0, 40.0, 160.0], 0.9) > 1.0, "a printed ring that is like neither");
    }

    #[test]
    fn what_is_seen_better_is_likelier_the_rim() {
        let ring = [140.0, 125.0, 100.0];
        assert!(odds_of(ring, 0.9) > odds_of(ring, 0.5) + 1.0);
    }

    #[test]
    fn edges_too_near_to_each_other_tell_nothing() {
        let edge = |px: f64| Edge { moved: Moved::new(0.0, 0.0, px), seen: 0.9 };
        assert!(odds(&rays(CONTAINER), &edge(0.0), &edge(0.5)).is_none());
    }
}
