//! How high above the table a rim is, from the foot below it.
//!
//! Rim and foot are circles about one vertical axis. On the plane Z = 0 a rim at height H appears scaled by
//! k = c / (c - H) about the point under the camera, so its centre shows where the foot's centre must be for every H. The
//! outline of the wall is, there, that of the two circles with a line stretched around both.

use serde::{Deserialize, Serialize};

use super::arcs::Arc;
use super::buckets::Buckets;
use super::raster::{Raster, Window};

/// Height of a rim above the table.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RimHeight {
    /// The height.
    pub mm: f64,
    /// Its standard uncertainty.
    pub sigma_mm: f64,
    /// Where it comes from.
    pub source: HeightSource,
}

/// Where the height of a rim comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum HeightSource {
    /// It was given.
    Given,
    /// The foot is seen below the rim, about the same axis.
    Foot,
    /// The foot is hidden: what bowls commonly have, in proportion to their diameter, as far as a hidden foot allows.
    Common,
}

/// Height over diameter: median and standard deviation of its logarithm. Bowls lie between 0.25 and 0.6; cups reach 1.3.
const COMMON: (f64, f64) = (0.42, 0.5);
/// Foot over rim radius: mean and standard deviation.
const COMMON_FOOT: (f64, f64) = (0.62, 0.15);
/// Height over diameter that is tried.
const TRIED: (f64, f64) = (0.12, 1.8);
/// Ratios of two heights tried one after the other.
const HEIGHT_STEP: f64 = 1.04;
/// A foot is looked for within this many radii of the rim's centre.
const FURTHEST: f64 = 6.0;
/// Foot over rim radius that is tried, and its steps.
const FOOT: (f64, f64, f64) = (0.3, 1.04, 0.04);
/// Scaled pixels between the places that are looked at.
const STEP_PX: f64 = 3.0;
/// Scaled pixels from the rim within which edges are the rim's.
const CLEAR_PX: f64 = 3.0;
/// A foot shows an edge at this share of its places, a wall (seldom straight) at this share of its.
const SHOWS: [f64; 2] = [0.85, 0.4];
/// Walls bulge, feet have rounded edges and shadows: relative standard deviation of a height from that.
const MODEL: f64 = 0.08;
/// Least chance of an edge that means nothing.
const LEAST_CHANCE: f64 = 0.05;
/// Neighbouring places are not independent: what they say counts this much.
const INDEPENDENT: f64 = 0.5;
/// The height of a bowl's rim.
pub(super) fn of_bowl(buckets: &Buckets, rim: &Arc, camera_height_mm: f64) -> RimHeight {
    let trials = trials(buckets, rim, camera_height_mm);
    let best = trials.iter().max_by(|a, b| a.log_odds.total_cmp(&b.log_odds));
    let Some(best) = best else {
        let mm = COMMON.0 * 2.0 * rim.disc.radius;
        return RimHeight { mm, sigma_mm: COMMON.1 * mm, source: HeightSource::Common };
    };
    let weight = |t: &Trial| (t.log_odds - best.log_odds).exp();
    let sum: f64 = trials.iter().map(weight).sum();
    let mean = trials.iter().map(|t| weight(t) * t.height_mm).sum::<f64>() / sum;
    let variance = trials.iter().map(|t| weight(t) * (t.height_mm - mean).powi(2)).sum::<f64>() / sum;
    // The foot has been seen where the places looked at say so, whatever bowls commonly are.
    let source = if best.seen > 4.0 { HeightSource::Foot } else { HeightSource::Common };
    RimHeight { mm: mean, sigma_mm: variance.sqrt().hypot(MODEL * mean), source }
}

/// One height and foot, and the logarithm of how likely they are.
struct Trial {
    height_mm: f64,
    log_odds: f64,
    seen: f64,
}

fn trials(buckets: &Buckets, rim: &Arc, camera_height_mm: f64) -> Vec<Trial> {
    let away = rim.disc.x.hypot(rim.disc.y);
    let chance = rim.chance.max(LEAST_CHANCE);
    let scale = std::f64::consts::TAU * rim.disc.radius / rim.perimeter_px;
    // The lowest foot that is tried, and what is around it.
    let lowest = away * (1.0 - shrink(rim, camera_height_mm, TRIED.1)) + rim.disc.radius;
    let reach = lowest.min(FURTHEST * rim.disc.radius);
    let toward = [-rim.disc.x / away.max(1e-9), -rim.disc.y / away.max(1e-9)];
    let furthest = away * (1.0 - shrink(rim, camera_height_mm, TRIED.1));
    let window = around(rim, toward, furthest);
    let raster = Raster::of(buckets, [rim.disc.x, rim.disc.y], reach, window, scale);
    let odds = SHOWS.map(|shows| [((1.0 - shows) / (1.0 - chance)).ln(), (shows / chance).ln()]);
    let mut trials = Vec::new();
    let mut ratio = TRIED.0;
    while ratio < TRIED.1 {
        let shrink = shrink(rim, camera_height_mm, ratio);
        let height_mm = camera_height_mm * (1.0 - shrink);
        let likely_height = -0.5 * ((ratio / COMMON.0).ln() / COMMON.1).powi(2);
        let mut foot = FOOT.0;
        while foot < FOOT.1 {
            let outline = Outline {
                rim,
                toward,
                apart: away * (1.0 - shrink),
                radius: foot * rim.disc.radius * shrink,
                step: STEP_PX * scale,
            };
            let seen = INDEPENDENT * outline.seen(&raster, odds);
            let likely_foot = -0.5 * ((foot - COMMON_FOOT.0) / COMMON_FOOT.1).powi(2);
            trials.push(Trial { height_mm, log_odds: seen + likely_height + likely_foot, seen });
            foot += FOOT.2;
        }
        ratio *= HEIGHT_STEP;
    }
    trials
}

