//! The height of a rim above the table, from what is seen below it and in it.
//!
//! All level circles of a container have one upright axis. On the plane Z = 0 one at the level z appears about the point
//! t C, with C the centre of the rim there, and t = (c - H) / (c - z) for a camera at c and a rim at H; its radius is r t / s,
//! with s = 1 - H / c. So the places of the foot, of the wall's outline ([`wall`](super::wall)) and of the floor
//! ([`floor`](super::floor)) are known for every height, and the edges there say how likely it is.

use super::floor::Floors;
use super::raster::{ChanceLimits, Raster, Window};
use super::wall::{Wall, Walls};
use crate::circles::{Arc, Buckets};
use crate::priors::{
    CUPS_BY_DIAMETER, CUPS_MM, FEET, FEET_TRIED, HEIGHTS_TRIED, PLATES_BY_DIAMETER, ROUND_BOWLS, ROUND_PLATES,
};
use crate::rim_height::{HeightSource, RimHeight};
use crate::weights::{MISTAKEN, TOO_SURE_OF_KIND};

/// Heights of a rim, if it is a plate's and if it is a bowl's.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Heights {
    pub plate: RimHeight,
    pub bowl: RimHeight,
    /// Logarithm of the odds of a plate against a bowl, by all that is seen.
    pub plate_log_odds: f64,
}

/// The roundness of walls that is tried: 0 for a cone, 1 for a quarter of an ellipse.
const ROUND: [f64; 3] = [0.0, 0.45, 0.9];
/// A foot is looked for within this many radii of the rim's centre.
const FURTHEST: f64 = 6.0;
/// Walls bulge, feet have rounded edges and shadows: relative standard deviation of a height from that.
const MODEL: f64 = 0.1;
/// The chance of an edge that means nothing is held between these limits.
const CHANCE: ChanceLimits = ChanceLimits { least: 0.05, greatest: 0.7 };
/// The ring within the rim in which that chance is counted: inner and outer radius, in radii of the rim.
const WITHIN: [f64; 2] = [0.2, 0.85];
/// The ring around the rim in which that chance is counted, likewise.
const AROUND: [f64; 2] = [1.15, 1.8];
/// A wall stands out from the table as its rim does, this share of it at least: a shadow does less.
const AS_STRONG: f64 = 0.35;
/// Neighbouring places are not independent: their evidence counts this much.
const INDEPENDENT: f64 = 0.3;
/// A foot or a floor counts as the source of a height if the logarithm of its odds is so much larger there than at heights that are
/// common.
const SAYS: f64 = 4.0;

/// One height, foot and wall that is tried, and the logarithm of how likely they are.
struct Trial {
    height_mm: f64,
    /// The evidence of what is seen below the rim (`below`), and within it (`within`).
    below: f64,
    within: f64,
    /// The priors of a plate (`plate`) and of a bowl (`bowl`).
    plate: f64,
    bowl: f64,
}

/// The heights of a rim.
pub(crate) fn of_rim(buckets: &Buckets, rim: &Arc, camera_mm: f64) -> Heights {
    let trials = trials(buckets, rim, camera_mm);
    let (plate, plates) = height(&trials, |t| t.plate, MISTAKEN.plate);
    let (bowl, bowls) = height(&trials, |t| t.bowl, MISTAKEN.bowl);
    Heights { plate, bowl, plate_log_odds: (plates - bowls) / *TOO_SURE_OF_KIND }
}

/// Mean and deviation of the height, and the logarithm of the sum of the evidence for all heights. `mistaken`: the share of the edges
/// seen that mean nothing.
fn height(trials: &[Trial], common: impl Fn(&Trial) -> f64, mistaken: f64) -> (RimHeight, f64) {
    let odds = |t: &Trial| t.below + t.within + common(t);
    let most = trials.iter().map(odds).fold(f64::NEG_INFINITY, f64::max);
    let seen: Vec<f64> = trials.iter().map(|t| (odds(t) - most).exp()).collect();
    let unseen: Vec<f64> = trials.iter().map(|t| common(t).exp()).collect();
    let mm = mean(trials, &seen, |t| t.height_mm);
    let variance = |weights: &[f64]| mean(trials, weights, |t| (t.height_mm - mm).powi(2));
    // What was taken for a foot may be a shadow: then nothing but what is common is known.
    let variance = (1.0 - mistaken) * variance(&seen) + mistaken * variance(&unseen);
    // What is seen tells the height where it would not be seen at others, as from straight above.
    let tells = |what: fn(&Trial) -> f64| mean(trials, &seen, what) - mean(trials, &unseen, what) > SAYS;
    let source = match (tells(|t| t.below), tells(|t| t.within)) {
        (true, _) => HeightSource::Foot,
        (false, true) => HeightSource::Floor,
        (false, false) => HeightSource::Common,
    };
    let sum: f64 = seen.iter().sum();
    (RimHeight { mm, sigma_mm: variance.sqrt().hypot(MODEL * mm), source }, most + sum.ln())
}

