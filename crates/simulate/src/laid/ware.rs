//! Tableware and boxes: forms that follow from a few sizes.

use model::{Kind, Quantity, Shape};
use nalgebra::Point2;

use super::rectangular;
use crate::world::{Body, Form, Material, Turned};

/// The form of a bowl's wall from foot to rim.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Wall {
    /// A cone. It is upright where foot and rim have the same width.
    Straight,
    /// A wall that is steeper towards the rim, as a part of an ellipse: a quarter of it for 1, and a cone for 0.
    Curved(f64),
}

/// A container, given by its true sizes and by the parts of its form that they leave open.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ware {
    /// Whether it is a plate, a bowl or a box.
    pub kind: Kind,
    /// Its outline from above.
    pub shape: Shape,
    /// Largest diameter of a round rim, side of a square, or long side of a rectangle.
    pub diameter_mm: f64,
    /// Short side of a rectangle, and else the same as the diameter.
    pub width_mm: f64,
    /// Height from the table to the top of the rim.
    pub height_mm: f64,
    /// Diameter of the foot ring or of the foot; for a rectangular plate, the long side of the foot.
    pub foot_mm: f64,
    /// Height of the foot ring.
    pub foot_ring_mm: f64,
    /// Diameter or long side of a plate's well. It is the same as the diameter for a coupe, which has no flange.
    pub well_mm: f64,
    /// Thickness of wall and rim.
    pub thickness_mm: f64,
    /// Form of a bowl's wall.
    pub wall: Wall,
}

/// Height of a foot ring where none is given.
pub(super) const FOOT_RING_MM: f64 = 3.0;
/// Number of lines along a curved wall.
const WALL_LINES: u32 = 10;
/// Number of lines around half of a rounded rim.
const LIP_LINES: u32 = 6;

impl Ware {
    /// A plate with a rim that is 5 mm thick. Both of the sizes across are the diameter where the plate is round.
    pub(super) const fn plate(
        shape: Shape,
        [diameter_mm, width_mm]: [f64; 2],
        height_mm: f64,
        foot_mm: f64,
        well_mm: f64,
    ) -> Self {
        let (kind, foot_ring_mm, thickness_mm, wall) = (Kind::Plate, FOOT_RING_MM, 5.0, Wall::Straight);
        Self { kind, shape, diameter_mm, width_mm, height_mm, foot_mm, foot_ring_mm, well_mm, thickness_mm, wall }
    }

    /// A round bowl with a wall that is 4 mm thick.
    pub(super) const fn bowl(diameter_mm: f64, height_mm: f64, foot_mm: f64, wall: Wall) -> Self {
        let (kind, shape, foot_ring_mm, thickness_mm) = (Kind::Bowl, Shape::Circle, FOOT_RING_MM, 4.0);
        let (width_mm, well_mm) = (diameter_mm, foot_mm);
        Self { kind, shape, diameter_mm, width_mm, height_mm, foot_mm, foot_ring_mm, well_mm, thickness_mm, wall }
    }

    /// Whether it is a surface of revolution.
    #[must_use]
    pub fn is_round(&self) -> bool {
        self.shape == Shape::Circle
    }

    /// The size in one of the directions that the shape has; none for other directions, and for a height.
    #[must_use]
    pub fn across_mm(&self, quantity: Quantity) -> Option<f64> {
        match (self.shape, quantity) {
            (Shape::Circle, Quantity::Diameter) | (Shape::Rectangle, Quantity::Length) => Some(self.diameter_mm),
            (Shape::Square | Shape::Rectangle, Quantity::Width) => Some(self.width_mm),
            _ => None,
        }
    }

    /// Height of the level at which the rim is widest. The rounded edge of a round container lies half a thickness below the top.
    #[must_use]
    pub fn rim_level_mm(&self) -> f64 {
        if self.is_round() { self.height_mm - 0.5 * self.thickness_mm } else { self.height_mm }
    }

    /// Height and radius of the surface of food that fills a `share` of the container, from 0 to 1.
    #[must_use]
    pub fn filled_mm(&self, share: f64) -> [f64; 2] {
        let floor = self.foot_ring_mm + self.thickness_mm;
        let z = floor + share * (self.height_mm - floor);
        let inner = match self.kind {
            Kind::Plate => 0.5 * (self.well_mm - self.diameter_mm + self.width_mm) * 0.9,
            _ => self.wall_radius_mm(z) - self.thickness_mm,
        };
        [z, inner]
    }

