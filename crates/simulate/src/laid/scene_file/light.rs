//! Light and exposure of a scene file.

use nalgebra::Vector2;
use serde::Deserialize;

use super::number::{Percent, Place, Within, or, point_above};
use crate::world::Light;
use crate::world::photo::Exposure;

/// A level of light, in units of a white surface in full light.
type Level = Within<0, 5>;

/// `[light]`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LightSpec {
    lamp_mm: Option<[Place; 3]>,
    lamp_size_mm: Option<[Within<0, 2000>; 2]>,
    lamp: Option<[Level; 3]>,
    room: Option<[Level; 3]>,
    window_deg: Option<Within<-360, 360>>,
}

impl TryFrom<LightSpec> for Light {
    type Error = String;

    fn try_from(spec: LightSpec) -> Result<Self, String> {
        if let Some(z) = spec.lamp_mm.map(|lamp| lamp[2].get()).filter(|z| *z < 100.0) {
            return Err(format!("lamp_mm is {z} mm above the table, expected at least 100"));
        }
        let levels = |given: Option<[Level; 3]>, default: [f64; 3]| given.map_or(default, |l| l.map(Within::get));
        Ok(Self {
            lamp_mm: spec.lamp_mm.map_or_else(|| [-300.0, 250.0, 1200.0].into(), point_above),
            lamp_half_mm: spec.lamp_size_mm.map_or([150.0; 2], |size| size.map(|side| 0.5 * side.get())),
            lamp: levels(spec.lamp, [0.55, 0.54, 0.5]),
            room: levels(spec.room, [0.38, 0.39, 0.41]),
            window_rad: or(spec.window_deg, 90.0).to_radians(),
        })
    }
}

/// `[picture]`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PictureSpec {
    gain: Option<Within<0, 10>>,
    white_balance: Option<[Within<0, 5>; 3]>,
    vignetting_pct: Option<Percent>,
    motion_px: Option<[Within<-200, 200>; 2]>,
    blur_px: Option<Within<0, 50>>,
    read_noise_pct: Option<Percent>,
    full_well_electrons: Option<Within<10, 1_000_000>>,
}

impl From<PictureSpec> for Exposure {
    fn from(spec: PictureSpec) -> Self {
        Self {
            gain: or(spec.gain, 0.9),
            balance: spec.white_balance.map_or([1.0; 3], |gains| gains.map(Within::get)),
            vignetting: or(spec.vignetting_pct, 25.0) / 100.0,
            motion_px: spec.motion_px.map_or_else(Vector2::zeros, |[x, y]| Vector2::new(x.get(), y.get())),
            blur_px: or(spec.blur_px, 0.6),
            read_noise: or(spec.read_noise_pct, 0.2) / 100.0,
            full_well: or(spec.full_well_electrons, 5000.0),
        }
    }
}
