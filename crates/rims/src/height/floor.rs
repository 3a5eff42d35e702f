//! The floor of a bowl or the well of a plate, seen within the rim.

use wide::{CmpLt, f32x4};

use super::raster::{Chances, Odds, Raster, Sector};
use crate::circles::Arc;
use crate::priors::{FLOOR_LEVELS, FLOORS, FLOORS_TRIED, FloorLevel};

/// A floor that shows has an edge at this share of its places.
const SHOWS: f64 = 0.7;
/// The share of floors that show.
const SHOWING: f64 = 0.5;
/// The number of places that are looked at.
const PLACES: usize = 48;
/// Scaled pixels from the rim within which edges are the rim's.
const CLEAR_PX: f64 = 4.0;

/// The places where floors are looked for.
pub(super) struct Floors<'a> {
    rim: &'a Arc,
    raster: &'a Raster,
    odds: Odds,
    /// Distance from the rim's centre, in mm, beyond which edges are the rim's.
    clear_mm: f64,
    camera_mm: f64,
    /// Unit vectors to the places that are looked at, which are the normals there.
    places: [([f32x4; 2], [Sector; 4]); PLACES / 4],
}

impl<'a> Floors<'a> {
    /// `chances`: of edges that mean nothing. `scale`: mm per scaled pixel.
    pub(super) fn new(rim: &'a Arc, raster: &'a Raster, chances: &Chances, scale: f64, camera_mm: f64) -> Self {
        let places = std::array::from_fn(|four| {
            #[expect(clippy::cast_precision_loss, reason = "a few places")]
            let angles = [0, 1, 2, 3].map(|i| (4 * four + i) as f64 / PLACES as f64 * std::f64::consts::TAU);
            #[expect(clippy::cast_possible_truncation, reason = "a unit vector")]
            let unit = [f64::cos, f64::sin].map(|of| f32x4::from(angles.map(|angle| of(angle) as f32)));
            (unit, angles.map(Sector::from_normal))
        });
        let clear_mm = (rim.disc.radius - CLEAR_PX * scale).max(0.0);
        Self { rim, raster, odds: chances.odds(SHOWS), clear_mm, camera_mm, places }
    }

    /// Logarithm of how much likelier the edges within the rim are if it is as high as this than if nothing is known.
    pub(super) fn seen(&self, height_mm: f64) -> f64 {
        let (mut sum, mut all) = (0.0, 0.0);
        for FloorLevel { height_mm: level_mm, share } in FLOOR_LEVELS {
            let level_mm = level_mm.min(0.6 * height_mm);
            let t = (self.camera_mm - height_mm) / (self.camera_mm - level_mm);
            for ratio in FLOORS_TRIED.values() {
                let weight = share * (-0.5 * ((ratio - FLOORS.mean) / FLOORS.sd).powi(2)).exp();
                sum += weight * self.circle(t, ratio).exp();
                all += weight;
            }
        }
        (1.0 - SHOWING + SHOWING * sum / all).ln()
    }

    /// The evidence of one circle, as far as the near half of the rim does not hide it.
    #[expect(clippy::cast_possible_truncation, reason = "mm")]
    fn circle(&self, t: f64, ratio: f64) -> f64 {
        let rim = &self.rim.disc;
        let radius = f32x4::splat((ratio * rim.radius * t) as f32);
        let [rim_x, rim_y, clear] = [rim.x, rim.y, self.clear_mm * self.clear_mm].map(|v| f32x4::splat(v as f32));
        let (x, y) = (f32x4::splat((rim.x * t) as f32), f32x4::splat((rim.y * t) as f32));
        let mut sum = 0.0;
        for ([cos, sin], normals) in self.places {
            let at = [x + radius * cos, y + radius * sin];
            let (dx, dy) = (at[0] - rim_x, at[1] - rim_y);
            sum += self.raster.says_of_four(at, (dx * dx + dy * dy).cmp_lt(clear), normals, &self.odds);
        }
        sum
    }
}
