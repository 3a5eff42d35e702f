//! The floor of a bowl or the well of a plate, seen within the rim.

use super::arcs::Arc;
use super::height::says;
use super::raster::{Chances, Raster};

/// Height of a floor above the table, in mm: foot ring and thickness; and how common.
const LEVELS: [(f64, f64); 3] = [(4.0, 0.25), (7.5, 0.5), (11.0, 0.25)];
/// Radius of the floor over that of the rim: mean and standard deviation, and what is tried.
const COMMON: (f64, f64) = (0.56, 0.1);
const TRIED: (f64, f64, f64) = (0.36, 0.8, 0.02);
/// A floor that shows has an edge at this share of its places ...
const SHOWS: f64 = 0.7;
/// ... and so many floors show.
const SHOWING: f64 = 0.5;
/// Places that are looked at.
const PLACES: u32 = 48;
/// Scaled pixels from the rim within which edges are the rim's.
const CLEAR_PX: f64 = 4.0;

/// Where floors are looked for.
pub(super) struct Floors<'a> {
    pub rim: &'a Arc,
    pub raster: &'a Raster,
    /// Chance of an edge that means nothing.
    pub chances: Chances,
    /// Millimetres per scaled pixel.
    pub scale: f64,
    pub camera_mm: f64,
}

impl Floors<'_> {
    /// Logarithm of how much likelier the edges within the rim are if it is as high as this than if nothing is known.
    pub(super) fn seen(&self, height_mm: f64) -> f64 {
        let (mut sum, mut all) = (0.0, 0.0);
        for (level_mm, likely) in LEVELS {
            let level_mm = level_mm.min(0.6 * height_mm);
            let t = (self.camera_mm - height_mm) / (self.camera_mm - level_mm);
            let mut ratio = TRIED.0;
            while ratio < TRIED.1 {
                let weight = likely * (-0.5 * ((ratio - COMMON.0) / COMMON.1).powi(2)).exp();
                sum += weight * self.circle(t, ratio).exp();
                all += weight;
                ratio += TRIED.2;
            }
        }
        (1.0 - SHOWING + SHOWING * sum / all).ln()
    }

    /// The same of one circle, of what of it the near half of the rim does not hide.
    fn circle(&self, t: f64, ratio: f64) -> f64 {
        let rim = &self.rim.disc;
        let radius = ratio * rim.radius * t;
        let mut sum = 0.0;
        for place in 0..PLACES {
            let angle = f64::from(place) / f64::from(PLACES) * std::f64::consts::TAU;
            let at = [rim.x * t + radius * angle.cos(), rim.y * t + radius * angle.sin()];
            if (at[0] - rim.x).hypot(at[1] - rim.y) < rim.radius - CLEAR_PX * self.scale {
                sum += says(self.raster.has_edge(at, angle), SHOWS, self.chances.of(angle));
            }
        }
        sum
    }
}
