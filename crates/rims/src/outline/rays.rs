//! Rays across a rim, in the full picture: colours along them, and where they change.

use ingest::Picture;
use model::View;
use nalgebra::{Point2, Point3};

use crate::circles::Arc;
use crate::colour::colour;

/// Directions that are looked at.
const DIRECTIONS: u32 = 120;
/// Steps between samples per pixel, and half of what a change is taken over, in steps.
const STEPS_PER_PX: f64 = 2.0;
const HALF: usize = 2;
/// An edge changes by at least so many levels, and by this share of the strongest one in its direction.
const LEAST_LEVELS: f64 = 5.0;
const LEAST_SHARE: f64 = 0.15;
/// The far edge of the wearer's third: cosine against the direction away from the wearer.
const NEAR_THIRD: f64 = -0.5;

/// The stretch that is looked at: how far inward and outward of the circle, in pixels.
#[derive(Clone, Copy)]
pub(super) struct Span {
    pub inward_px: f64,
    pub outward_px: f64,
    /// A pixel of this size, in mm on Z = 0: a pixel of the full picture, or several where its lens resolves no more.
    pub px_mm: f64,
}

/// The edges and colours that are seen in one direction.
pub(super) struct Ray {
    /// Cosine and sine of the direction.
    pub unit: [f64; 2],
    /// The distances of its edges outside the circle, in pixels.
    pub edges_px: Vec<f64>,
    colours: Vec<Option<[f64; 3]>>,
    inward_px: f64,
}

impl Ray {
    #[cfg(test)]
    pub(super) fn new(unit: [f64; 2], edges_px: Vec<f64>, colours: Vec<Option<[f64; 3]>>, inward_px: f64) -> Self {
        Self { unit, edges_px, colours, inward_px }
    }

    /// Distance of the edge that is nearest to a place, outside it, in pixels.
    pub(super) fn nearest(&self, at_px: f64) -> Option<f64> {
        self.edges_px.iter().map(|edge| edge - at_px).min_by(|a, b| a.abs().total_cmp(&b.abs()))
    }

    /// Mean colour between two places, in pixels outside the circle; none where the picture does not show all of it.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "samples")]
    pub(super) fn mean(&self, from_px: f64, to_px: f64) -> Option<[f64; 3]> {
        let sample = |px: f64| ((px + self.inward_px) * STEPS_PER_PX).round();
        let (first, last) = match (sample(from_px), sample(to_px)) {
            (first, last) if first <= last => (first, last),
            _ => [sample(0.5 * (from_px + to_px)); 2].into(),
        };
        if first < 0.0 {
            return None;
        }
        let colours = self.colours.get(first as usize..=last as usize)?;
        let mut sum = [0.0; 3];
        for colour in colours {
            let colour = (*colour)?;
            sum = [0, 1, 2].map(|k| sum[k] + colour[k]);
        }
        Some(sum.map(|s| s / colours.len() as f64))
    }
}

/// Rays about a circle. Towards the wearer the rim is seen against its own wall, where edges further out are the wall's, the
/// foot's or a shadow's: that third is left out, but for a circle seen from steeply above.
pub(super) fn rays(picture: &Picture, view: &View, arc: &Arc, span: Span) -> Vec<Ray> {
    let away = arc.disc.y.atan2(arc.disc.x);
    let steep = arc.disc.x.hypot(arc.disc.y) < arc.disc.radius;
    let directions = (0..DIRECTIONS).map(|i| f64::from(i) / f64::from(DIRECTIONS) * std::f64::consts::TAU);
    directions
        .filter(|angle| steep || (angle - away).cos() > NEAR_THIRD)
        .map(|angle| {
            let colours = colours(picture, view, arc, angle, span);
            let edges_px = edges(&colours, span.inward_px);
            Ray { unit: [angle.cos(), angle.sin()], edges_px, colours, inward_px: span.inward_px }
        })
        .collect()
}

