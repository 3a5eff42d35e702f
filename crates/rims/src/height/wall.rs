//! The outline of a wall between rim and foot, on the plane Z = 0.

use super::raster::{Chances, Odds, Raster, Sector};
use crate::circles::Arc;

/// Levels between rim and foot.
const LEVELS: usize = 8;
/// Scaled pixels from the rim within which edges are the rim's.
const CLEAR_PX: f64 = 4.0;
/// A foot shows an edge at this share of its places, a wall (seldom as round as assumed) at this share of its.
const SHOWS: (f64, f64) = (0.85, 0.5);
/// Scaled pixels between the places that are looked at.
const STEP_PX: f64 = 3.0;
/// Directions of the outline that are tried, at least, in half a turn.
const DIRECTIONS: f64 = 24.0;

/// A wall: its outline is that of the discs at all its levels.
pub(super) struct Wall {
    pub height_mm: f64,
    /// Radius of the foot over that of the rim.
    pub foot: f64,
    /// How round it is: 0 a cone, 1 a quarter of an ellipse.
    pub round: f64,
}

/// Where the walls of a rim are looked for.
pub(super) struct Walls<'a> {
    rim: &'a Arc,
    raster: &'a Raster,
    /// What places of the foot say, and what those of the wall do.
    foot: Odds,
    wall: Odds,
    camera_mm: f64,
    /// Distance of the places that are looked at, in mm.
    step: f64,
    /// Distance from the rim's centre, in mm, up to which edges are the rim's.
    clear_mm: f64,
    /// Unit vectors towards the point under the camera, and at a right angle to it.
    toward: [f64; 2],
    aside: [f64; 2],
    /// Directions of the outline in half a turn.
    directions: Vec<Direction>,
}

/// A direction of the outline by its angle from the point under the camera, and normals to either side.
struct Direction {
    cos: f64,
    sin: f64,
    normals: [Sector; 2],
}

/// A level as it appears: how far its centre is moved from the rim's, towards the point under the camera, and its radius.
#[derive(Clone, Copy)]
struct Level {
    moved: f64,
    radius: f64,
}

/// A place of the outline from the rim's centre, in mm: towards the point under the camera, and aside.
#[derive(Clone, Copy)]
struct Place {
    along: f64,
    across: f64,
}

impl Wall {
    fn levels(&self, rim: &Arc, camera_mm: f64) -> [Level; LEVELS] {
        let away = rim.disc.x.hypot(rim.disc.y);
        std::array::from_fn(|level| {
            #[expect(clippy::cast_precision_loss, reason = "a few levels")]
            let share = level as f64 / (LEVELS - 1) as f64;
            let reach = (1.0 - self.round) * share + self.round * (1.0 - (1.0 - share).powi(2)).sqrt();
            let t = (camera_mm - self.height_mm) / (camera_mm - share * self.height_mm);
            Level { moved: away * (1.0 - t), radius: (self.foot + (1.0 - self.foot) * reach) * rim.disc.radius * t }
        })
    }
}

impl<'a> Walls<'a> {
    /// `chances`: of edges that mean nothing. `scale`: mm per scaled pixel.
    pub(super) fn new(rim: &'a Arc, raster: &'a Raster, chances: &Chances, scale: f64, camera_mm: f64) -> Self {
        let heading = (-rim.disc.y).atan2(-rim.disc.x);
        let step = STEP_PX * scale;
        let turn = (step / rim.disc.radius).min(std::f64::consts::FRAC_PI_2 / DIRECTIONS);
        let mut directions = Vec::new();
        let mut angle = 0.0_f64;
        while angle < std::f64::consts::PI {
            let normals = [-1.0, 1.0].map(|side| Sector::of(heading + side * angle));
            directions.push(Direction { cos: angle.cos(), sin: angle.sin(), normals });
            angle += turn;
        }
        Self {
            rim,
            raster,
            foot: chances.odds(SHOWS.0),
            wall: chances.odds(SHOWS.1),
            camera_mm,
            step,
            clear_mm: rim.disc.radius + CLEAR_PX * scale,
            toward: [heading.cos(), heading.sin()],
            aside: [-heading.sin(), heading.cos()],
            directions,
        }
    }