fn mean(trials: &[Trial], weights: &[f64], of: impl Fn(&Trial) -> f64) -> f64 {
    trials.iter().zip(weights).map(|(t, w)| w * of(t)).sum::<f64>() / weights.iter().sum::<f64>()
}

fn trials(buckets: &Buckets, rim: &Arc, camera_mm: f64) -> Vec<Trial> {
    let away = rim.disc.x.hypot(rim.disc.y);
    let scale = std::f64::consts::TAU * rim.disc.radius / rim.perimeter_px;
    // The lowest foot that is tried, and what is around it.
    let furthest = away * (1.0 - shrink(rim, camera_mm, HEIGHTS_TRIED.below));
    let (lowest, center) = (furthest + rim.disc.radius, [rim.disc.x, rim.disc.y]);
    let toward = center.map(|c| -c / away.max(1e-9));
    #[expect(clippy::cast_possible_truncation, reason = "levels")]
    let least = (AS_STRONG * rim.contrast) as f32;
    let outside = Raster::from_edges(
        buckets,
        center,
        lowest.min(FURTHEST * rim.disc.radius),
        around(rim, toward, furthest),
        scale,
        least,
    );
    let inside = Raster::from_edges(buckets, center, rim.disc.radius, around(rim, toward, 0.0), scale, 0.0);
    let chances = |raster: &Raster, rings| raster.chances(&rim.disc, rings, CHANCE);
    let floors = Floors::new(rim, &inside, &chances(&inside, WITHIN), scale, camera_mm);
    let walls = Walls::new(rim, &outside, &chances(&outside, AROUND), scale, camera_mm);
    let mut trials = Vec::new();
    for ratio in HEIGHTS_TRIED.values() {
        let shrink = shrink(rim, camera_mm, ratio);
        let height_mm = camera_mm * (1.0 - shrink);
        let within = INDEPENDENT * floors.seen(height_mm);
        let (plate, bowl) = common(ratio, 2.0 * rim.disc.radius * shrink);
        for round in ROUND {
            for foot in FEET_TRIED.values() {
                let below = INDEPENDENT * walls.seen(&Wall { height_mm, foot, round });
                let likely = -0.5 * ((foot - FEET.mean) / FEET.sd).powi(2);
                trials.push(Trial { height_mm, below, within, plate: plate + likely, bowl: bowl + likely });
            }
        }
    }
    trials
}

/// The window that holds the places that are looked at for any height: about the rim, where chance is counted, and discs no wider than
/// it, from its centre towards the furthest foot.
fn around(rim: &Arc, toward: [f64; 2], furthest: f64) -> Window {
    let (from, radius) = ([rim.disc.x, rim.disc.y], rim.disc.radius);
    let corner = |pick: fn(f64, f64) -> f64, side: f64| {
        [0, 1].map(|axis| {
            let foot = from[axis] + toward[axis] * furthest + side * FEET_TRIED.below * radius;
            pick(from[axis] + side * AROUND[1] * radius, foot)
        })
    };
    [corner(f64::min, -1.0), corner(f64::max, 1.0)]
}

/// Logarithms of how common a height (over diameter) is among plates, and among bowls and cups, of this diameter; per
/// logarithm of the height.
fn common(ratio: f64, diameter_mm: f64) -> (f64, f64) {
    let normal = |off: f64, sd: f64| (-0.5 * (off / sd).powi(2)).exp() / sd;
    let (plates, cups) = (PLATES_BY_DIAMETER.at_diameter(diameter_mm), CUPS_BY_DIAMETER.at_diameter(diameter_mm));
    let plate = plates * ratio * normal(ratio - ROUND_PLATES.mean, ROUND_PLATES.sd);
    let bowl = (1.0 - cups) * normal((ratio / ROUND_BOWLS.median).ln(), ROUND_BOWLS.ln_sd);
    let cup = cups * normal((ratio * diameter_mm / CUPS_MM.median).ln(), CUPS_MM.ln_sd);
    let log = |likely: f64| likely.max(1e-12).ln();
    (log(plate), log((1.0 - plates).max(1e-3) * (bowl + cup)))
}

/// How much smaller the rim is than it appears on Z = 0 if its height is so much of its diameter: H = q D and
/// D = 2 R (1 - H / c), with R the radius on Z = 0.
fn shrink(rim: &Arc, camera_mm: f64, ratio: f64) -> f64 {
    1.0 / (1.0 + 2.0 * ratio * rim.disc.radius / camera_mm)
}