    /// The bodies of the container on the table, turned about Z.
    #[must_use]
    pub fn bodies(&self, at_mm: Point2<f64>, turn_rad: f64, material: &Material) -> Vec<Body> {
        match self.kind {
            Kind::Box => rectangular::tub(self, at_mm, turn_rad, material),
            Kind::Plate if !self.is_round() => rectangular::plate(self, at_mm, turn_rad, material),
            Kind::Plate => vec![self.turned(at_mm, material, &self.plate_profile())],
            Kind::Bowl => vec![self.turned(at_mm, material, &self.bowl_profile())],
        }
    }

    fn turned(&self, at_mm: Point2<f64>, material: &Material, profile: &[[f64; 2]]) -> Body {
        Body { form: Form::Turned(Turned::new(at_mm, profile)), material: material.clone() }
    }

    /// The outer radius of a bowl's wall at a height.
    fn wall_radius_mm(&self, z_mm: f64) -> f64 {
        let (foot, rim) = (0.5 * self.foot_mm, 0.5 * self.diameter_mm);
        let ring = self.foot_ring_mm;
        let share = ((z_mm - ring) / (self.rim_level_mm() - ring)).clamp(0.0, 1.0);
        let reach = match self.wall {
            Wall::Straight => share,
            Wall::Curved(round) => (1.0 - round) * share + round * (1.0 - (1.0 - share).powi(2)).sqrt(),
        };
        foot + (rim - foot) * reach
    }

    /// The profile of a bowl: from the foot ring up the outside, around the rim, and down the inside.
    fn bowl_profile(&self) -> Vec<[f64; 2]> {
        let (foot, t) = (0.5 * self.foot_mm, self.thickness_mm);
        let level = self.rim_level_mm();
        let height = |line: u32, from: f64| from + (level - from) * f64::from(line) / f64::from(WALL_LINES);
        let mut profile = vec![[foot - t, 0.0], [foot, 0.0]];
        profile
            .extend((0..=WALL_LINES).map(|line| height(line, self.foot_ring_mm)).map(|z| [self.wall_radius_mm(z), z]));
        profile.extend(self.lip(0.5 * self.diameter_mm - 0.5 * t));
        let floor = self.foot_ring_mm + t;
        let inside = (0..=WALL_LINES).rev().map(|line| height(line, floor));
        profile.extend(inside.map(|z| [(self.wall_radius_mm(z) - t).max(0.0), z]));
        profile.push([0.0, floor]);
        profile
    }

    /// The profile of a plate: from the foot ring along the underside, around the rim, and down the flange to the well.
    fn plate_profile(&self) -> Vec<[f64; 2]> {
        let (foot, rim, well, t) = (0.5 * self.foot_mm, 0.5 * self.diameter_mm, 0.5 * self.well_mm, self.thickness_mm);
        let (ring, level) = (self.foot_ring_mm, self.rim_level_mm());
        let floor = ring + t;
        let mut profile = vec![[foot - 4.0, 0.0], [foot, 0.0], [foot + 2.0, ring]];
        let has_flange = well < 0.95 * rim;
        if has_flange {
            let shoulder = floor + 0.55 * (self.height_mm - floor);
            profile.extend([[well, 0.5 * shoulder], [rim - 0.5 * t, level - 0.5 * t]]);
            profile.extend(self.lip(rim - 0.5 * t));
            let down = (1..=WALL_LINES).map(|line| f64::from(line) / f64::from(WALL_LINES));
            let fall = |share: f64| 0.5 + 0.5 * (std::f64::consts::PI * share).cos();
            profile.push([well, shoulder]);
            profile.extend(down.map(|share| [well * (1.0 - 0.16 * share), floor + (shoulder - floor) * fall(share)]));
        } else {
            let up = (1..WALL_LINES).map(|line| f64::from(line) / f64::from(WALL_LINES));
            let side = |share: f64| [foot + (rim - foot) * share, ring + (level - ring) * share.powf(1.6)];
            profile.extend(up.clone().map(side));
            profile.extend(self.lip(rim - 0.5 * t));
            profile.extend(up.rev().map(side).map(|[r, z]| [r - 0.3 * t, z + t]));
        }
        profile.push([0.0, floor]);
        profile
    }

    /// The profile of the rounded rim, from its outside over its top to its inside.
    fn lip(&self, radius_mm: f64) -> Vec<[f64; 2]> {
        let half = 0.5 * self.thickness_mm;
        let angle = |line: u32| f64::from(line) / f64::from(LIP_LINES) * std::f64::consts::PI;
        (0..=LIP_LINES).map(angle).map(|a| [radius_mm + half * a.cos(), self.rim_level_mm() + half * a.sin()]).collect()
    }
}
