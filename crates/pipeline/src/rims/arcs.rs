//! A likely circle fitted to the edges along it, and how much of it they cover.

use super::buckets::Buckets;
use super::fitting::{Near, Within};
use super::ground::GroundEdge;
use super::support::support;
use super::votes::Disc;

/// The circle is divided into as many bins.
pub(super) const BINS: usize = 72;
/// Widths of the ring around the circle in which edges count, in radii, from pass to pass of a fit: in rough passes the circle
/// is round, in fine ones it may look oval. And steps of a pass.
const ROUGH: [f32; 2] = [0.12, 0.06];
const ROUGH_STEPS: u8 = 2;
const FINE: [f32; 2] = [0.03, 0.0];
const FINE_STEPS: u8 = 3;
/// Least width of the ring, in scaled pixels; of the last pass.
pub(super) const RING_PX: f32 = 1.5;
/// An edge of a circle points to its centre within 18 degrees.
pub(super) const LEAST_COSINE: f32 = 0.95;
/// Edges with less than this cosine (40 degrees off) certainly belong to something else.
pub(super) const OTHER_COSINE: f32 = 0.766;
/// Edges that a fit may meet lie in a ring of this width around its start, in radii ...
const GATHERED: f32 = 0.25;
/// ... and point to its start's centre within about 30 degrees.
const GATHERED_COSINE: f32 = 0.86;
/// After the first steps, edges further from the circle than this are left out ...
const KEPT: f32 = 0.12;
/// ... and before the last ones those further than this many rings.
const CLOSE: f32 = 2.0;
/// The ring about the rim in which other edges are counted, in radii.
pub(super) const AROUND: f32 = 0.25;
/// A circle with less edge in its ring after the rough steps, relative to its length, is given up, ...
const LEAST_START: f32 = 0.25;
/// ... or with less of its bins covered there ...
const LEAST_START_COVERAGE: f64 = 0.22;
/// ... and one with less along it before the last steps, or in the end.
const LEAST_SHARE: f32 = 0.2;
/// Circles with less of their bins covered are not looked at further.
const LEAST_COVERAGE: f64 = 0.3;
/// Share of a bin's length that must be edges.
const BIN_SHARE: f32 = 0.4;

