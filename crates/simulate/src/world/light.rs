//! Light: a lamp with soft shadows, the light of the room, a window, and their reflections.

use nalgebra::{Point3, Vector3};

use super::chance::noise;
use super::texture::mix;
use super::{FLOOR, Meeting, Rgb, Surface, World};
use crate::scene::Ray;

/// How often a ray is followed through glass and off mirrors at most.
const MOST_TURNS: u32 = 4;
/// Distance from a surface, in mm, at which rays that leave it begin.
const CLEAR_MM: f64 = 1e-3;
/// Width of the lamp's soft highlight, which adds to the sharp reflection of the gloss, as the power of a cosine.
const HIGHLIGHT: f64 = 60.0;

/// The light of the lamp and of the room.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light {
    /// The middle of the lamp.
    pub lamp_mm: Point3<f64>,
    /// Half of the lamp's extent along X and Y. Large lamps make soft shadows.
    pub lamp_half_mm: [f64; 2],
    /// The light that a level white surface below the lamp gets from the lamp.
    pub lamp: Rgb,
    /// The light that such a surface in the open gets from the room.
    pub room: Rgb,
    /// Direction of a window, which glossy surfaces mirror: the angle about Z from X to Y, in radians.
    pub window_rad: f64,
}

/// The light and the surface that a ray has seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sight {
    pub light: Rgb,
    /// The surface that the ray met first. Where neighbours differ in it, or in `is_lit`, more rays are needed.
    pub met: Option<Surface>,
    pub is_lit: bool,
}

impl World {
    /// The light that comes back along `ray`, with one place `lamp_at` of the lamp (both coordinates from 0 to 1) in place of the
    /// whole lamp.
    pub(super) fn sight(&self, ray: &Ray, lamp_at: [f64; 2]) -> Sight {
        let Some(meeting) = self.meet(ray, 0.0) else {
            return Sight { light: self.around(ray.direction), met: None, is_lit: true };
        };
        let (light, is_lit) = self.seen(ray, &meeting, lamp_at, MOST_TURNS);
        Sight { light, met: Some(meeting.surface), is_lit }
    }

    fn seen(&self, ray: &Ray, meeting: &Meeting, lamp_at: [f64; 2], turns: u32) -> (Rgb, bool) {
        let point = ray.point_at(meeting.touch.distance);
        let to_eye = -ray.direction.normalize();
        let normal = meeting.touch.normal * if meeting.touch.normal.dot(&to_eye) < 0.0 { -1.0 } else { 1.0 };
        let (material, own) = match meeting.surface {
            Surface::Floor => {
                let worn = 0.8 + 0.4 * noise([point.x / 90.0, point.y / 90.0], 7);
                return (FLOOR.map(|c| c * worn), true);
            }
            Surface::Table => (&self.table, point),
            Surface::Body(at) => (&self.bodies[at].material, self.bodies[at].own(point)),
        };
        let colour = material.texture.colour_at(own);
        if material.glows {
            return (colour, true);
        }
        let (lamp, is_lit, shine) = self.lamp_on(point, normal, to_eye, lamp_at);
        let open = self.openness(point, normal, meeting.surface);
        let diffuse = (1.0 - material.gloss) * (1.0 - material.clear);
        let mut light: Rgb = std::array::from_fn(|i| {
            diffuse * colour[i] * (lamp[i] + open * self.light.room[i]) + material.gloss * 6.0 * shine * lamp[i]
        });
        if turns > 0 && material.clear > 0.0 {
            let on = self.followed(point, ray.direction, lamp_at, turns);
            light = std::array::from_fn(|i| light[i] + material.clear * colour[i] * on[i]);
        }
        if turns > 0 && material.gloss > 0.0 {
            let cosine = normal.dot(&to_eye).clamp(0.0, 1.0);
            // After Schlick (1994), surfaces mirror more at grazing angles.
            let mirrored = material.gloss + (1.0 - material.gloss) * (1.0 - cosine).powi(5);
            let away = 2.0 * normal.dot(&to_eye) * normal - to_eye;
            let off = self.followed(point + normal * CLEAR_MM, away, lamp_at, turns.min(2));
            light = mix(light, off, mirrored.min(0.9));
        }
        (light, is_lit)
    }