/// Colours along one direction: each the mean of five places along the rim, a pixel and a half apart, or less on a small one.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "samples")]
fn colours(picture: &Picture, view: &View, arc: &Arc, angle: f64, span: Span) -> Vec<Option<[f64; 3]>> {
    let samples = ((span.inward_px + span.outward_px) * STEPS_PER_PX) as usize + 1;
    let radius = {
        let [x, y] = arc.place_at(angle);
        (x - arc.disc.x).hypot(y - arc.disc.y)
    };
    let apart_mm = (1.5 * span.px_mm).min(0.015 * radius);
    let lines = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|beside| {
        let (sin, cos) = (angle + beside * apart_mm / radius).sin_cos();
        Line::new(samples / Line::EVERY + 1, |node| {
            let off_px = (node * Line::EVERY) as f64 / STEPS_PER_PX - span.inward_px;
            let r = radius + off_px * span.px_mm;
            view.pixel_of(Point3::new(arc.disc.x + r * cos, arc.disc.y + r * sin, 0.0)).ok()
        })
    });
    let sample = |i: usize| -> Option<[f64; 3]> {
        let mut sum = [0.0; 3];
        for line in &lines {
            let c = colour(picture, line.pixel_at(i)?)?;
            sum = [0, 1, 2].map(|k| sum[k] + c[k] / 5.0);
        }
        Some(sum)
    };
    (0..samples).map(sample).collect()
}

/// The places where brightness or colour changes fastest along one direction, in pixels outside the circle.
#[expect(clippy::cast_precision_loss, reason = "samples")]
fn edges(colours: &[Option<[f64; 3]>], inward_px: f64) -> Vec<f64> {
    let change = |i: usize| match (colours[i - HALF], colours[i + HALF]) {
        (Some(a), Some(b)) => a.iter().zip(b).map(|(a, b)| (b - a).abs()).fold(0.0, f64::max),
        _ => 0.0,
    };
    let changes: Vec<f64> = (HALF..colours.len().saturating_sub(HALF)).map(change).collect();
    let least = LEAST_LEVELS.max(LEAST_SHARE * changes.iter().copied().fold(0.0, f64::max));
    let is_edge = |i: &usize| changes[*i] > changes[i - 1] && changes[*i] >= changes[i + 1] && changes[*i] >= least;
    (1..changes.len().saturating_sub(1))
        .filter(is_edge)
        .map(|i| {
            let (before, at, after) = (changes[i - 1], changes[i], changes[i + 1]);
            let top = 0.5 * (before - after) / (before - 2.0 * at + after);
            ((i + HALF) as f64 + top) / STEPS_PER_PX - inward_px
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

    fn pixel_at(&self, sample: usize) -> Option<Point2<f64>> {
        let (from, to) = (self.0[sample / Self::EVERY]?, self.0[sample / Self::EVERY + 1]?);
        #[expect(clippy::cast_precision_loss, reason = "a few samples")]
        let share = (sample % Self::EVERY) as f64 / Self::EVERY as f64;
        Some(from + (to - from) * share)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

    use super::{Ray, edges};

    /// A step between two samples, drawn over two pixels, is found between them, and noise below the least change is not.
    #[test]
    fn a_step_is_found_where_it_is() {
        let colours: Vec<Option<[f64; 3]>> = (0..60)
            .map(|i| {
                let level = 40.0 * f64::from(i - 24).clamp(0.0, 4.0) / 4.0 + f64::from(i % 3);
                Some([60.0, 60.0 + level, 60.0])
            })
            .collect();
        let edges_px = edges(&colours, 10.0);
        assert_eq!(edges_px.len(), 1, "{edges_px:?}");
        assert!((edges_px[0] - 3.0).abs() < 0.3, "{edges_px:?}");
        let ray = Ray::new([1.0, 0.0], edges_px, colours, 10.0);
        assert!(ray.nearest(1.0).unwrap() > 1.0);
        assert!((ray.mean(6.0, 9.0).unwrap()[1] - ray.mean(-5.0, 0.0).unwrap()[1] - 40.0).abs() < 1.0);
        assert_eq!(ray.mean(-12.0, 0.0), None);
        assert_eq!(ray.mean(0.0, 40.0), None);
    }
}
