//! Tableware and boxes: forms from a few sizes.

use model::{Kind, Shape};
use nalgebra::{Point2, Point3, Vector3};

use crate::world::{Body, Form, Material, Turned};

/// How a bowl's wall rises from foot to rim.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Wall {
    /// A cone; upright where foot and rim are as wide.
    Straight,
    /// Steeper towards the rim, as part of an ellipse: 1 a quarter of it, 0 a cone.
    Curved(f64),
}

/// A container: its true sizes in mm, and what they leave open.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ware {
    /// Plate, bowl or box.
    pub kind: Kind,
    /// Largest diameter of the rim; long side of a box.
    pub diameter_mm: f64,
    /// Short side of a box; else the diameter.
    pub width_mm: f64,
    /// From the table to the top of the rim.
    pub height_mm: f64,
    /// Diameter of the foot ring, or of the foot.
    pub foot_mm: f64,
    /// Of plates: diameter of the well; the same as the diameter for a coupe without a flange.
    pub well_mm: f64,
    /// Thickness of wall and rim.
    pub thickness_mm: f64,
    /// Of bowls.
    pub wall: Wall,
}

/// Height of a foot ring.
const FOOT_RING_MM: f64 = 3.0;
/// Lines along a curved wall, and around half of a rounded rim.
const WALL_LINES: u32 = 10;
const LIP_LINES: u32 = 6;

impl Ware {
    /// What `model` calls its outline.
    #[must_use]
    pub fn shape(&self) -> Shape {
        if self.kind == Kind::Box { Shape::Rectangle } else { Shape::Circle }
    }

    /// Height of the level at which the rim is widest: its rounded edge lies half a thickness below the top.
    #[must_use]
    pub fn rim_level_mm(&self) -> f64 {
        if self.kind == Kind::Box { self.height_mm } else { self.height_mm - 0.5 * self.thickness_mm }
    }

    /// Height and radius of the surface of food that fills it so far (from 0 to 1).
    #[must_use]
    pub fn filled_mm(&self, share: f64) -> [f64; 2] {
        let floor = FOOT_RING_MM + self.thickness_mm;
        let z = floor + share * (self.height_mm - floor);
        let inner = match self.kind {
            Kind::Plate => 0.5 * self.well_mm * 0.9,
            _ => self.wall_radius_mm(z) - self.thickness_mm,
        };
        [z, inner]
    }

    /// The container on the table, turned about Z.
    #[must_use]
    pub fn bodies(&self, at_mm: Point2<f64>, turn_rad: f64, material: &Material) -> Vec<Body> {
        match self.kind {
            Kind::Box => self.box_bodies(at_mm, turn_rad, material),
            Kind::Plate => vec![self.turned(at_mm, material, &self.plate_profile())],
            Kind::Bowl => vec![self.turned(at_mm, material, &self.bowl_profile())],
        }
    }

    fn turned(&self, at_mm: Point2<f64>, material: &Material, profile: &[[f64; 2]]) -> Body {
        Body { form: Form::Turned(Turned::new(at_mm, profile)), material: material.clone() }
    }

    /// Outer radius of a bowl's wall at a height.
    fn wall_radius_mm(&self, z_mm: f64) -> f64 {
        let (foot, rim) = (0.5 * self.foot_mm, 0.5 * self.diameter_mm);
        let share = ((z_mm - FOOT_RING_MM) / (self.rim_level_mm() - FOOT_RING_MM)).clamp(0.0, 1.0);
        let reach = match self.wall {
            Wall::Straight => share,
            Wall::Curved(round) => (1.0 - round) * share + round * (1.0 - (1.0 - share).powi(2)).sqrt(),
        };
        foot + (rim - foot) * reach
    }

    /// From the foot ring up the outside, around the rim, and down the inside.
    fn bowl_profile(&self) -> Vec<[f64; 2]> {
        let (foot, t) = (0.5 * self.foot_mm, self.thickness_mm);
        let level = self.rim_level_mm();
        let height = |line: u32, from: f64| from + (level - from) * f64::from(line) / f64::from(WALL_LINES);
        let mut profile = vec![[foot - t, 0.0], [foot, 0.0]];
        profile.extend((0..=WALL_LINES).map(|line| height(line, FOOT_RING_MM)).map(|z| [self.wall_radius_mm(z), z]));
        profile.extend(self.lip(0.5 * self.diameter_mm - 0.5 * t));
        let floor = FOOT_RING_MM + t;
        let inside = (0..=WALL_LINES).rev().map(|line| height(line, floor));
        profile.extend(inside.map(|z| [(self.wall_radius_mm(z) - t).max(0.0), z]));
        profile.push([0.0, floor]);
        profile
    }

    /// From the foot ring along the underside, around the rim, down the flange to the well.
    fn plate_profile(&self) -> Vec<[f64; 2]> {
        let (foot, rim, well, t) = (0.5 * self.foot_mm, 0.5 * self.diameter_mm, 0.5 * self.well_mm, self.thickness_mm);
        let (level, floor) = (self.rim_level_mm(), FOOT_RING_MM + t);
        let mut profile = vec![[foot - 4.0, 0.0], [foot, 0.0], [foot + 2.0, FOOT_RING_MM]];
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
            let side =
                |share: f64| [foot + (rim - foot) * share, FOOT_RING_MM + (level - FOOT_RING_MM) * share.powf(1.6)];
            profile.extend(up.clone().map(side));
            profile.extend(self.lip(rim - 0.5 * t));
            profile.extend(up.rev().map(side).map(|[r, z]| [r - 0.3 * t, z + t]));
        }
        profile.push([0.0, floor]);
        profile
    }

    /// The rounded rim, from its outside over its top to its inside.
    fn lip(&self, radius_mm: f64) -> Vec<[f64; 2]> {
        let half = 0.5 * self.thickness_mm;
        let angle = |line: u32| f64::from(line) / f64::from(LIP_LINES) * std::f64::consts::PI;
        (0..=LIP_LINES).map(angle).map(|a| [radius_mm + half * a.cos(), self.rim_level_mm() + half * a.sin()]).collect()
    }

    /// Four walls and a floor.
    fn box_bodies(&self, at_mm: Point2<f64>, turn_rad: f64, material: &Material) -> Vec<Body> {
        let (x, y, z, t) = (0.5 * self.diameter_mm, 0.5 * self.width_mm, 0.5 * self.height_mm, 0.5 * self.thickness_mm);
        let parts = [
            ([x - t, 0.0, z], [t, y, z]),
            ([t - x, 0.0, z], [t, y, z]),
            ([0.0, y - t, z], [x, t, z]),
            ([0.0, t - y, z], [x, t, z]),
            ([0.0, 0.0, t], [x, y, t]),
        ];
        let turn = nalgebra::Rotation3::from_axis_angle(&Vector3::z_axis(), turn_rad);
        let place = |center: [f64; 3]| Point3::new(at_mm.x, at_mm.y, 0.0) + turn * Vector3::from(center);
        parts
            .map(|(center, half)| Body {
                form: Form::Cuboid { center: place(center), half: Vector3::from(half), turn_rad },
                material: material.clone(),
            })
            .to_vec()
    }
}
