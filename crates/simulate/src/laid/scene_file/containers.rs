//! Plates, bowls and boxes of a scene file.

use model::{Kind, Shape};
use nalgebra::Point2;
use serde::Deserialize;

use super::number::{Checked, Name, Percent, Place, Turn, Within, or, point, share};
use super::surface::{Surface, TextureFields};
use crate::laid::ware::{FOOT_RING_MM, Wall, Ware};

/// A size across, in mm.
type Across = Within<20, 1000>;
/// A height, in mm.
type Height = Within<3, 500>;
/// A thickness, in mm.
type Thickness = Within<1, 50>;

/// Width of a plate's flange as a share of its (short) side, where the file gives none.
const FLANGE: f64 = 0.16;
/// A plate's foot as a share of its well, where the file gives none.
const FOOT_OF_WELL: f64 = 0.82;
/// A bowl's foot as a share of its diameter, where the file gives none.
const BOWL_FOOT: f64 = 0.5;

/// A container that can be made.
#[derive(Debug, Clone)]
pub(super) struct Container {
    pub name: String,
    pub ware: Ware,
    pub at_mm: Point2<f64>,
    pub turn_rad: f64,
    /// Its glaze, where the file gives one.
    pub surface: Option<Surface>,
    pub gloss_pct: Option<Percent>,
    /// Share of it that is full at first, from 0 to 1.
    pub full: f64,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PlateFields {
    name: Name,
    at_mm: Option<[Place; 2]>,
    turn_deg: Option<Turn>,
    diameter_mm: Option<Across>,
    width_mm: Option<Across>,
    length_mm: Option<Across>,
    height_mm: Option<Height>,
    foot_mm: Option<Across>,
    foot_ring_mm: Option<Within<0, 50>>,
    well_mm: Option<Across>,
    thickness_mm: Option<Thickness>,
    glaze: Option<Checked<TextureFields, Surface>>,
    gloss_pct: Option<Percent>,
    food_pct: Option<Percent>,
}

/// The form of a bowl's wall, as it is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Profile {
    Straight,
    Sloped,
    Curved,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BowlFields {
    name: Name,
    at_mm: Option<[Place; 2]>,
    diameter_mm: Across,
    height_mm: Height,
    profile: Option<Profile>,
    roundness_pct: Option<Percent>,
    foot_mm: Option<Across>,
    foot_ring_mm: Option<Within<0, 50>>,
    thickness_mm: Option<Thickness>,
    glaze: Option<Checked<TextureFields, Surface>>,
    gloss_pct: Option<Percent>,
    food_pct: Option<Percent>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BoxFields {
    name: Name,
    at_mm: Option<[Place; 2]>,
    turn_deg: Option<Turn>,
    width_mm: Across,
    length_mm: Across,
    height_mm: Height,
    thickness_mm: Option<Thickness>,
    glaze: Option<Checked<TextureFields, Surface>>,
    gloss_pct: Option<Percent>,
    food_pct: Option<Percent>,
}

/// The place of a container; 310 mm in front of the wearer where the file gives none.
fn place(at_mm: Option<[Place; 2]>) -> Point2<f64> {
    at_mm.map_or_else(|| Point2::new(0.0, 310.0), point)
}

/// The value `got` of `key`. Fails where it does not lie between the two limits.
fn check(name: &Name, key: &str, got: f64, [low, high]: [f64; 2]) -> Result<f64, String> {
    if got >= low && got <= high {
        return Ok(got);
    }
    Err(format!("'{}': {key} = {got}, expected {low:.1} to {high:.1}, which its other sizes leave", name.0))
}

/// Refuses a printed glaze, since prints lie about an axis, which a box or a rectangular plate does not have.
fn check_glaze(name: &Name, glaze: Option<&Surface>) -> Result<(), String> {
    match glaze {
        Some(surface) if surface.is_printed() => {
            Err(format!("'{}': glaze printed, expected on round containers only", name.0))
        }
        _ => Ok(()),
    }
}

impl TryFrom<PlateFields> for Container {
    type Error = String;

    fn try_from(plate: PlateFields) -> Result<Self, String> {
        let name = plate.name;
        let (shape, [long, short]) = match (plate.diameter_mm, plate.width_mm, plate.length_mm) {
            (Some(diameter), None, None) => (Shape::Circle, [diameter.get(); 2]),
            (None, Some(width), None) => (Shape::Square, [width.get(); 2]),
            (None, Some(width), Some(length)) => (Shape::Rectangle, [length.get(), width.get()]),
            _ => {
                let expected = "expected diameter_mm (round), width_mm (square), or width_mm and length_mm";
                return Err(format!("'{}': {expected}", name.0));
            }
        };
        check(&name, "width_mm", short, [20.0, long])?;
        if shape != Shape::Circle {
            check_glaze(&name, plate.glaze.as_ref().map(|glaze| &glaze.0))?;
        }
        let ring = or(plate.foot_ring_mm, FOOT_RING_MM);
        let thick = or(plate.thickness_mm, f64::min(5.0, 0.05 * short));
        check(&name, "thickness_mm", thick, [1.0, 0.05 * short])?;
        let height = check(&name, "height_mm", or(plate.height_mm, 24.0), [ring + 1.2 * thick, 0.5 * short])?;
        // A round plate may have no flange, as a coupe.
        let widest = if shape == Shape::Circle { long } else { long - 2.0 * thick };
        let default = long - 2.0 * FLANGE * short;
        let well = check(&name, "well_mm", or(plate.well_mm, default), [long - 0.9 * short, widest])?;
        let well_short = well - long + short;
        let widest = well.min(long - 4.0 * thick);
        let default = widest.min(well - (1.0 - FOOT_OF_WELL) * well_short);
        let foot = check(&name, "foot_mm", or(plate.foot_mm, default), [well - 0.9 * well_short, widest])?;
        let ware = Ware::plate(shape, [long, short], height, foot, well);
        Ok(Self {
            name: name.0,
            ware: Ware { thickness_mm: thick, foot_ring_mm: ring, ..ware },
            at_mm: place(plate.at_mm),
            turn_rad: or(plate.turn_deg, 0.0).to_radians(),
            surface: plate.glaze.map(|glaze| glaze.0),
            gloss_pct: plate.gloss_pct,
            full: plate.food_pct.map_or(0.0, share),
        })
    }
}

impl TryFrom<BowlFields> for Container {
    type Error = String;

    fn try_from(bowl: BowlFields) -> Result<Self, String> {
        let (name, diameter) = (bowl.name, bowl.diameter_mm.get());
        let profile = bowl.profile.unwrap_or(Profile::Curved);
        if bowl.roundness_pct.is_some() && profile != Profile::Curved {
            return Err(format!("'{}': roundness_pct, expected with profile = \"curved\" only", name.0));
        }
        let wall = match profile {
            Profile::Curved => Wall::Curved(bowl.roundness_pct.map_or(0.8, share)),
            Profile::Straight | Profile::Sloped => Wall::Straight,
        };
        let (ring, thick) = (or(bowl.foot_ring_mm, FOOT_RING_MM), or(bowl.thickness_mm, 4.0));
        check(&name, "thickness_mm", thick, [1.0, 0.2 * diameter])?;
        let height = check(&name, "height_mm", bowl.height_mm.get(), [ring + 2.0 * thick, 500.0])?;
        let is_upright = profile == Profile::Straight;
        let default = if is_upright { diameter } else { BOWL_FOOT * diameter };
        let range = if is_upright { [diameter; 2] } else { [2.5 * thick, 1.5 * diameter] };
        let foot = check(&name, "foot_mm", or(bowl.foot_mm, default.max(range[0])), range)?;
        let ware = Ware::bowl(diameter, height, foot, wall);
        Ok(Self {
            name: name.0,
            ware: Ware { thickness_mm: thick, foot_ring_mm: ring, ..ware },
            at_mm: place(bowl.at_mm),
            turn_rad: 0.0,
            surface: bowl.glaze.map(|glaze| glaze.0),
            gloss_pct: bowl.gloss_pct,
            full: bowl.food_pct.map_or(0.0, share),
        })
    }
}

impl TryFrom<BoxFields> for Container {
    type Error = String;

    fn try_from(fields: BoxFields) -> Result<Self, String> {
        let (name, long, short) = (fields.name, fields.length_mm.get(), fields.width_mm.get());
        check(&name, "width_mm", short, [20.0, long])?;
        check_glaze(&name, fields.glaze.as_ref().map(|glaze| &glaze.0))?;
        let thick = check(&name, "thickness_mm", or(fields.thickness_mm, 3.0), [1.0, 0.2 * short])?;
        let height = check(&name, "height_mm", fields.height_mm.get(), [2.0 * thick, 500.0])?;
        let ware = Ware {
            kind: Kind::Box,
            shape: Shape::Rectangle,
            width_mm: short,
            thickness_mm: thick,
            ..Ware::bowl(long, height, long, Wall::Straight)
        };
        Ok(Self {
            name: name.0,
            ware,
            at_mm: place(fields.at_mm),
            turn_rad: or(fields.turn_deg, 0.0).to_radians(),
            surface: fields.glaze.map(|glaze| glaze.0),
            gloss_pct: fields.gloss_pct,
            full: fields.food_pct.map_or(0.0, share),
        })
    }
}
