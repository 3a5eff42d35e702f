//! Errors of the sensors of a scene file.

use serde::Deserialize;

use super::number::{Percent, Within, or, share};
use crate::laid::sensors::SensorErrors;

/// `[sensors]`.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SensorSpec {
    zero_g_offset_mg: Option<[Within<-200, 200>; 3]>,
    zero_g_offset_sd_mg: Option<Within<0, 100>>,
    acceleration_noise_mg: Option<Within<0, 100>>,
    range_scale_pct: Option<Within<-20, 20>>,
    range_scale_sd_pct: Option<Within<0, 10>>,
    range_noise_pct: Option<Within<0, 50>>,
    range_noise_least_mm: Option<Within<0, 200>>,
    range_lost_pct: Option<Percent>,
    range_held_pct: Option<Percent>,
    range_furthest_mm: Option<Within<100, 8000>>,
}

impl TryFrom<SensorSpec> for SensorErrors {
    type Error = &'static str;

    fn try_from(spec: SensorSpec) -> Result<Self, Self::Error> {
        if spec.zero_g_offset_mg.is_some() && spec.zero_g_offset_sd_mg.is_some() {
            return Err("both zero_g_offset_mg and zero_g_offset_sd_mg: expected one, fixed or drawn by lot");
        }
        if spec.range_scale_pct.is_some() && spec.range_scale_sd_pct.is_some() {
            return Err("both range_scale_pct and range_scale_sd_pct: expected one, fixed or drawn by lot");
        }
        let default = Self::default();
        Ok(Self {
            zero_g_offset_mg: spec.zero_g_offset_mg.map(|offset| offset.map(Within::get)),
            zero_g_offset_sd_mg: or(spec.zero_g_offset_sd_mg, default.zero_g_offset_sd_mg),
            acceleration_noise_mg: or(spec.acceleration_noise_mg, default.acceleration_noise_mg),
            range_scale: spec.range_scale_pct.map(share),
            range_scale_sd: spec.range_scale_sd_pct.map_or(default.range_scale_sd, share),
            range_noise: spec.range_noise_pct.map_or(default.range_noise, share),
            range_noise_least_mm: or(spec.range_noise_least_mm, default.range_noise_least_mm),
            range_lost: spec.range_lost_pct.map_or(default.range_lost, share),
            range_held: spec.range_held_pct.map_or(default.range_held, share),
            range_furthest_mm: or(spec.range_furthest_mm, default.range_furthest_mm),
        })
    }
}
