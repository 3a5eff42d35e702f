//! A laid table as a camera sees it: bodies with textures in the light of a lamp and a window, by ray casting.
//!
//! World frame of `model`: Z up, the table at Z = 0, in mm. The scenes of [`crate::scene`] are simpler and drawn flat; these
//! here are meant to be as hard as real pictures. The steps of a picture are in [`photo`].

mod body;
mod chance;
mod convex;
mod light;
pub mod photo;
#[cfg(test)]
mod tests;
mod texture;
mod turned;

use nalgebra::{Point2, Point3, Vector3};

use body::Touch;
pub use body::{Body, Form, Material};
pub use convex::Convex;
pub use light::Light;
pub use texture::Texture;
pub use turned::Turned;

use crate::scene::Ray;

/// Red, green and blue: shares of light sent back, or light in units of a white surface in full light.
pub type Rgb = [f64; 3];

/// A table with things on it.
#[derive(Debug, Clone, PartialEq)]
pub struct World {
    /// The table's surface.
    pub table: Material,
    /// Half its length and depth, and its middle.
    pub table_mm: ([f64; 2], Point2<f64>),
    /// What stands on it or is held above it.
    pub bodies: Vec<Body>,
    /// The light.
    pub light: Light,
}

/// The floor under the table.
const FLOOR_Z_MM: f64 = -740.0;
const FLOOR: Rgb = [0.16, 0.14, 0.13];

/// What a ray has met.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Meeting {
    touch: Touch,
    what: What,
}

/// Which surface was met.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum What {
    Body(usize),
    Table,
    Floor,
}

impl World {
    /// The first surface along the ray, further than `least` lengths of its direction.
    fn meet(&self, ray: &Ray, least: f64) -> Option<Meeting> {
        let mut best: Option<Meeting> = None;
        for (at, body) in self.bodies.iter().enumerate() {
            if let Some(touch) = body.touch(ray, least)
                && best.is_none_or(|best| touch.distance < best.touch.distance)
            {
                best = Some(Meeting { touch, what: What::Body(at) });
            }
        }
        for (level, what) in [(0.0, What::Table), (FLOOR_Z_MM, What::Floor)] {
            let distance = (level - ray.origin.z) / ray.direction.z;
            let is_there = what == What::Floor || self.is_table(ray.point_at(distance).xy());
            if distance > least && is_there && best.is_none_or(|best| distance < best.touch.distance) {
                best = Some(Meeting { touch: Touch { distance, normal: Vector3::z() }, what });
            }
        }
        best
    }

    fn is_table(&self, point: Point2<f64>) -> bool {
        let ([half_x, half_y], middle) = self.table_mm;
        (point.x - middle.x).abs() <= half_x && (point.y - middle.y).abs() <= half_y
    }

    /// Whether something stands in the way along the ray, before one length of its direction, that lets no light through.
    fn is_dark(&self, ray: &Ray) -> bool {
        self.bodies
            .iter()
            .any(|body| body.material.clear < 0.5 && body.touch(ray, 1e-6).is_some_and(|touch| touch.distance < 1.0))
    }

    /// Distance to the first surface along a ray, in lengths of its direction; none where it meets nothing.
    #[must_use]
    pub fn distance(&self, ray: &Ray) -> Option<f64> {
        self.meet(ray, 1e-6).map(|meeting| meeting.touch.distance)
    }

    /// Whether `from` sees `point`: nothing but clear glass, or something `within_mm` of it, lies between.
    #[must_use]
    pub fn is_seen(&self, from: Point3<f64>, point: Point3<f64>, within_mm: f64) -> bool {
        let direction = point - from;
        let free = 1.0 - within_mm / direction.norm();
        let ray = Ray { origin: from, direction };
        !self
            .bodies
            .iter()
            .any(|body| body.material.clear < 0.5 && body.touch(&ray, 1e-6).is_some_and(|touch| touch.distance < free))
    }
}