    /// What a wall's edges say: logarithm of how much likelier they are with it than without.
    pub(super) fn seen(&self, wall: &Wall) -> f64 {
        let levels = wall.levels(self.rim, self.camera_mm);
        let mut sum = 0.0;
        let mut outer = Outermost::of(&levels);
        let mut last: Option<(usize, Place)> = None;
        for (i, direction) in self.directions.iter().enumerate() {
            let outer = outer.towards(direction.cos);
            let level = levels[outer];
            let place =
                Place { along: level.moved + level.radius * direction.cos, across: level.radius * direction.sin };
            if let Some((from, before)) = last
                && from != outer
            {
                sum += self.between(before, place, direction);
            }
            if outer == LEVELS - 1 {
                break; // from here on it is the rim
            }
            // Towards the point under the camera, both sides are one.
            let sides = if i > 0 { 0..2 } else { 1..2 };
            sum += self.look(place, direction, sides, if outer == 0 { &self.foot } else { &self.wall });
            last = Some((outer, place));
        }
        sum
    }

    /// The same of the line around two levels.
    fn between(&self, from: Place, to: Place, direction: &Direction) -> f64 {
        let (along, across) = (to.along - from.along, to.across - from.across);
        let length = along.hypot(across);
        let (mut sum, mut done) = (0.0, self.step);
        while done < length {
            let share = done / length;
            let place = Place { along: from.along + along * share, across: from.across + across * share };
            sum += self.look(place, direction, 0..2, &self.wall);
            done += self.step;
        }
        sum
    }

    /// The same of one place, on both sides or one.
    fn look(&self, place: Place, direction: &Direction, sides: std::ops::Range<usize>, odds: &Odds) -> f64 {
        let Place { along, across } = place;
        // On the rim itself, edges are the rim's.
        if along * along + across * across <= self.clear_mm * self.clear_mm {
            return 0.0;
        }
        let center = [self.rim.disc.x, self.rim.disc.y];
        let says = |side: usize| {
            let across = if side == 0 { -across } else { across };
            let at = [0, 1].map(|i| center[i] + along * self.toward[i] + across * self.aside[i]);
            self.raster.says(at, direction.normals[side], odds)
        };
        sides.map(says).sum()
    }
}

/// The level that reaches furthest in a direction, for one direction after the other from the point under the camera on:
/// higher levels are moved less, so they take over one by one.
struct Outermost<'a> {
    levels: &'a [Level; LEVELS],
    level: usize,
    /// The next one, and the cosine of the direction from which on it reaches further.
    next: (usize, f64),
}

impl<'a> Outermost<'a> {
    fn of(levels: &'a [Level; LEVELS]) -> Self {
        let reach = |level: usize| levels[level].moved + levels[level].radius;
        let level = (1..LEVELS).fold(0, |most, level| if reach(level) > reach(most) { level } else { most });
        Self { levels, level, next: next(levels, level) }
    }

    /// The level in a direction by the cosine of its angle, no larger than the one before.
    fn towards(&mut self, cos: f64) -> usize {
        while cos < self.next.1 {
            self.level = self.next.0;
            self.next = next(self.levels, self.level);
        }
        self.level
    }
}

/// The level that takes over from another one, and the cosine below which it does.
fn next(levels: &[Level; LEVELS], from: usize) -> (usize, f64) {
    let mut first = (from, f64::NEG_INFINITY);
    for (level, upper) in levels.iter().enumerate().skip(from + 1) {
        let lag = levels[from].moved - upper.moved;
        let cos = (upper.radius - levels[from].radius) / lag;
        if lag > 0.0 && cos >= first.1 {
            first = (level, cos);
        }
    }
    first
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Level after level takes over where it reaches furthest.
    #[test]
    fn the_outermost_level_is_the_one_that_reaches_furthest() {
        for foot in [0.3, 0.6, 1.0] {
            for (height, away) in [(20.0, 250.0), (60.0, 400.0), (150.0, 90.0), (60.0, 0.0)] {
                let levels: [Level; LEVELS] = std::array::from_fn(|level| {
                    let share = level as f64 / (LEVELS - 1) as f64;
                    let t = (450.0 - height) / (450.0 - share * height);
                    Level { moved: away * (1.0 - t), radius: (foot + (1.0 - foot) * share.sqrt()) * 80.0 * t }
                });
                let mut outer = Outermost::of(&levels);
                for degree in 0..180 {
                    let cos = f64::from(degree).to_radians().cos();
                    let reach = |level: &Level| level.moved * cos + level.radius;
                    let most = levels.iter().map(reach).fold(f64::NEG_INFINITY, f64::max);
                    assert!((reach(&levels[outer.towards(cos)]) - most).abs() < 1e-9, "{degree} degrees");
                }
            }
        }
    }
}
