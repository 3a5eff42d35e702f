//! The preset `bench`: nine setups with eight objects each.

use nalgebra::Point2;
use rand::Rng;
use rand_chacha::ChaCha8Rng;

use super::catalogue::WARES;
use super::frame::{Frame, Placed};
use super::plan::{Plan, Use, random};
use super::{table, things};
use crate::sensors::{HeadPose, Motion};

/// Heights of the camera above the table.
const HEIGHTS_MM: [f64; 3] = [380.0, 440.0, 500.0];
/// Pitches of the camera.
const PITCHES_DEG: [f64; 3] = [45.0, 55.0, 65.0];

/// Seconds from the start of a session to its first picture.
const FIRST_S: f64 = 5.25;
/// Seconds from one picture to the next.
const PERIOD_S: f64 = 10.0;

/// Number of sessions.
pub(super) const SESSIONS: usize = HEIGHTS_MM.len() * PITCHES_DEG.len();

/// Nine sessions of one setup each, with one picture of every object, each on another table in other light. The containers are
/// empty, and other things lie beside most of them.
#[must_use]
pub fn bench(seed: u64, width_px: u32) -> Vec<Plan> {
    (0..SESSIONS).map(|number| session(seed, width_px, number)).collect()
}

/// The session with this number, from 0 to 8.
pub(super) fn session(seed: u64, width_px: u32, number: usize) -> Plan {
    let (height_mm, pitch_deg) = (HEIGHTS_MM[number / PITCHES_DEG.len()], PITCHES_DEG[number % PITCHES_DEG.len()]);
    let head = HeadPose { pitch_deg, roll_deg: 0.0, range_mm: height_mm / pitch_deg.to_radians().sin() };
    let frames = (0..WARES.len()).map(|at| {
        let mut random = random(seed, Use::Scene, number * WARES.len() + at);
        frame(&mut random, width_px, at, head)
    });
    Plan {
        name: format!("bench-{height_mm:.0}mm-{pitch_deg:.0}deg"),
        setup: Some((height_mm, pitch_deg)),
        participant: None,
        motion: Motion::fixed(head),
        sway_deg: 0.0,
        frames: frames.collect(),
        number,
    }
}

#[expect(clippy::cast_precision_loss, reason = "eight objects")]
fn frame(random: &mut ChaCha8Rng, width_px: u32, at: usize, head: HeadPose) -> Frame {
    let (object, ware) = WARES[at];
    let mut world = table::bare(random);
    let away_mm = head.range_mm * head.pitch_deg.to_radians().cos();
    let at_mm = Point2::new(random.random_range(-18.0..18.0), away_mm + random.random_range(-18.0..12.0));
    let turn_rad = if ware.kind == model::Kind::Box { random.random_range(-0.2..0.2) } else { 0.0 };
    let glaze = table::glaze(random, &ware);
    world.bodies.extend(ware.bodies(at_mm, turn_rad, &glaze));
    let vessels = things::beside(random, &mut world, at_mm, 0.5 * ware.diameter_mm, 2);
    Frame {
        time_s: FIRST_S + PERIOD_S * at as f64,
        world,
        placed: vec![Placed { object: object.into(), ware, at_mm, turn_rad }],
        vessels,
        head,
        stand: (Point2::origin(), 0.0),
        exposure: table::exposure(random, width_px, 0.0),
        seed: random.random(),
    }
}
