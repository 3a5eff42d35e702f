//! Drinking glasses.

use nalgebra::Point2;
use rand::Rng;

use crate::world::{Body, Form, Material, Rgb, Texture, Turned};

/// The outline of a drinking glass. It is none of the containers, but it is round, and higher than it is wide.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vessel {
    /// The point where its axis meets the table.
    pub at_mm: Point2<f64>,
    /// Diameters of foot and rim.
    pub diameters_mm: [f64; 2],
    /// Height from the table to the rim.
    pub height_mm: f64,
}

/// A drinking glass that one can see through, with a drink in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::laid) struct Glass {
    pub vessel: Vessel,
    /// Share of its height that is filled.
    pub full: f64,
    /// Share of the light that goes through the drink.
    pub drink: Rgb,
}

pub(in crate::laid) const WATER: Rgb = [0.97, 0.99, 1.0];
const JUICE: Rgb = [0.9, 0.55, 0.15];
/// Thickness of the bottom.
const BOTTOM_MM: f64 = 6.0;

impl Glass {
    /// A random glass at a place.
    pub fn random(random: &mut impl Rng, at_mm: Point2<f64>) -> Self {
        let (top, foot) = (random.random_range(30.0..42.0), random.random_range(24.0..30.0));
        let height_mm = random.random_range(85.0..140.0);
        let full = random.random_range(0.3..0.8);
        let drink = if random.random_bool(0.5) { WATER } else { JUICE };
        Self { vessel: Vessel { at_mm, diameters_mm: [2.0 * foot, 2.0 * top], height_mm }, full, drink }
    }

    pub fn bodies(&self) -> Vec<Body> {
        let Vessel { at_mm, diameters_mm, height_mm } = self.vessel;
        let [foot, top] = diameters_mm.map(|diameter| 0.5 * diameter);
        let clear = |colour: Rgb| Material { texture: Texture::Plain(colour), gloss: 0.06, clear: 0.9, glows: false };
        let outside = [
            [0.0, 0.0],
            [foot, 0.0],
            [top, height_mm],
            [top - 2.0, height_mm],
            [foot - 2.0, BOTTOM_MM],
            [0.0, BOTTOM_MM],
        ];
        let [z, r] = [BOTTOM_MM + self.full * (height_mm - BOTTOM_MM), foot - 2.5 + self.full * (top - foot)];
        let drink = [[foot - 2.5, BOTTOM_MM + 0.5], [r, z], [0.0, z]];
        let turned = |profile: &[[f64; 2]]| Form::Turned(Turned::new(at_mm, profile));
        vec![
            Body { form: turned(&outside), material: clear([0.96, 0.98, 0.98]) },
            Body { form: turned(&drink), material: clear(self.drink) },
        ]
    }
}
