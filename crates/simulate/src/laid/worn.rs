//! The preset `worn`: people who eat, with the camera on their eyeglasses.

use nalgebra::{Point2, Point3, Vector3};
use rand::Rng;
use rand_chacha::ChaCha8Rng;

use super::catalogue::WARES;
use super::frame::{Frame, Placed};
use super::plan::{Plan, Use, random};
use super::things::Vessel;
use super::walk::Walk;
use super::{sway, table, things};
use crate::sensors::{HeadPose, Motion};
use crate::world::{Rgb, World};

/// Seconds from the start of a session to its first picture.
const FIRST_S: f64 = 10.25;
/// Seconds from one picture to the next.
const PERIOD_S: f64 = 10.0;
/// Seconds that the head takes to turn between two pictures.
const TURN_S: f64 = 3.0;

/// The walk of the head, which turns to the plate and wanders from it.
const WALK: Walk = Walk {
    first_pitch_deg: (40.0, 65.0),
    pitch_deg: (20.0, 80.0),
    rest_pitch_deg: 54.0,
    pitch_step_deg: 22.0,
    first_height_mm: (360.0, 500.0),
    height_mm: (330.0, 520.0),
    height_step_mm: 20.0,
    roll_deg: (-8.0, 8.0),
};
/// Sway of the head while it rests, in degrees.
const SWAY_DEG: f64 = 0.25;
/// Share of a session's pictures before the meal is on the table, and share after it is taken away.
const WITHOUT: (f64, f64) = (0.15, 0.1);

const SKINS: [Rgb; 4] = [[0.62, 0.42, 0.32], [0.45, 0.27, 0.18], [0.7, 0.5, 0.4], [0.22, 0.12, 0.08]];

/// So many sessions of so many pictures each, which are 10 s apart. A session has one or two containers with food that becomes
/// less.
#[must_use]
pub fn worn(seed: u64, width_px: u32, sessions: usize, images: usize) -> Vec<Plan> {
    (0..sessions).map(|number| session(seed, width_px, number, images)).collect()
}

/// The session with this number, from 0.
pub(super) fn session(seed: u64, width_px: u32, number: usize, images: usize) -> Plan {
    let mut lot = random(seed, Use::Scene, number);
    let meal = Meal::laid(&mut lot);
    let heads = WALK.poses(&mut random(seed, Use::Head, number), images);
    let rests = heads.iter().enumerate().map(|(at, head)| (time_s(at), *head)).collect();
    let motion = Motion { rests, half_rest_s: 0.5 * (PERIOD_S - TURN_S) };
    let frames = heads.iter().enumerate().map(|(at, head)| {
        let head = sway(*head, SWAY_DEG, number, time_s(at));
        meal.frame(&mut lot, width_px, at, images, head)
    });
    Plan {
        name: format!("worn-{:03}", number + 1),
        setup: None,
        participant: Some(format!("P{:03}", number + 1)),
        frames: frames.collect(),
        motion,
        sway_deg: SWAY_DEG,
        number,
    }
}

#[expect(clippy::cast_precision_loss, reason = "some thousand images")]
fn time_s(at: usize) -> f64 {
    FIRST_S + PERIOD_S * at as f64
}

/// A laid table.
struct Meal {
    empty: World,
    laid: World,
    placed: Vec<Placed>,
    vessels: Vec<Vessel>,
    skin: Rgb,
}

impl Meal {
    fn laid(random: &mut ChaCha8Rng) -> Self {
        let bare = table::bare(random);
        let first = random.random_range(0..WARES.len());
        let mut placed =
            vec![place(first, Point2::new(random.random_range(-30.0..30.0), random.random_range(270.0..330.0)))];
        if random.random_bool(0.5) {
            let side = if random.random_bool(0.5) { 1.0 } else { -1.0 };
            let second = (first + random.random_range(1..WARES.len())) % WARES.len();
            let apart = 0.5 * (WARES[first].1.diameter_mm + WARES[second].1.diameter_mm) + 25.0;
            placed.push(place(second, placed[0].at_mm + nalgebra::Vector2::new(side * apart, 40.0)));
        }
        let radius = 0.5 * placed[0].ware.diameter_mm;
        let (mut empty, mut vessels) = (bare, Vec::new());
        if placed.len() == 1 {
            vessels = things::beside(random, &mut empty, placed[0].at_mm, radius, 3);
        }
        let mut laid = empty.clone();
        for each in &placed {
            let glaze = table::glaze(random, &each.ware);
            laid.bodies.extend(each.ware.bodies(each.at_mm, each.turn_rad, &glaze));
        }
        Self { empty, laid, placed, vessels, skin: SKINS[random.random_range(0..SKINS.len())] }
    }

    #[expect(clippy::cast_precision_loss, reason = "some thousand images")]
    fn frame(&self, random: &mut ChaCha8Rng, width_px: u32, at: usize, images: usize, head: HeadPose) -> Frame {
        let through = at as f64 / images.max(1) as f64;
        let is_laid = (WITHOUT.0..1.0 - WITHOUT.1).contains(&through);
        let mut world = if is_laid { self.laid.clone() } else { self.empty.clone() };
        let left = 0.75 * (1.0 - through);
        if is_laid {
            for each in &self.placed {
                world.bodies.extend(things::food(random, &each.ware, each.at_mm, left));
            }
        }
        self.hands(random, &mut world);
        let stand = Point2::new(random.random_range(-40.0..40.0), random.random_range(-40.0..20.0));
        Frame {
            time_s: time_s(at),
            world,
            placed: if is_laid { self.placed.clone() } else { Vec::new() },
            vessels: self.vessels.clone(),
            head,
            stand: (stand, random.random_range(-0.25..0.25)),
            exposure: table::exposure(random, width_px, 0.0012),
            seed: random.random(),
        }
    }

    /// Adds hands to the world of a picture. In most pictures there is one, over the rim or with a spoon or fork above the food, and
    /// in some there are both.
    fn hands(&self, random: &mut ChaCha8Rng, world: &mut World) {
        let near = self.placed[0].at_mm;
        let radius = 0.5 * self.placed[0].ware.diameter_mm;
        let height = self.placed[0].ware.height_mm;
        for side in [1.0, -1.0] {
            if !random.random_bool(0.45) {
                continue;
            }
            let elbow = Point3::new(near.x + side * 330.0, near.y - 330.0, 60.0);
            let over = random.random_range(-0.2..0.5) * radius;
            let tip = Point3::new(
                near.x + side * (radius - over),
                near.y - random.random_range(0.1..0.7) * radius,
                height + random.random_range(8.0..60.0),
            );
            world.bodies.extend(things::Hand::random(random, tip, elbow, self.skin).bodies());
            if random.random_bool(0.5) {
                let turn = std::f64::consts::FRAC_PI_2 * (1.0 + side * random.random_range(0.2..0.7));
                let grip = tip - Vector3::new(0.0, 60.0, -20.0);
                let rise = random.random_range(-0.5..0.0);
                world.bodies.extend(things::Cutlery::random(random, grip, turn, rise).bodies());
            }
        }
    }
}

fn place(at: usize, at_mm: Point2<f64>) -> Placed {
    let (object, ware) = WARES[at];
    Placed { object: object.into(), ware, at_mm, turn_rad: 0.0 }
}
