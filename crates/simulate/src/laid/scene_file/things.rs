//! Other things on the table of a scene file, and hands.

use rand::Rng;
use serde::Deserialize;

use super::number::{Colour, Percent, Place, Turn, Within, or, point, point_above, rgb, share};
use crate::laid::things::{Cutlery, Glass, Hand, Napkin, Telephone, Utensil, Vessel, WATER};
use crate::world::{Body, Rgb};

const LINEN: Rgb = [0.85, 0.83, 0.8];
const SKIN: Rgb = [0.62, 0.42, 0.32];

/// `[[glasses]]`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GlassSpec {
    at_mm: [Place; 2],
    foot_diameter_mm: Option<Within<20, 300>>,
    rim_diameter_mm: Option<Within<20, 300>>,
    height_mm: Option<Within<20, 400>>,
    full_pct: Option<Percent>,
    drink: Option<Colour>,
}

/// `[[cutlery]]`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CutlerySpec {
    kind: Utensil,
    /// End of the handle.
    at_mm: [Place; 2],
    /// Height of the surface that it lies on.
    level_mm: Option<Within<0, 500>>,
    turn_deg: Option<Turn>,
    rise_deg: Option<Within<-90, 90>>,
}

/// `[[napkins]]`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct NapkinSpec {
    at_mm: [Place; 2],
    size_mm: Option<[Within<10, 1000>; 2]>,
    turn_deg: Option<Turn>,
    colour: Option<Colour>,
}

/// `[[telephones]]`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TelephoneSpec {
    at_mm: [Place; 2],
    turn_deg: Option<Turn>,
}

/// `[[hands]]`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct HandFields {
    tip_mm: [Place; 3],
    elbow_mm: [Place; 3],
    skin: Option<Colour>,
    curl_deg: Option<Within<0, 60>>,
    seen_pct: Option<Percent>,
}

/// A hand, and the share of images in which it is there.
#[derive(Debug, Clone)]
pub(super) struct HandSpec {
    hand: Hand,
    seen: f64,
}

impl GlassSpec {
    pub(super) fn glass(&self) -> Glass {
        let diameters_mm = [or(self.foot_diameter_mm, 54.0), or(self.rim_diameter_mm, 72.0)];
        let vessel = Vessel { at_mm: point(self.at_mm), diameters_mm, height_mm: or(self.height_mm, 110.0) };
        Glass { vessel, full: self.full_pct.map_or(0.5, share), drink: self.drink.map_or(WATER, rgb) }
    }
}

impl CutlerySpec {
    pub(super) fn bodies(&self) -> Vec<Body> {
        let [x, y] = self.at_mm.map(Within::get);
        let at_mm = nalgebra::Point3::new(x, y, or(self.level_mm, 0.0));
        let (turn_rad, rise_rad) = (or(self.turn_deg, 90.0).to_radians(), or(self.rise_deg, 0.0).to_radians());
        Cutlery { utensil: self.kind, at_mm, turn_rad, rise_rad }.bodies()
    }
}

impl NapkinSpec {
    pub(super) fn bodies(&self, random: &mut impl Rng) -> Vec<Body> {
        let napkin = Napkin {
            at_mm: point(self.at_mm),
            half_mm: self.size_mm.map_or([70.0; 2], |size| size.map(|side| 0.5 * side.get())),
            turn_rad: or(self.turn_deg, 0.0).to_radians(),
            colour: self.colour.map_or(LINEN, rgb),
            seed: random.random(),
        };
        napkin.bodies()
    }
}

impl TelephoneSpec {
    pub(super) fn bodies(&self, random: &mut impl Rng) -> Vec<Body> {
        let turn_rad = or(self.turn_deg, 0.0).to_radians();
        Telephone { at_mm: point(self.at_mm), turn_rad, seed: random.random() }.bodies()
    }
}

impl TryFrom<HandFields> for HandSpec {
    type Error = &'static str;

    fn try_from(fields: HandFields) -> Result<Self, Self::Error> {
        let (tip_mm, elbow_mm) = (point_above(fields.tip_mm), point_above(fields.elbow_mm));
        if (tip_mm - elbow_mm).xy().norm() < 100.0 {
            return Err("tip_mm and elbow_mm, expected at least 100 mm apart as seen from above");
        }
        let skin = fields.skin.map_or(SKIN, rgb);
        let hand = Hand { tip_mm, elbow_mm, skin, curl: or(fields.curl_deg, 15.0).to_radians(), seed: 0 };
        Ok(Self { hand, seen: fields.seen_pct.map_or(1.0, share) })
    }
}

impl HandSpec {
    /// The bodies of the hand, if it is there this time. It draws the same number of random numbers either way.
    pub(super) fn bodies(&self, random: &mut impl Rng) -> Vec<Body> {
        let (is_there, seed) = (random.random_bool(self.seen), random.random());
        if is_there { Hand { seed, ..self.hand }.bodies() } else { Vec::new() }
    }
}
