//! The outline of a wall between rim and foot, on the plane Z = 0.

use super::arcs::Arc;
use super::height::says;
use super::raster::{Chances, Raster};

/// Levels between rim and foot.
const LEVELS: usize = 8;
/// Scaled pixels from the rim within which edges are the rim's.
const CLEAR_PX: f64 = 4.0;
/// A foot shows an edge at this share of its places, a wall (seldom as round as assumed) at this share of its.
const SHOWS: (f64, f64) = (0.85, 0.5);
/// Directions of the outline that are tried, at least, in half a turn.
const DIRECTIONS: f64 = 24.0;

/// A wall: the outline is that of the discs at all its levels.
pub(super) struct Outline<'a> {
    pub rim: &'a Arc,
    pub height_mm: f64,
    pub camera_mm: f64,
    /// Radius of the foot over that of the rim.
    pub foot: f64,
    /// How round it is: 0 a cone, 1 a quarter of an ellipse.
    pub round: f64,
    /// Distance of the places that are looked at, in mm.
    pub step: f64,
}

/// A level as it appears: how far its centre is moved from the rim's, towards the point under the camera, and its radius.
#[derive(Clone, Copy)]
struct Level {
    moved: f64,
    radius: f64,
}

impl Outline<'_> {
    fn levels(&self) -> [Level; LEVELS] {
        let away = self.rim.disc.x.hypot(self.rim.disc.y);
        std::array::from_fn(|level| {
            #[expect(clippy::cast_precision_loss, reason = "a few levels")]
            let share = level as f64 / (LEVELS - 1) as f64;
            let reach = (1.0 - self.round) * share + self.round * (1.0 - (1.0 - share).powi(2)).sqrt();
            let t = (self.camera_mm - self.height_mm) / (self.camera_mm - share * self.height_mm);
            Level {
                moved: away * (1.0 - t),
                radius: (self.foot + (1.0 - self.foot) * reach) * self.rim.disc.radius * t,
            }
        })
    }

    /// What its edges say: logarithm of how much likelier they are with this wall than without. `scale`: mm per scaled pixel.
    pub(super) fn seen(&self, raster: &Raster, chances: &Chances, scale: f64) -> f64 {
        let rim = &self.rim.disc;
        let levels = self.levels();
        let heading = (-rim.y).atan2(-rim.x);
        let (toward, aside) = ([heading.cos(), heading.sin()], [-heading.sin(), heading.cos()]);
        let mut sum = 0.0;
        let mut look = |along: f64, across: f64, angle: f64, shows: f64| {
            // On the rim itself, edges are the rim's.
            if along.hypot(across) - rim.radius > CLEAR_PX * scale {
                let at = [0, 1].map(|i| [rim.x, rim.y][i] + along * toward[i] + across * aside[i]);
                let normal = heading + angle;
                sum += says(raster.has_edge(at, normal), shows, chances.of(normal));
            }
        };
        let turn = (self.step / rim.radius).min(std::f64::consts::FRAC_PI_2 / DIRECTIONS);
        for side in [-1.0, 1.0] {
            let (mut angle, mut last): (f64, Option<(usize, f64, f64)>) = (0.0, None);
            while angle < std::f64::consts::PI {
                let outer = outermost(&levels, angle);
                let level = levels[outer];
                let (along, across) = (level.moved + level.radius * angle.cos(), side * level.radius * angle.sin());
                if let Some((from, x, y)) = last
                    && from != outer
                {
                    // The line around two levels.
                    let length = (along - x).hypot(across - y);
                    let mut done = self.step;
                    while done < length {
                        let share = done / length;
                        look(x + (along - x) * share, y + (across - y) * share, side * angle, SHOWS.1);
                        done += self.step;
                    }
                }
                if outer == LEVELS - 1 {
                    break; // from here on it is the rim
                }
                if angle > 0.0 || side > 0.0 {
                    look(along, across, side * angle, if outer == 0 { SHOWS.0 } else { SHOWS.1 });
                }
                last = Some((outer, along, across));
                angle += turn;
            }
        }
        sum
    }
}

/// The level that reaches furthest in a direction, by its angle from the point under the camera.
fn outermost(levels: &[Level; LEVELS], angle: f64) -> usize {
    let reach = |level: usize| levels[level].moved * angle.cos() + levels[level].radius;
    (1..LEVELS).fold(0, |outer, level| if reach(level) > reach(outer) { level } else { outer })
}
