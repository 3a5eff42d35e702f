//! Circles on the plane Z = 0: voted for, on their way in a fit, and fitted.

use super::bins::{BINS, bin_of};
use crate::edges::GroundEdge;

/// Least width of the ring, in scaled pixels; of the last pass.
pub(crate) const RING_PX: f32 = 1.5;
/// An edge of a circle points to its centre within 18 degrees.
pub(crate) const LEAST_COSINE: f32 = 0.95;
/// Edges with less than this cosine (40 degrees off) certainly belong to something else.
pub(crate) const OTHER_COSINE: f32 = 0.766;
/// The ring about the rim in which other edges are counted, in radii.
pub(crate) const AROUND: f32 = 0.25;

/// A circle on the plane Z = 0, in mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Disc {
    pub x: f64,
    pub y: f64,
    pub radius: f64,
}

/// A fitted circle and its support.
#[derive(Debug, Clone)]
pub(crate) struct Arc {
    pub disc: Disc,
    /// How far it is from round: radius = R + a cos 2t + b sin 2t, in mm.
    pub oval: [f64; 2],
    /// Per bin, from angle 0 on: 1 where brighter lies outside, -1 where inside, 0 where no edge is.
    pub bins: [i8; BINS],
    /// Share of all bins that have an edge.
    pub coverage: f64,
    /// Root mean square distance of the edges from the circle, in scaled pixels.
    pub residual_px: f64,
    /// Mean strength of the edges, in levels per scaled pixel.
    pub contrast: f64,
    /// Length of other edges (not along circles about this centre) per area around the rim, times the ring's width: the
    /// chance that a place on the rim has an edge along it that means nothing.
    pub chance: f64,
    /// Length of the rim in scaled pixels.
    pub perimeter_px: f64,
}

impl Arc {
    /// The same about the same centre, larger.
    pub(crate) fn scaled(&self, ratio: f64) -> Self {
        let disc = Disc { radius: self.disc.radius * ratio, ..self.disc };
        Self { disc, oval: self.oval.map(|o| o * ratio), ..self.clone() }
    }

    /// The place of the curve at an angle about its centre (radians from X), in mm on the plane Z = 0.
    pub(crate) fn at(&self, angle: f64) -> [f64; 2] {
        let radius = self.disc.radius + self.oval[0] * (2.0 * angle).cos() + self.oval[1] * (2.0 * angle).sin();
        [self.disc.x + radius * angle.cos(), self.disc.y + radius * angle.sin()]
    }
}

/// A circle on its way, and how far from round it is allowed to look.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Trial {
    pub disc: Disc,
    pub oval: [f64; 2],
    pub most_oval: f64,
}

impl Trial {
    /// How far the curve is from the circle at most, in mm.
    #[expect(clippy::cast_possible_truncation, reason = "mm")]
    pub(crate) fn most_off(&self) -> f32 {
        self.oval[0].hypot(self.oval[1]) as f32
    }

    /// Distance of an edge outside the curve in mm, and the direction to it from the centre.
    fn off(&self, e: &GroundEdge, distance: f32) -> (f32, [f64; 2]) {
        let d = f64::from(distance);
        let (cos, sin) = ((f64::from(e.x) - self.disc.x) / d, (f64::from(e.y) - self.disc.y) / d);
        let oval = self.oval[0] * (cos * cos - sin * sin) + self.oval[1] * 2.0 * cos * sin;
        #[expect(clippy::cast_possible_truncation, reason = "mm")]
        ((d - self.disc.radius - oval) as f32, [cos, sin])
    }

    /// The circle after a step; none where it has gone astray.
    pub(crate) fn moved(&self, disc: [f64; 3], oval: [f64; 2]) -> Option<Self> {
        let disc = Disc { x: self.disc.x + disc[0], y: self.disc.y + disc[1], radius: self.disc.radius + disc[2] };
        let mut oval = [self.oval[0] + oval[0], self.oval[1] + oval[1]];
        let (size, most) = (oval[0].hypot(oval[1]), self.most_oval * disc.radius);
        if size > most {
            oval = oval.map(|o| o * most / size);
        }
        (disc.radius > 0.0 && disc.x.is_finite() && disc.y.is_finite()).then_some(Self { disc, oval, ..*self })
    }

    /// For an edge that runs along circles about the centre: its distance outside the curve in mm, and its bin.
    #[expect(clippy::cast_possible_truncation, reason = "a unit vector")]
    pub(crate) fn along(&self, e: &GroundEdge) -> Option<(f32, usize)> {
        let (distance, cosine) = relative(e, &self.disc);
        if cosine.abs() < LEAST_COSINE {
            return None;
        }
        let (off, [cos, sin]) = self.off(e, distance);
        Some((off, bin_of(cos as f32, sin as f32)))
    }
}

/// Edge relative to a circle: distance from its centre, and cosine between its normal and the radius (positive where
/// brighter lies outside).
fn relative(e: &GroundEdge, disc: &Disc) -> (f32, f32) {
    #[expect(clippy::cast_possible_truncation, reason = "mm")]
    let (dx, dy) = (e.x - disc.x as f32, e.y - disc.y as f32);
    let distance = (dx * dx + dy * dy).sqrt().max(1e-6);
    (distance, (dx * e.nx + dy * e.ny) / distance)
}
