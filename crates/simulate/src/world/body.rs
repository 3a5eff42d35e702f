//! Bodies in the world, and the points where rays meet them.

use nalgebra::{Point3, Rotation3, Vector3};

use super::convex::Convex;
use super::texture::Texture;
use super::turned::Turned;
use crate::scene::Ray;

/// A body on or above the table.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// Its form and its place.
    pub form: Form,
    /// Its surface.
    pub material: Material,
}

/// The form of a body. Lengths are in mm, in the world frame.
#[derive(Debug, Clone, PartialEq)]
pub enum Form {
    /// A profile that is turned about an upright axis.
    Turned(Turned),
    /// All points within six planes.
    Convex(Convex),
    /// All points within `radius` of a line.
    Capsule {
        /// The line's ends.
        ends: [Point3<f64>; 2],
        /// Half of its thickness.
        radius: f64,
    },
    /// A box that is turned about an upright axis.
    Cuboid {
        /// Its middle.
        center: Point3<f64>,
        /// Half its sides.
        half: Vector3<f64>,
        /// Turn about Z, radians, from X to Y.
        turn_rad: f64,
    },
    /// An ellipsoid that is turned about an upright axis.
    Ellipsoid {
        /// Its middle.
        center: Point3<f64>,
        /// Half its axes.
        half: Vector3<f64>,
        /// Turn about Z, radians, from X to Y.
        turn_rad: f64,
    },
}

/// The surface of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Its colours.
    pub texture: Texture,
    /// Share of the light that it mirrors when it is looked at squarely: 0.04 for glaze and varnish, 0.6 for steel, 0 for cloth.
    pub gloss: f64,
    /// Share of the light that goes straight through, as through glass.
    pub clear: f64,
    /// Whether it gives light itself.
    pub glows: bool,
}

/// A point where a ray meets a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Touch {
    /// Distance from the origin of the ray, in lengths of its direction.
    pub distance: f64,
    /// Unit normal, on either side of the surface.
    pub normal: Vector3<f64>,
}

impl Material {
    /// A matt surface, without gloss.
    #[must_use]
    pub fn matt(texture: Texture) -> Self {
        Self { texture, gloss: 0.0, clear: 0.0, glows: false }
    }

    /// A glazed or varnished surface.
    #[must_use]
    pub fn glazed(texture: Texture) -> Self {
        Self { gloss: 0.04, ..Self::matt(texture) }
    }
}

impl Body {
    /// The nearest point of the body along the ray that is further than `least`, in lengths of the ray's direction; none where the
    /// ray meets no such point.
    pub(super) fn touch(&self, ray: &Ray, least: f64) -> Option<Touch> {
        let (center, reach) = self.ball();
        if !passes(ray, center, reach) {
            return None;
        }
        match &self.form {
            Form::Turned(turned) => turned.touch(ray, least),
            Form::Convex(convex) => convex.touch(ray, least),
            Form::Capsule { ends, radius } => capsule(ray, *ends, *radius, least),
            Form::Cuboid { center, half, turn_rad } => cuboid(ray, *center, *half, *turn_rad, least),
            Form::Ellipsoid { center, half, turn_rad } => ellipsoid(ray, *center, *half, *turn_rad, least),
        }
    }

    /// Centre and radius of a ball around the body.
    pub(super) fn ball(&self) -> (Point3<f64>, f64) {
        match &self.form {
            Form::Turned(turned) => turned.ball(),
            Form::Convex(convex) => (convex.center, convex.reach_mm),
            Form::Capsule { ends: [a, b], radius } => (nalgebra::center(a, b), 0.5 * (a - b).norm() + radius),
            Form::Cuboid { center, half, .. } => (*center, half.norm()),
            Form::Ellipsoid { center, half, .. } => (*center, half.max()),
        }
    }

    /// A point of the world in the frame of the body's pattern.
    pub(super) fn own(&self, point: Point3<f64>) -> Point3<f64> {
        match &self.form {
            Form::Turned(turned) => point - turned.axis_mm().coords.push(0.0),
            Form::Convex(convex) => Point3::from(turn(-convex.turn_rad) * (point - convex.center)),
            Form::Capsule { .. } => point,
            Form::Cuboid { center, turn_rad, .. } | Form::Ellipsoid { center, turn_rad, .. } => {
                Point3::from(turn(-turn_rad) * (point - center))
            }
        }
    }
}

