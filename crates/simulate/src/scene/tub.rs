//! A rectangular box without a lid.

use nalgebra::{Point2, Vector2, Vector3};

use super::{Hit, Part, Ray, nearer};

/// A box on the table, with upright walls along X and Y. The walls have no thickness, except for the rim, which is drawn
/// inwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tub {
    /// Centre on the table.
    pub center_mm: Point2<f64>,
    /// Half the extents along X and Y.
    pub half_size_mm: Vector2<f64>,
    /// Height of the rim above the table.
    pub height_mm: f64,
}

/// Width of the drawn rim.
const RIM_MM: f64 = 3.0;

impl Tub {
    /// The surface of the box that the ray meets first.
    pub(super) fn hit(&self, ray: &Ray) -> Option<Hit> {
        let walls = [0, 1].into_iter().flat_map(|axis| [-1.0, 1.0].map(|side| self.hit_wall(ray, axis, side)));
        walls.fold(nearer(self.hit_rim(ray), self.hit_floor(ray)), nearer)
    }

    /// The distance of a point from the nearest wall; positive inside.
    fn depth_inside(&self, point: Point2<f64>) -> f64 {
        let depth = self.half_size_mm - (point - self.center_mm).abs();
        depth.x.min(depth.y)
    }

    fn hit_rim(&self, ray: &Ray) -> Option<Hit> {
        let distance = ray.to_level(self.height_mm)?;
        (0.0..=RIM_MM).contains(&self.depth_inside(ray.point_at(distance).xy())).then_some(Hit {
            distance,
            part: Part::Rim,
            normal: Vector3::z(),
            openness: 1.06,
        })
    }

    fn hit_floor(&self, ray: &Ray) -> Option<Hit> {
        let distance = ray.to_level(0.0)?;
        let depth = self.depth_inside(ray.point_at(distance).xy());
        let openness = 0.92 - 0.14 * (-depth / (0.5 * self.height_mm)).exp();
        (depth >= 0.0).then_some(Hit { distance, part: Part::Floor, normal: Vector3::z(), openness })
    }

    /// The hit on the wall across `axis` (0 for X, 1 for Y) on one `side` (1 or -1) of the centre.
    fn hit_wall(&self, ray: &Ray, axis: usize, side: f64) -> Option<Hit> {
        let wall = self.center_mm[axis] + side * self.half_size_mm[axis];
        let distance = (wall - ray.origin[axis]) / ray.direction[axis];
        if !(distance > 0.0 && distance.is_finite()) {
            return None;
        }
        let point = ray.point_at(distance);
        let other = 1 - axis;
        let on_wall = (point[other] - self.center_mm[other]).abs() <= self.half_size_mm[other];
        if !on_wall || !(0.0..=self.height_mm).contains(&point.z) {
            return None;
        }
        let mut normal = Vector3::zeros();
        normal[axis] = -ray.direction[axis].signum();
        let height_share = point.z / self.height_mm;
        Some(if normal[axis] * side > 0.0 {
            Hit { distance, part: Part::OuterWall, normal, openness: 0.82 + 0.12 * height_share }
        } else {
            Hit { distance, part: Part::InnerWall, normal, openness: 0.8 + 0.15 * height_share }
        })
    }

    /// The distance of a point of the table from the box, in mm; 0 inside.
    pub(super) fn distance_outside(&self, point: Point2<f64>) -> f64 {
        (point - self.center_mm).abs().zip_map(&self.half_size_mm, |d, half| (d - half).max(0.0)).norm()
    }
}
