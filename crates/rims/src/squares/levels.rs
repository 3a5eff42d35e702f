//! What lies within a rectangle at other levels than its own: its well below it, a plate that stands on it.
//!
//! A line at the level z along a side at the level H appears on the plane Z = 0 as far from the side as it is, and besides by
//! (1 - s) d, with d the signed distance of the side from the point under the camera and s = (c - H) / (c - z) for a camera at
//! the height c: inward on the far side, outward on the near one. So a drop s < 1 is told from a printed border on the same
//! level by the difference between opposite sides.

use super::quad::{Quad, Side};
use super::support::Lines;
use crate::edges::GroundEdge;

/// Drops 1 - s that are tried, in steps: below a rim 20 mm high, 440 mm under a camera, a floor has 0.035.
const DROP_STEP: f64 = 0.004;
const LEAST_DROP: f64 = 0.012;
const MOST_DROP: f64 = 0.12;
/// Widths of a flange that are tried, in mm, and as a share of the rectangle.
const FLANGE_MM: (i32, i32) = (4, 80);
const FLANGE_SHARE: f64 = 0.36;
/// Flanges of both pairs of sides are as wide within this share, and so many mm.
const FLANGES_ALIKE: f64 = 0.2;
const FLANGES_ALIKE_MM: f64 = 2.0;
/// Nearer to a side than this (mm), a line is the side itself or its other edge.
const OWN_MM: f64 = 3.0;
/// What is seen at other levels, each from 0 to 1: the mean share of the sides that have a line there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Levels {
    /// Within the rectangle and below it, as a well is.
    pub below: f64,
    /// The same of the side that has least of it.
    pub least_below: f64,
    /// Within it on its own level, as a printed border is.
    pub level: f64,
    /// Within it and above it, as a plate on a mat is.
    pub above: f64,
    /// Any line within, parallel to a side: mean share over all places.
    pub clutter: f64,
}

impl Levels {
    pub(super) fn of(quad: &Quad, near: &[GroundEdge]) -> Self {
        let sides = quad.sides();
        let lines = &sides.map(|side| Lines::of(&side, near));
        let best = |from: f64, to: f64| {
            let all = drops(from, to).map(|drop| nested(&sides, lines, drop));
            all.max_by(|a, b| a.mean.total_cmp(&b.mean)).unwrap_or(Nested { mean: 0.0, least: 0.0 })
        };
        let below = best(LEAST_DROP, MOST_DROP);
        let (level, above) = (best(-LEAST_DROP + DROP_STEP, LEAST_DROP), best(-MOST_DROP, -LEAST_DROP + DROP_STEP));
        Self {
            below: below.mean,
            least_below: below.least,
            level: level.mean,
            above: above.mean,
            clutter: clutter(&sides, lines),
        }
    }
}

/// Shares of the sides that have a line within them at some level.
struct Nested {
    mean: f64,
    least: f64,
}

fn drops(from: f64, to: f64) -> impl Iterator<Item = f64> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few steps")]
    let steps = ((to - from) / DROP_STEP).round() as u32;
    (0..steps).map(move |step| from + f64::from(step) * DROP_STEP)
}

/// Signed distance of a side from the point under the camera: positive where that lies within.
fn distance(side: &Side) -> f64 {
    side.out.dot(&side.from.coords)
}

/// The sides that have a line within and so far below, about as far from all.
fn nested(sides: &[Side; 4], lines: &[Lines; 4], drop: f64) -> Nested {
    let at = |k: usize, flange: i32| {
        let away = f64::from(flange) + drop * distance(&sides[k]);
        if away < OWN_MM { 0.0 } else { lines[k].share(away) }
    };
    let pair =
        |k: usize| -> Vec<[f64; 2]> { flanges(sides, k).map(|flange| [at(k, flange), at(k + 2, flange)]).collect() };
    let pairs = [pair(0), pair(1)];
    let mut best = Nested { mean: 0.0, least: 0.0 };
    for (i, [a, b]) in pairs[0].iter().enumerate() {
        let (from, to) = alike(i);
        for [c, d] in pairs[1].iter().take(to).skip(from) {
            let mean = 0.25 * (a + b + c + d);
            if mean > best.mean {
                best = Nested { mean, least: a.min(*b).min(c.min(*d)) };
            }
        }
    }
    best
}

/// Widths of a flange along side `k` and the one across from it.
fn flanges(sides: &[Side; 4], k: usize) -> std::ops::RangeInclusive<i32> {
    #[expect(clippy::cast_possible_truncation, reason = "mm")]
    let most = FLANGE_MM.1.min((FLANGE_SHARE * sides[(k + 1) % 4].length) as i32);
    FLANGE_MM.0..=most
}

/// From and to which place in the list of widths one pair of sides has, for a place in that of the other.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "mm")]
fn alike(place: usize) -> (usize, usize) {
    let first = f64::from(FLANGE_MM.0);
    let flange = place as f64 + first;
    let low = flange * (1.0 - FLANGES_ALIKE) - FLANGES_ALIKE_MM - first;
    let high = flange * (1.0 + FLANGES_ALIKE) + FLANGES_ALIKE_MM - first;
    (low.max(0.0) as usize, high as usize + 1)
}

/// Mean share of the sides that have a line, over all places within.
fn clutter(sides: &[Side; 4], lines: &[Lines; 4]) -> f64 {
    let all: Vec<f64> = (0..4).flat_map(|k| flanges(sides, k).map(move |mm| lines[k].share(f64::from(mm)))).collect();
    #[expect(clippy::cast_precision_loss, reason = "mm")]
    let count = all.len().max(1) as f64;
    all.iter().sum::<f64>() / count
}