    fn followed(&self, from: Point3<f64>, direction: Vector3<f64>, lamp_at: [f64; 2], turns: u32) -> Rgb {
        let ray = Ray { origin: from, direction: direction.normalize() };
        match self.meet(&ray, CLEAR_MM) {
            Some(meeting) => self.seen(&ray, &meeting, lamp_at, turns - 1).0,
            None => self.around(ray.direction),
        }
    }

    /// The lamp's light on a surface (Lambert), whether there is any, and the share of its highlight that the eye gets.
    fn lamp_on(
        &self,
        point: Point3<f64>,
        normal: Vector3<f64>,
        to_eye: Vector3<f64>,
        at: [f64; 2],
    ) -> (Rgb, bool, f64) {
        let Light { lamp_mm, lamp_half_mm, lamp, .. } = self.light;
        let place =
            lamp_mm + Vector3::new((2.0 * at[0] - 1.0) * lamp_half_mm[0], (2.0 * at[1] - 1.0) * lamp_half_mm[1], 0.0);
        let to_lamp = place - point;
        let unit = to_lamp.normalize();
        let facing = normal.dot(&unit);
        let origin = point + normal * CLEAR_MM;
        if facing <= 0.0 || self.is_dark(&Ray { origin, direction: place - origin }) {
            return ([0.0; 3], false, 0.0);
        }
        let strength = facing * (lamp_mm.z * lamp_mm.z / to_lamp.norm_squared()) * unit.z.max(0.0);
        let shine = normal.dot(&(unit + to_eye).normalize()).max(0.0).powf(HIGHLIGHT);
        (lamp.map(|c| c * strength), true, shine)
    }

    /// The share of the room's light that reaches a point. Bodies hide as much of it as balls of their size do, in proportion to
    /// the solid angle (the form factor of a ball seen from a surface).
    fn openness(&self, point: Point3<f64>, normal: Vector3<f64>, surface: Surface) -> f64 {
        let mut open = 0.75 + 0.25 * normal.z;
        for (at, body) in self.bodies.iter().enumerate() {
            if surface == Surface::Body(at) || body.material.clear > 0.5 {
                continue;
            }
            let (center, reach) = body.ball();
            let to_center = center - point;
            let distance = to_center.norm().max(1e-6);
            let facing = (normal.dot(&to_center) / distance).max(0.0);
            open *= 1.0 - 0.8 * (facing * (0.7 * reach / distance).min(1.0).powi(2)).min(0.9);
        }
        if let Surface::Body(at) = surface {
            // Hollow bodies also keep light from their own depths.
            let (center, reach) = self.bodies[at].ball();
            let inward = -normal.dot(&((point - center) / reach));
            open *= 1.0 - 0.35 * inward.clamp(0.0, 1.0);
        }
        open
    }

    /// The light that comes from the room in a direction: from walls and ceiling, the window, and the lamp.
    fn around(&self, direction: Vector3<f64>) -> Rgb {
        let d = direction.normalize();
        let wall = mix([0.42, 0.38, 0.34], [0.62, 0.6, 0.57], (0.5 + 0.5 * d.z).clamp(0.0, 1.0));
        let off = (d.y.atan2(d.x) - self.light.window_rad + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU)
            - std::f64::consts::PI;
        let height = d.z.atan2(d.xy().norm());
        let is_pane =
            off.abs() < 0.45 && (0.15..0.85).contains(&height) && (off.abs() > 0.02 && (height - 0.5).abs() > 0.015);
        if is_pane { [2.2, 2.4, 2.7] } else { wall.map(|c| c * (self.light.room[0] + 0.2)) }
    }
}
