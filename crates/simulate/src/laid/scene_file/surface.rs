//! Surfaces of a scene file: the textures of tables and of tableware.

use nalgebra::Point2;
use serde::Deserialize;

use super::number::{Checked, Colour, Count, Percent, Place, Within, or, point, rgb};
use crate::world::{Material, Rgb, Texture};

/// Share of the light that varnish and glaze mirror, in per cent.
const GLAZE_PCT: f64 = 4.0;
const WOOD: [Rgb; 2] = [[0.5, 0.33, 0.18], [0.36, 0.21, 0.1]];

/// A texture as it is written.
#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum TextureFields {
    Plain(Plain),
    Wood(Wood),
    Cloth(Cloth),
    Speckled(Speckled),
    Printed(Printed),
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Plain {
    colour: Colour,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Wood {
    colours: Option<[Colour; 2]>,
    board_mm: Option<Within<10, 2000>>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Cloth {
    colours: [Colour; 2],
    stripe_mm: Option<Within<2, 500>>,
    #[serde(default)]
    checks: bool,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Speckled {
    colours: [Colour; 2],
    grain_mm: Option<Within<1, 100>>,
    speckles_pct: Option<Percent>,
}

/// Rings and motifs about the axis of a plate or bowl.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Printed {
    colours: [Colour; 2],
    /// Inner and outer radius of each of up to two rings.
    #[serde(default)]
    rings_mm: Vec<[Within<0, 1000>; 2]>,
    motifs: Option<Motifs>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct Motifs {
    number: Count<1, 100>,
    distance_mm: Within<0, 1000>,
    radius_mm: Within<0, 200>,
}

/// A texture that can be drawn.
#[derive(Debug, Clone)]
pub(super) struct Surface(TextureFields);

impl TryFrom<TextureFields> for Surface {
    type Error = String;

    fn try_from(fields: TextureFields) -> Result<Self, String> {
        match &fields {
            TextureFields::Printed(printed) => printed.check()?,
            TextureFields::Plain(_) | TextureFields::Wood(_) | TextureFields::Cloth(_) | TextureFields::Speckled(_) => {
            }
        }
        Ok(Self(fields))
    }
}

impl Surface {
    /// The texture with a random grain that follows from `seed`.
    fn texture(&self, seed: u64) -> Texture {
        match &self.0 {
            TextureFields::Plain(plain) => Texture::Plain(rgb(plain.colour)),
            TextureFields::Wood(wood) => {
                let colours = wood.colours.map_or(WOOD, |colours| colours.map(rgb));
                Texture::Wood { colours, board_mm: or(wood.board_mm, 110.0), seed }
            }
            TextureFields::Cloth(cloth) => Texture::Cloth {
                colours: cloth.colours.map(rgb),
                stripe_mm: or(cloth.stripe_mm, 40.0),
                checks: cloth.checks,
                seed,
            },
            TextureFields::Speckled(stone) => Texture::Speckled {
                colours: stone.colours.map(rgb),
                grain_mm: or(stone.grain_mm, 2.0),
                share: or(stone.speckles_pct, 30.0) / 100.0,
                seed,
            },
            TextureFields::Printed(printed) => printed.texture(),
        }
    }

    /// Whether the texture lies about an axis, which only round things have.
    pub(super) fn is_printed(&self) -> bool {
        matches!(self.0, TextureFields::Printed(_))
    }

    /// Share of the light that it mirrors, in per cent, where the file gives none. It is 0 for cloth.
    fn gloss_pct(&self) -> f64 {
        if matches!(self.0, TextureFields::Cloth(_)) { 0.0 } else { GLAZE_PCT }
    }

    /// The material of the surface.
    pub(super) fn material(&self, gloss_pct: Option<Percent>, seed: u64) -> Material {
        Material { gloss: or(gloss_pct, self.gloss_pct()) / 100.0, ..Material::matt(self.texture(seed)) }
    }
}

impl Printed {
    fn texture(&self) -> Texture {
        let ring = |at: usize| self.rings_mm.get(at).map_or([0.0; 2], |ring| ring.map(Within::get));
        let motifs = self.motifs.as_ref();
        Texture::Printed {
            colours: self.colours.map(rgb),
            rings_mm: [ring(0), ring(1)],
            motifs: motifs.map_or((0, 1.0, 0.0), |m| (m.number.get(), m.distance_mm.get(), m.radius_mm.get())),
        }
    }

    fn check(&self) -> Result<(), String> {
        if self.rings_mm.len() > 2 {
            return Err(format!("rings_mm has {} rings, expected at most two", self.rings_mm.len()));
        }
        for ring in self.rings_mm.iter().map(|ring| ring.map(Within::get)) {
            if ring[0] >= ring[1] {
                return Err(format!("rings_mm has {ring:?}, expected the inner radius, then the outer one"));
            }
        }
        Ok(())
    }
}

/// `[table]`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TableSpec {
    texture: Checked<TextureFields, Surface>,
    gloss_pct: Option<Percent>,
    size_mm: Option<[Within<200, 5000>; 2]>,
    middle_mm: Option<[Place; 2]>,
}

impl TableSpec {
    pub(super) fn material(&self, seed: u64) -> Material {
        self.texture.0.material(self.gloss_pct, seed)
    }

    /// Half of the table's length and depth, and its middle: those of the file, or those given where the file has none.
    pub(super) fn place(&self, (half, middle): ([f64; 2], Point2<f64>)) -> ([f64; 2], Point2<f64>) {
        let half = self.size_mm.map_or(half, |size| size.map(|side| 0.5 * side.get()));
        (half, self.middle_mm.map_or(middle, point))
    }
}