/// What the places lie in that are looked at for any height: discs no wider than the widest foot, from the rim's centre
/// towards the furthest one.
fn around(rim: &Arc, toward: [f64; 2], furthest: f64) -> Window {
    let (from, widest) = ([rim.disc.x, rim.disc.y], FOOT.1 * rim.disc.radius);
    let corner = |pick: fn(f64, f64) -> f64, side: f64| {
        [0, 1].map(|axis| pick(from[axis], from[axis] + toward[axis] * furthest) + side * widest)
    };
    [corner(f64::min, -1.0), corner(f64::max, 1.0)]
}

/// How much smaller the rim is than it appears on Z = 0 if its height is so much of its diameter: H = q D and
/// D = 2 R (1 - H / c), with R the radius on Z = 0.
fn shrink(rim: &Arc, camera_height_mm: f64, ratio: f64) -> f64 {
    1.0 / (1.0 + 2.0 * ratio * rim.disc.radius / camera_height_mm)
}

/// The outline of a wall between a rim and a foot, on the plane Z = 0.
struct Outline<'a> {
    rim: &'a Arc,
    /// Unit vector from the rim's centre to the foot's: towards the point under the camera.
    toward: [f64; 2],
    /// Distance of the centres.
    apart: f64,
    /// Radius of the foot.
    radius: f64,
    /// Distance of the places that are looked at.
    step: f64,
}

impl Outline<'_> {
    /// What its edges say: logarithm of how much likelier they are with this foot than without. `odds`: what a place of the
    /// foot and one of the wall say, each without an edge and with one.
    fn seen(&self, raster: &Raster, odds: [[f64; 2]; 2]) -> f64 {
        let cosine = (self.rim.disc.radius - self.radius) / self.apart;
        if cosine >= 1.0 {
            return 0.0; // hidden behind the rim
        }
        // The line around both circles leaves the foot where both normals agree.
        let exposed = cosine.max(-1.0).acos();
        let heading = self.toward[1].atan2(self.toward[0]);
        let center = [self.rim.disc.x + self.toward[0] * self.apart, self.rim.disc.y + self.toward[1] * self.apart];
        let mut sum = 0.0;
        let rim = &self.rim.disc;
        // On the rim itself, edges are the rim's.
        let clear = (rim.radius + CLEAR_PX * self.step / STEP_PX).powi(2);
        let mut look = |at: [f64; 2], angle: f64, odds: [f64; 2]| {
            if (at[0] - rim.x).powi(2) + (at[1] - rim.y).powi(2) > clear {
                sum += odds[usize::from(raster.has_edge(at, angle))];
            }
        };
        let turn = (self.step / self.radius).min(0.5);
        #[expect(clippy::cast_possible_truncation, reason = "places along half a foot")]
        let places = (exposed / turn) as i32;
        let (sin, cos) = turn.sin_cos();
        let (mut y, mut x) = (heading - f64::from(places) * turn).sin_cos();
        for place in -places..=places {
            let angle = heading + f64::from(place) * turn;
            look([center[0] + self.radius * x, center[1] + self.radius * y], angle, odds[0]);
            (x, y) = (x * cos - y * sin, x * sin + y * cos);
        }
        let length = (self.apart.powi(2) - (rim.radius - self.radius).powi(2)).sqrt();
        for side in [-1.0, 1.0] {
            let angle = heading + side * exposed;
            let normal = [angle.cos(), angle.sin()];
            let mut along = self.step;
            while along < length {
                let share = along / length;
                let at = [0, 1].map(|i| {
                    let rim = [rim.x, rim.y][i] + rim.radius * normal[i];
                    let foot = center[i] + self.radius * normal[i];
                    foot + (rim - foot) * share
                });
                look(at, angle, odds[1]);
                along += self.step;
            }
        }
        sum
    }
}
