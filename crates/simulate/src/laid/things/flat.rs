//! Napkins and telephones.

use std::f64::consts::PI;

use nalgebra::{Point2, Point3, Vector3};
use rand::Rng;

use crate::world::{Body, Form, Material, Rgb, Texture};

/// A folded napkin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::laid) struct Napkin {
    pub at_mm: Point2<f64>,
    /// Half of its sides.
    pub half_mm: [f64; 2],
    pub turn_rad: f64,
    pub colour: Rgb,
    /// Seed of its random weave.
    pub seed: u64,
}

impl Napkin {
    pub fn random(random: &mut impl Rng, at_mm: Point2<f64>) -> Self {
        let colour = [[0.85, 0.83, 0.8], [0.55, 0.12, 0.12], [0.2, 0.3, 0.5]][random.random_range(0..3)];
        let seed = random.random();
        let half_mm = [random.random_range(50.0..85.0), random.random_range(50.0..85.0)];
        Self { at_mm, half_mm, turn_rad: random.random_range(0.0..PI), colour, seed }
    }

    pub fn bodies(&self) -> Vec<Body> {
        let colours = [self.colour, self.colour.map(|c| 0.8 * c)];
        let texture = Texture::Cloth { colours, stripe_mm: 22.0, checks: true, seed: self.seed };
        let half = Vector3::new(self.half_mm[0], self.half_mm[1], 2.0);
        vec![slab(self.at_mm, 2.0, half, self.turn_rad, Material::matt(texture))]
    }
}

/// A telephone with a lit screen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::laid) struct Telephone {
    pub at_mm: Point2<f64>,
    pub turn_rad: f64,
    /// Seed of its random text.
    pub seed: u64,
}

impl Telephone {
    pub fn random(random: &mut impl Rng, at_mm: Point2<f64>) -> Self {
        let turn_rad = random.random_range(-0.7..0.7);
        Self { at_mm, turn_rad, seed: random.random() }
    }

    pub fn bodies(&self) -> Vec<Body> {
        let case = Material::glazed(Texture::Plain([0.03; 3]));
        let screen = Material { glows: true, ..Material::glazed(Texture::Screen { seed: self.seed }) };
        vec![
            slab(self.at_mm, 4.0, Vector3::new(37.0, 76.0, 4.0), self.turn_rad, case),
            slab(self.at_mm, 8.0, Vector3::new(33.0, 70.0, 0.3), self.turn_rad, screen),
        ]
    }
}

fn slab(at_mm: Point2<f64>, z_mm: f64, half: Vector3<f64>, turn_rad: f64, material: Material) -> Body {
    Body { form: Form::Cuboid { center: Point3::new(at_mm.x, at_mm.y, z_mm), half, turn_rad }, material }
}
