//! Convex forms with six sides: prisms with slanted ends, which make up the flange of a rectangular plate.

use nalgebra::{Point3, Vector3};

use super::body::{Touch, turn};
use crate::scene::Ray;

/// A form of all points on the inner side of six planes, turned about an upright axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Convex {
    /// Origin of its own frame.
    pub center: Point3<f64>,
    /// Turn about Z, radians, from X to Y.
    pub turn_rad: f64,
    /// The outward unit normal of each plane in the form's own frame, and its distance from the origin.
    pub sides: [(Vector3<f64>, f64); 6],
    /// Radius of a ball about `center` that holds the form.
    pub reach_mm: f64,
}

impl Convex {
    /// The nearest point of the form along the ray that is further than `least`, in lengths of the ray's direction.
    pub(super) fn touch(&self, ray: &Ray, least: f64) -> Option<Touch> {
        let back = turn(-self.turn_rad);
        let (o, d) = (back * (ray.origin - self.center), back * ray.direction);
        let (mut enters, mut leaves) = ((f64::MIN, Vector3::z()), (f64::MAX, Vector3::z()));
        for (normal, offset) in &self.sides {
            let (clear, closing) = (offset - normal.dot(&o), normal.dot(&d));
            if closing.abs() < 1e-12 {
                if clear < 0.0 {
                    return None; // beside it, along its side
                }
                continue;
            }
            let at = clear / closing;
            if closing < 0.0 && at > enters.0 {
                enters = (at, *normal);
            }
            if closing > 0.0 && at < leaves.0 {
                leaves = (at, *normal);
            }
        }
        if enters.0 > leaves.0 {
            return None;
        }
        let (distance, normal) = [enters, leaves].into_iter().find(|(distance, _)| *distance > least)?;
        Some(Touch { distance, normal: turn(self.turn_rad) * normal })
    }
}
