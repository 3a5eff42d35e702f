//! Knives, forks and spoons.

use nalgebra::{Point3, Rotation3, Vector3};
use rand::Rng;

use crate::world::{Body, Form, Material, Rgb, Texture};

const STEEL: Rgb = [0.5, 0.5, 0.52];

/// A utensil, by the part at the end of its handle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub(in crate::laid) enum Utensil {
    /// A spoon, with a hollow.
    Spoon,
    /// A fork, with four prongs.
    Fork,
    /// A knife, with a blade.
    Knife,
}

/// A piece of cutlery: a handle with a blade, prongs or a hollow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::laid) struct Cutlery {
    pub utensil: Utensil,
    /// End of the handle.
    pub at_mm: Point3<f64>,
    /// Direction of the handle about Z, from X to Y.
    pub turn_rad: f64,
    /// Rise of the handle above the horizontal.
    pub rise_rad: f64,
}

impl Cutlery {
    /// A random piece of cutlery at a place.
    pub fn random(random: &mut impl Rng, at_mm: Point3<f64>, turn_rad: f64, rise_rad: f64) -> Self {
        let utensil = match random.random_range(0..3) {
            0 => Utensil::Spoon,
            1 => Utensil::Fork,
            _ => Utensil::Knife,
        };
        Self { utensil, at_mm, turn_rad, rise_rad }
    }

    pub fn bodies(&self) -> Vec<Body> {
        let Self { at_mm, turn_rad, rise_rad, .. } = *self;
        let steel = Material { texture: Texture::Plain(STEEL), gloss: 0.55, clear: 0.0, glows: false };
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), turn_rad)
            * Rotation3::from_axis_angle(&Vector3::y_axis(), -rise_rad);
        let place = |x: f64, y: f64, z: f64| at_mm + turn * Vector3::new(x, y, z);
        let body = |form: Form| Body { form, material: steel.clone() };
        let rod = |a: Point3<f64>, b: Point3<f64>, radius: f64| body(Form::Capsule { ends: [a, b], radius });
        let mut bodies = vec![rod(place(0.0, 0.0, 4.0), place(110.0, 0.0, 4.0), 3.5)];
        match self.utensil {
            Utensil::Spoon => bodies.push(body(Form::Ellipsoid {
                center: place(130.0, 0.0, 4.0),
                half: Vector3::new(27.0, 17.0, 4.0),
                turn_rad,
            })),
            Utensil::Fork => bodies.extend((0..4).map(|prong| {
                let y = f64::from(prong) * 6.0 - 9.0;
                rod(place(118.0, y, 4.5), place(165.0, y, 4.5), 1.5)
            })),
            Utensil::Knife => bodies.push(body(Form::Cuboid {
                center: place(150.0, 0.0, 4.0),
                half: Vector3::new(45.0, 9.0, 1.0),
                turn_rad,
            })),
        }
        bodies
    }
}
