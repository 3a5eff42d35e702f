//! A round bowl: the shell of a cone between a foot circle on the table and a rim circle above it.

use nalgebra::{Point2, Point3, Vector3};

use super::{Hit, Part, Ray, nearer};

/// A bowl on the table. Its wall has no thickness, except for the rim, which is drawn inwards from the rim circle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bowl {
    /// The point where the axis meets the table.
    pub center_mm: Point2<f64>,
    /// Radius of the foot at the table.
    pub foot_radius_mm: f64,
    /// Radius of the rim.
    pub rim_radius_mm: f64,
    /// Height of the rim above the table.
    pub height_mm: f64,
}

/// Width of the drawn rim as a share of its radius.
const RIM_SHARE: f64 = 0.03;

impl Bowl {
    /// The increase of the radius per mm of height.
    fn flare(&self) -> f64 {
        (self.rim_radius_mm - self.foot_radius_mm) / self.height_mm
    }

    /// The surface of the bowl that the ray meets first.
    pub(super) fn hit(&self, ray: &Ray) -> Option<Hit> {
        nearer(nearer(self.hit_rim(ray), self.hit_wall(ray)), self.hit_floor(ray))
    }

    fn axis_distance_mm(&self, point: Point3<f64>) -> f64 {
        (point.xy() - self.center_mm).norm()
    }

    fn hit_rim(&self, ray: &Ray) -> Option<Hit> {
        let distance = ray.to_level(self.height_mm)?;
        let radius = self.axis_distance_mm(ray.point_at(distance));
        ((1.0 - RIM_SHARE) * self.rim_radius_mm..=self.rim_radius_mm).contains(&radius).then_some(Hit {
            distance,
            part: Part::Rim,
            normal: Vector3::z(),
            openness: 1.06,
        })
    }

    fn hit_floor(&self, ray: &Ray) -> Option<Hit> {
        let distance = ray.to_level(0.0)?;
        let share = self.axis_distance_mm(ray.point_at(distance)) / self.foot_radius_mm;
        let openness = 0.9 - 0.12 * share.powi(4);
        (share <= 1.0).then_some(Hit { distance, part: Part::Floor, normal: Vector3::z(), openness })
    }

    /// The nearest point of the cone between foot and rim: |p - axis| = foot + flare z, a quadratic along the ray.
    fn hit_wall(&self, ray: &Ray) -> Option<Hit> {
        let flare = self.flare();
        let (d, o) = (ray.direction, ray.origin.xy() - self.center_mm);
        let (radius_0, radius_1) = (self.foot_radius_mm + flare * ray.origin.z, flare * d.z);
        let a = d.xy().norm_squared() - radius_1 * radius_1;
        let half_b = o.dot(&d.xy()) - radius_0 * radius_1;
        let c = o.norm_squared() - radius_0 * radius_0;
        let root = (half_b * half_b - a * c).sqrt(); // NaN: the ray misses
        [(-half_b - root) / a, (-half_b + root) / a]
            .into_iter()
            .filter(|&distance| distance > 0.0 && (0.0..=self.height_mm).contains(&ray.point_at(distance).z))
            .min_by(f64::total_cmp)
            .map(|distance| self.wall_at(ray, distance))
    }

    fn wall_at(&self, ray: &Ray, distance: f64) -> Hit {
        let point = ray.point_at(distance);
        let outwards = (point.xy() - self.center_mm).push(0.0).normalize();
        let outer_normal = (outwards - Vector3::z() * self.flare()).normalize();
        let height_share = point.z / self.height_mm;
        if outer_normal.dot(&ray.direction) < 0.0 {
            Hit { distance, part: Part::OuterWall, normal: outer_normal, openness: 0.82 + 0.12 * height_share }
        } else {
            Hit { distance, part: Part::InnerWall, normal: -outer_normal, openness: 0.8 + 0.15 * height_share }
        }
    }

    /// The distance of a point of the table from the foot, in mm; negative inside.
    pub(super) fn distance_outside(&self, point: Point2<f64>) -> f64 {
        (point - self.center_mm).norm() - self.foot_radius_mm
    }
}