/// A fitted circle and its support.
#[derive(Debug, Clone)]
pub(super) struct Arc {
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

/// Edge relative to a circle: distance from its centre, and cosine between its normal and the radius (positive where
/// brighter lies outside).
fn relative(e: &GroundEdge, disc: &Disc) -> (f32, f32) {
    #[expect(clippy::cast_possible_truncation, reason = "mm")]
    let (dx, dy) = (e.x - disc.x as f32, e.y - disc.y as f32);
    let distance = (dx * dx + dy * dy).sqrt().max(1e-6);
    (distance, (dx * e.nx + dy * e.ny) / distance)
}

/// A circle on its way, and how far from round it is allowed to look.
#[derive(Debug, Clone, Copy)]
pub(super) struct Trial {
    pub disc: Disc,
    pub oval: [f64; 2],
    pub most_oval: f64,
}

impl Trial {
    /// How far the curve is from the circle at most, in mm.
    #[expect(clippy::cast_possible_truncation, reason = "mm")]
    pub(super) fn most_off(&self) -> f32 {
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
    pub(super) fn moved(&self, disc: [f64; 3], oval: [f64; 2]) -> Option<Self> {
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
    pub(super) fn along(&self, e: &GroundEdge) -> Option<(f32, usize)> {
        let (distance, cosine) = relative(e, &self.disc);
        if cosine.abs() < LEAST_COSINE {
            return None;
        }
        let (off, [cos, sin]) = self.off(e, distance);
        Some((off, bin_of(cos as f32, sin as f32)))
    }
}

/// A likely circle after the rough steps, by pieces of chains.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rough {
    start: Disc,
    trial: Trial,
    /// Share of its bins that have edges in a wide ring.
    pub coverage: f64,
    /// Largest scale of the edges about it, in mm per scaled pixel.
    largest_scale: f32,
}

/// The rough steps of a fit to `pieces` of chains; none when there are too few, or it runs away.
#[expect(clippy::cast_possible_truncation, reason = "mm")]
pub(super) fn rough(pieces: &Buckets, start: &Disc) -> Option<Rough> {
    let mut near = Near::gather(pieces, start, &about(GATHERED * start.radius as f32));
    let mut trial = Trial { disc: *start, oval: [0.0; 2], most_oval: 0.0 };
    for (pass, width) in ROUGH.into_iter().enumerate() {
        if pass > 0 {
            near.keep(&trial, width, CLOSE);
        }
        trial = steps(&near, trial, start, width, ROUGH_STEPS)?;
    }
    let coverage = near.coverage(&trial, FINE[0]);
    let is_worth_it = near.share(&trial, FINE[0]) >= LEAST_START && coverage >= LEAST_START_COVERAGE;
    is_worth_it.then(|| Rough { start: *start, trial, coverage, largest_scale: near.largest_scale() })
}

/// The fine steps of a fit, to every edge; none when there are too few along the circle, or it runs away. `most_oval`: how far
/// from round, relative to its radius, it may look for an error of the pose.
#[expect(clippy::cast_possible_truncation, reason = "mm")]
pub(super) fn fine(buckets: &Buckets, rough: &Rough, most_oval: f64) -> Option<Arc> {
    let mut trial = Trial { most_oval, ..rough.trial };
    let mut near = close_to(buckets, &trial, FINE[0] * rough.start.radius as f32, rough.largest_scale);
    for (pass, width) in FINE.into_iter().enumerate() {
        if pass > 0 {
            near.keep(&trial, width, CLOSE);
            if near.share(&trial, width) < LEAST_SHARE {
                return None;
            }
        }
        trial = steps(&near, trial, &rough.start, width, FINE_STEPS)?;
    }
    if near.share(&trial, 0.0) < LEAST_SHARE || near.coverage(&trial, 0.0) < LEAST_COVERAGE {
        return None;
    }
    Some(support(buckets, &trial))
}

/// Some steps; none where the circle runs away from its start.
fn steps(near: &Near, mut trial: Trial, start: &Disc, width: f32, count: u8) -> Option<Trial> {
    for _ in 0..count {
        trial = near.step(&trial, width)?;
        let moved = (trial.disc.x - start.x).hypot(trial.disc.y - start.y);
        if moved > 0.3 * start.radius || !(0.75..1.33).contains(&(trial.disc.radius / start.radius)) {
            return None;
        }
    }
    Some(trial)
}

/// Edges in a ring of fixed width (mm) that may belong to a circle.
fn about(width_mm: f32) -> Within {
    Within { width_mm, width_px: 0.0, most_mm: width_mm, cosine: GATHERED_COSINE }
}

/// The edges that fine steps may meet: a few times as far from the circle as they look. `ring`: the width of theirs in mm.
#[expect(clippy::cast_possible_truncation, reason = "mm")]
fn close_to(buckets: &Buckets, trial: &Trial, ring: f32, largest_scale: f32) -> Near {
    let (width_mm, width_px) = (CLOSE * ring, CLOSE * RING_PX);
    let most_mm = width_mm.max(width_px * largest_scale).min(GATHERED * trial.disc.radius as f32);
    Near::gather(buckets, &trial.disc, &Within { width_mm, width_px, most_mm, cosine: GATHERED_COSINE })
}

/// Fits again, from close by.
pub(super) fn refit(buckets: &Buckets, start: &Arc, most_oval: f64) -> Option<Arc> {
    #[expect(clippy::cast_possible_truncation, reason = "mm")]
    let radius = start.disc.radius as f32;
    let near = Near::gather(buckets, &start.disc, &about(KEPT * radius));
    let mut trial = Trial { disc: start.disc, oval: start.oval, most_oval };
    for width in [0.02, 0.0, 0.0, 0.0] {
        trial = near.step(&trial, width)?;
    }
    Some(support(buckets, &trial))
}

/// The bin of a direction, by numbers as its cosine and sine, and as long as one likes.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "bins")]
pub(super) fn bin_of(cos: f32, sin: f32) -> usize {
    let turn = angle_of(cos, sin) * (1.0 / std::f32::consts::TAU);
    (((if turn < 0.0 { turn + 1.0 } else { turn }) * BINS as f32) as i32 as usize).min(BINS - 1)
}

/// The angle of a direction in radians, from minus half a turn to half a turn, to 0.0015 (a fiftieth of a bin): a polynomial
/// for the arc tangent up to an eighth of a turn (Rajan et al. 2006, IEEE Signal Processing Magazine 23(3), equation 9).
pub(super) fn angle_of(cos: f32, sin: f32) -> f32 {
    let (c, s) = (cos.abs(), sin.abs());
    let (short, long) = if c < s { (c, s) } else { (s, c) };
    let ratio = short / long.max(f32::MIN_POSITIVE);
    let eighth = ratio * (std::f32::consts::FRAC_PI_4 + (1.0 - ratio) * (0.2447 + 0.0663 * ratio));
    let quarter = if c < s { std::f32::consts::FRAC_PI_2 - eighth } else { eighth };
    let half = if cos < 0.0 { std::f32::consts::PI - quarter } else { quarter };
    if sin < 0.0 { -half } else { half }
}

/// Length of edges that covers a bin of a circle.
#[expect(clippy::cast_precision_loss, reason = "bins")]
pub(super) fn bin_length(radius: f32) -> f32 {
    BIN_SHARE * std::f32::consts::TAU * radius / BINS as f32
}

impl Arc {
    /// The same about the same centre, larger.
    pub(super) fn scaled(&self, ratio: f64) -> Self {
        let disc = Disc { radius: self.disc.radius * ratio, ..self.disc };
        Self { disc, oval: self.oval.map(|o| o * ratio), ..self.clone() }
    }

    /// The place of the curve at an angle about its centre (radians from X), in mm on the plane Z = 0.
    pub(super) fn at(&self, angle: f64) -> [f64; 2] {
        let radius = self.disc.radius + self.oval[0] * (2.0 * angle).cos() + self.oval[1] * (2.0 * angle).sin();
        [self.disc.x + radius * angle.cos(), self.disc.y + radius * angle.sin()]
    }
}

#[cfg(test)]
mod tests {
    use super::angle_of;

    #[test]
    fn angles_are_those_of_the_arc_tangent() {
        for i in -1800_i16..=1800 {
            let angle = f32::from(i) * 0.1_f32.to_radians();
            let off = angle_of(7.0 * angle.cos(), 7.0 * angle.sin()) - angle;
            let off = off.sin().abs().max(1.0 - off.cos()); // half a turn is minus half a turn
            assert!(off < 0.002, "{off} at {angle}");
        }
        assert!(angle_of(0.0, 0.0).is_finite());
    }
}