pub(super) fn turn(turn_rad: f64) -> Rotation3<f64> {
    Rotation3::from_axis_angle(&Vector3::z_axis(), turn_rad)
}

/// Whether a ray passes through a ball.
fn passes(ray: &Ray, center: Point3<f64>, reach: f64) -> bool {
    let to_center = center - ray.origin;
    let along = to_center.dot(&ray.direction);
    let (away, length) = (to_center.norm_squared() - reach * reach, ray.direction.norm_squared());
    away < 0.0 || (along > 0.0 && along * along >= away * length)
}

fn nearest(distances: [f64; 2], least: f64) -> Option<f64> {
    distances.into_iter().find(|distance| *distance > least)
}

/// The nearest point of a capsule (after Quilez): first of the cylinder about the line, and then of the balls at its ends.
fn capsule(ray: &Ray, [a, b]: [Point3<f64>; 2], radius: f64, least: f64) -> Option<Touch> {
    let axis = (b - a).try_normalize(1e-9).unwrap_or_else(Vector3::z);
    let length = (b - a).norm();
    let across = |v: Vector3<f64>| v - axis * v.dot(&axis);
    let (o, d) = (across(ray.origin - a), across(ray.direction));
    let mut best: Option<f64> = None;
    let mut offer = |distance: f64| {
        if distance > least && best.is_none_or(|b| distance < b) {
            best = Some(distance);
        }
    };
    for distance in roots(d.norm_squared(), o.dot(&d), o.norm_squared() - radius * radius).into_iter().flatten() {
        if (0.0..=length).contains(&(ray.point_at(distance) - a).dot(&axis)) {
            offer(distance);
        }
    }
    for (end, is_beyond) in [(a, -1.0), (b, 1.0)] {
        let o = ray.origin - end;
        let c = o.norm_squared() - radius * radius;
        for distance in roots(ray.direction.norm_squared(), o.dot(&ray.direction), c).into_iter().flatten() {
            if is_beyond * (ray.point_at(distance) - end).dot(&axis) >= 0.0 {
                offer(distance);
            }
        }
    }
    let distance = best?;
    let point = ray.point_at(distance);
    let on_axis = a + axis * (point - a).dot(&axis).clamp(0.0, length);
    Some(Touch { distance, normal: (point - on_axis).normalize() })
}

fn cuboid(ray: &Ray, center: Point3<f64>, half: Vector3<f64>, turn_rad: f64, least: f64) -> Option<Touch> {
    let back = turn(-turn_rad);
    let (o, d) = (back * (ray.origin - center), back * ray.direction);
    let (mut enters, mut leaves) = ((f64::MIN, 0), (f64::MAX, 0));
    for axis in 0..3 {
        let sides = [(-half[axis] - o[axis]) / d[axis], (half[axis] - o[axis]) / d[axis]];
        let (near, far) = (sides[0].min(sides[1]), sides[0].max(sides[1]));
        enters = if near > enters.0 { (near, axis) } else { enters };
        leaves = if far < leaves.0 { (far, axis) } else { leaves };
    }
    if enters.0 > leaves.0 {
        return None;
    }
    let (distance, axis) = [enters, leaves].into_iter().find(|(distance, _)| *distance > least)?;
    let mut normal = Vector3::zeros();
    normal[axis] = 1.0;
    Some(Touch { distance, normal: turn(turn_rad) * normal })
}

fn ellipsoid(ray: &Ray, center: Point3<f64>, half: Vector3<f64>, turn_rad: f64, least: f64) -> Option<Touch> {
    let back = turn(-turn_rad);
    let o = (back * (ray.origin - center)).component_div(&half);
    let d = (back * ray.direction).component_div(&half);
    let both = roots(d.norm_squared(), o.dot(&d), o.norm_squared() - 1.0);
    let distance = nearest([both[0]?, both[1]?], least)?;
    let normal = turn(turn_rad) * (o + d * distance).component_div(&half).normalize();
    Some(Touch { distance, normal })
}

/// Both roots of a t^2 + 2 b t + c with b = `half_b`, the smaller one first.
fn roots(a: f64, half_b: f64, c: f64) -> [Option<f64>; 2] {
    let under = half_b * half_b - a * c;
    if under < 0.0 || a < 1e-12 {
        return [None; 2];
    }
    let root = under.sqrt();
    [Some((-half_b - root) / a), Some((-half_b + root) / a)]
}
