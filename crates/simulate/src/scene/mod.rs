//! A container on a table, and the surfaces that a ray meets there. All is in the world frame of `model`: Z up, the table at
//! Z = 0, in mm.

mod bowl;
mod plate;
mod table;
mod tub;

use nalgebra::{Point2, Point3, Vector3};

pub use bowl::Bowl;
pub use plate::{Outline, Plate};
pub use tub::Tub;

/// Red, green and blue from 0 to 255, as in the picture.
pub type Colour = [f32; 3];

/// A container that stands on the table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Solid {
    /// A flat plate: its measured outline lies in the table plane.
    Plate(Plate),
    /// A round bowl with a sloped wall.
    Bowl(Bowl),
    /// A rectangular box with upright walls.
    Tub(Tub),
}

/// A table with one container on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scene {
    /// The container.
    pub solid: Solid,
    /// The container's colour in full light.
    pub colour: Colour,
}

/// A line of sight: from `origin` along `direction` (of any length).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// The point where it starts, in mm.
    pub origin: Point3<f64>,
    /// Its direction. The length matters only for distances, which are in units of it.
    pub direction: Vector3<f64>,
}

impl Ray {
    /// The point at a distance, which is in lengths of the direction.
    pub(crate) fn point_at(&self, distance: f64) -> Point3<f64> {
        self.origin + self.direction * distance
    }

    /// The distance, in lengths of the direction, to the level plane at height `z_mm`; none where the ray does not meet it.
    fn to_level(self, z_mm: f64) -> Option<f64> {
        let distance = (z_mm - self.origin.z) / self.direction.z;
        (distance > 0.0 && distance.is_finite()).then_some(distance)
    }
}

/// The parts of a scene, between which a picture has edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// Nothing: above the horizon, or where the lens shows nothing.
    Nothing,
    /// The table.
    Table,
    /// A plate, or the floor of a container.
    Floor,
    /// A wall, seen from inside.
    InnerWall,
    /// A wall, seen from outside.
    OuterWall,
    /// The upper edge of a wall.
    Rim,
}

/// A surface that a ray meets.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Hit {
    distance: f64,
    part: Part,
    /// Unit normal, on the side that the ray comes from.
    normal: Vector3<f64>,
    /// The share of light that nearby surfaces leave: 1 in the open.
    openness: f64,
}

impl Scene {
    /// The part that `ray` meets first, and its colour.
    #[must_use]
    pub fn seen_along(&self, ray: &Ray) -> (Part, Colour) {
        if let Some(hit) = self.hit(ray) {
            return (hit.part, lit(self.colour, &hit));
        }
        match ray.to_level(0.0) {
            Some(distance) => {
                let point = ray.point_at(distance).xy();
                let light = self.light_on_table(point);
                (Part::Table, table::colour_at(point).map(|c| c * light))
            }
            None => (Part::Nothing, [0.0; 3]),
        }
    }

    fn hit(&self, ray: &Ray) -> Option<Hit> {
        match &self.solid {
            Solid::Plate(plate) => plate.hit(ray),
            Solid::Bowl(bowl) => bowl.hit(ray),
            Solid::Tub(tub) => tub.hit(ray),
        }
    }

    /// The share of light that reaches the table at `point`. It is less in a soft contact shadow, drawn away from the lamp.
    #[expect(clippy::cast_possible_truncation, reason = "a colour needs no more than 24 bits")]
    fn light_on_table(&self, point: Point2<f64>) -> f32 {
        let (outside, height) = match &self.solid {
            Solid::Plate(plate) => (plate.distance_outside(point - shadow_offset(PLATE_LIFT_MM)), PLATE_LIFT_MM),
            Solid::Bowl(bowl) => (bowl.distance_outside(point - shadow_offset(bowl.height_mm)), bowl.height_mm),
            Solid::Tub(tub) => (tub.distance_outside(point - shadow_offset(tub.height_mm)), tub.height_mm),
        };
        let blur = 5.0 + 0.4 * height;
        (1.0 - 0.42 * (-(outside.max(0.0) / blur).powi(2)).exp()) as f32
    }
}

/// Apparent height of a plate, used for its shadow alone.
const PLATE_LIFT_MM: f64 = 10.0;

/// Direction to the lamp, which is at the upper left behind the table. It is not normalised.
const TO_LAMP: Vector3<f64> = Vector3::new(-0.45, 0.4, 0.8);

fn shadow_offset(height_mm: f64) -> nalgebra::Vector2<f64> {
    TO_LAMP.xy() * (-0.5 * height_mm / TO_LAMP.z)
}

/// The colour of a surface in the light, by Lambert's law with a share of ambient light.
#[expect(clippy::cast_possible_truncation, reason = "a colour needs no more than 24 bits")]
fn lit(colour: Colour, hit: &Hit) -> Colour {
    let lambert = hit.normal.dot(&TO_LAMP.normalize()).max(0.0);
    let light = ((0.55 + 0.5 * lambert) * hit.openness) as f32;
    colour.map(|c| c * light)
}

/// The nearer of two hits.
fn nearer(a: Option<Hit>, b: Option<Hit>) -> Option<Hit> {
    match (a, b) {
        (Some(a), Some(b)) => Some(if a.distance <= b.distance { a } else { b }),
        (a, b) => a.or(b),
    }
}
