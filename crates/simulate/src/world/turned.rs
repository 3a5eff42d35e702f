//! Surfaces of revolution: a profile that is turned about an upright axis.

use nalgebra::{Point2, Vector2, Vector3};

use super::body::Touch;
use crate::scene::Ray;

/// Cosine of the angle at which neighbouring pieces of a profile may meet at most to be one round surface.
const CREASE_COS: f64 = 0.6;

/// A profile that is turned about an upright axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Turned {
    axis_mm: Point2<f64>,
    pieces: Vec<Piece>,
    /// Height of the centre of a ball around it; `reach_mm` is the radius of the ball.
    middle_z_mm: f64,
    reach_mm: f64,
}

/// A piece of a profile: a line from one (radius, height) to the next one.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Piece {
    from: Vector2<f64>,
    to: Vector2<f64>,
    /// The normals at both ends, in the plane of the profile.
    normals: [Vector2<f64>; 2],
}

impl Turned {
    /// The surface of a `profile` about an axis. The profile is a list of points (distance from the axis, height) in mm, in their
    /// order along the surface.
    #[must_use]
    pub fn new(axis_mm: Point2<f64>, profile: &[[f64; 2]]) -> Self {
        let flat: Vec<Piece> = profile
            .windows(2)
            .map(|pair| {
                let (from, to) = (Vector2::from(pair[0]), Vector2::from(pair[1]));
                let along = (to - from).normalize();
                Piece { from, to, normals: [Vector2::new(along.y, -along.x); 2] }
            })
            .filter(|piece| (piece.to - piece.from).norm() > 1e-9)
            .collect();
        let joined = |a: Vector2<f64>, b: Vector2<f64>| if a.dot(&b) > CREASE_COS { (a + b).normalize() } else { a };
        let normal = |at: Option<&Piece>| at.map(|piece| piece.normals[0]);
        let pieces = flat.iter().enumerate().map(|(i, piece)| {
            let own = piece.normals[0];
            let before = normal(i.checked_sub(1).and_then(|i| flat.get(i))).unwrap_or(own);
            let after = normal(flat.get(i + 1)).unwrap_or(own);
            Piece { normals: [joined(own, before), joined(own, after)], ..*piece }
        });
        let heights = || profile.iter().map(|point| point[1]);
        let (low, high) = (heights().fold(f64::MAX, f64::min), heights().fold(f64::MIN, f64::max));
        let middle_z_mm = 0.5 * (low + high);
        let reach_mm = profile.iter().map(|p| p[0].hypot(p[1] - middle_z_mm)).fold(0.0, f64::max);
        Self { axis_mm, pieces: pieces.collect(), middle_z_mm, reach_mm }
    }

    /// Centre and radius of a ball around the surface.
    pub(super) fn ball(&self) -> (nalgebra::Point3<f64>, f64) {
        (nalgebra::Point3::new(self.axis_mm.x, self.axis_mm.y, self.middle_z_mm), self.reach_mm)
    }

    /// The place of the axis, in mm.
    #[must_use]
    pub fn axis_mm(&self) -> Point2<f64> {
        self.axis_mm
    }

    /// The nearest point of the surface along the ray that is further than `least`, in lengths of the ray's direction.
    pub(super) fn touch(&self, ray: &Ray, least: f64) -> Option<Touch> {
        let mut best: Option<(f64, &Piece, f64)> = None;
        for piece in &self.pieces {
            for (distance, share) in self.meets(piece, ray).into_iter().flatten() {
                if distance > least && best.is_none_or(|(nearest, ..)| distance < nearest) {
                    best = Some((distance, piece, share));
                }
            }
        }
        let (distance, piece, share) = best?;
        let outward = (ray.point_at(distance).xy() - self.axis_mm).try_normalize(1e-9).unwrap_or_else(Vector2::x);
        let normal = piece.normals[0].lerp(&piece.normals[1], share).normalize();
        let normal = Vector3::new(outward.x * normal.x, outward.y * normal.x, normal.y);
        Some(Touch { distance, normal })
    }

    /// Both points where a ray meets the cone of a piece: the distance, and the share of the way along the piece.
    fn meets(&self, piece: &Piece, ray: &Ray) -> [Option<(f64, f64)>; 2] {
        let (o, d) = (ray.origin.xy() - self.axis_mm, ray.direction);
        let rise = piece.to.y - piece.from.y;
        let share_if_on = |share: f64| (0.0..=1.0).contains(&share).then_some(share);
        if rise.abs() < 1e-9 {
            let distance = (piece.from.y - ray.origin.z) / d.z;
            let radius = (o + d.xy() * distance).norm();
            let share = (radius - piece.from.x) / (piece.to.x - piece.from.x);
            return [share_if_on(share).map(|share| (distance, share)), None];
        }
        // |o + t d| = r0 + r1 t along the ray, a quadratic.
        let flare = (piece.to.x - piece.from.x) / rise;
        let (r0, r1) = (piece.from.x + flare * (ray.origin.z - piece.from.y), flare * d.z);
        let a = d.xy().norm_squared() - r1 * r1;
        let half_b = o.dot(&d.xy()) - r0 * r1;
        let c = o.norm_squared() - r0 * r0;
        let under = half_b * half_b - a * c;
        if under < 0.0 || a.abs() < 1e-12 {
            return [None; 2];
        }
        let root = under.sqrt();
        [(-half_b - root) / a, (-half_b + root) / a].map(|distance| {
            let share = share_if_on((ray.origin.z + d.z * distance - piece.from.y) / rise)?;
            (r0 + r1 * distance >= 0.0).then_some((distance, share))
        })
    }
}
