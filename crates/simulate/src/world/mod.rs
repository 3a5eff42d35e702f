//! A laid table as a camera sees it: bodies with textures, in the light of a lamp and a window, by ray casting.
//!
//! All is in the world frame of `model`: Z up, the table at Z = 0, in mm. The scenes of [`crate::scene`] are simpler and drawn
//! flat; these are meant to be as hard as real pictures. The steps of a picture are in [`photo`].

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

/// Red, green and blue: shares of the light that a surface sends back, or light in units of a white surface in full light.
pub type Rgb = [f64; 3];

/// A table with bodies on it.
#[derive(Debug, Clone, PartialEq)]
pub struct World {
    /// The table's surface.
    pub table: Material,
    /// Half of its length and depth, and its middle, in mm.
    pub table_mm: ([f64; 2], Point2<f64>),
    /// The bodies that stand on it or are held above it.
    pub bodies: Vec<Body>,
    /// The light.
    pub light: Light,
}

/// Height of the floor below the table.
const FLOOR_Z_MM: f64 = -740.0;
const FLOOR: Rgb = [0.16, 0.14, 0.13];

/// The meeting of a ray with a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Meeting {
    touch: Touch,
    surface: Surface,
}

/// A surface of the world; a body is given by its index.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Surface {
    Body(usize),
    Table,
    Floor,
}

impl World {
    /// The first surface along the ray that is further than `least`, in lengths of its direction; none where there is none.
    fn meet(&self, ray: &Ray, least: f64) -> Option<Meeting> {
        let mut best: Option<Meeting> = None;
        for (at, body) in self.bodies.iter().enumerate() {
            if let Some(touch) = body.touch(ray, least)
                && best.is_none_or(|best| touch.distance < best.touch.distance)
            {
                best = Some(Meeting { touch, surface: Surface::Body(at) });
            }
        }
        for (level, surface) in [(0.0, Surface::Table), (FLOOR_Z_MM, Surface::Floor)] {
            let distance = (level - ray.origin.z) / ray.direction.z;
            let is_there = surface == Surface::Floor || self.is_table(ray.point_at(distance).xy());
            if distance > least && is_there && best.is_none_or(|best| distance < best.touch.distance) {
                best = Some(Meeting { touch: Touch { distance, normal: Vector3::z() }, surface });
            }
        }
        best
    }

    fn is_table(&self, point: Point2<f64>) -> bool {
        let ([half_x, half_y], middle) = self.table_mm;
        (point.x - middle.x).abs() <= half_x && (point.y - middle.y).abs() <= half_y
    }

    /// Whether a body that lets no light through stands in the way of the ray, before one length of its direction.
    fn is_dark(&self, ray: &Ray) -> bool {
        self.bodies
            .iter()
            .any(|body| body.material.clear < 0.5 && body.touch(ray, 1e-6).is_some_and(|touch| touch.distance < 1.0))
    }

    /// The distance to the first surface along a ray, in lengths of its direction; none where it meets no surface.
    #[must_use]
    pub fn distance(&self, ray: &Ray) -> Option<f64> {
        self.meet(ray, 1e-6).map(|meeting| meeting.touch.distance)
    }

    /// Whether `point` can be seen from `from`: nothing lies between, apart from clear glass and surfaces `within_mm` of the point.
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
