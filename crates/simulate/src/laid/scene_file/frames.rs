//! Plans the sessions of a scene file.

use nalgebra::Point2;
use rand::Rng;

use super::sessions::{Session, Stance, View};
use super::{Container, SceneSpec};
use crate::laid::frame::{Frame, Placed};
use crate::laid::plan::{Plan, Use, random};
use crate::laid::things::Vessel;
use crate::laid::walk::between;
use crate::laid::{sway, table, things};
use crate::sensors::Motion;
use crate::world::photo::Exposure;
use crate::world::{Material, World};

/// Seconds after the first period at which the first picture is taken.
const LATER_S: f64 = 0.25;
/// Seconds that the head takes to turn between two pictures.
const TURN_S: f64 = 3.0;
/// SD of a head's motion while a picture is taken, as a share of the picture's width.
const HEAD_MOTION: f64 = 0.0012;
/// A number greater than that of a session's images, which keeps the streams of randomness of different sessions apart.
const MOST_IMAGES: usize = 4096;

/// A planner of the sessions of a scene.
pub(super) struct Planner<'a> {
    scene: &'a SceneSpec,
    seed: u64,
    width_px: u32,
    /// The glaze of each container.
    glazes: Vec<Material>,
}

/// The table of a session before anything is served.
struct Table {
    world: World,
    vessels: Vec<Vessel>,
}

impl<'a> Planner<'a> {
    pub fn new(scene: &'a SceneSpec, seed: u64, width_px: u32) -> Self {
        let glaze = |(at, each): (usize, &Container)| {
            let mut lot = random(seed, Use::Glaze, at);
            let drawn = table::glaze(&mut lot, &each.ware);
            each.surface.as_ref().map_or(drawn, |surface| surface.material(each.gloss_pct, lot.random()))
        };
        Self { scene, seed, width_px, glazes: scene.containers().enumerate().map(glaze).collect() }
    }

    /// The number of sessions, and that of all images.
    pub fn extent(&self) -> (usize, u64) {
        let images = |session: &Session| session.images(self.scene.served(session).len()) as u64;
        (self.scene.sessions.len(), self.scene.sessions.iter().map(|session| images(&session.0)).sum())
    }

    pub fn plan(&self, number: usize) -> Plan {
        let session = &self.scene.sessions[number].0;
        let served = self.scene.served(session);
        let images = session.images(served.len());
        let table = self.table(number);
        let stances = self.stances(number, session, images);
        let (motion, sway_deg) = motion(session, &stances);
        let frames = stances.iter().enumerate().map(|(at, stance)| {
            let head = sway(stance.head, sway_deg, number, time_s(session, at));
            let stance = Stance { head, ..*stance };
            self.frame(number, session, &served, &table, stance, (at, images))
        });
        Plan {
            name: session.name.clone(),
            setup: match session.view {
                View::Stand(stance, _) => Some((height_mm(&stance), stance.head.pitch_deg)),
                View::Poses(_) | View::Head(_) => None,
            },
            participant: session.participant.clone(),
            frames: frames.collect(),
            motion,
            sway_deg,
            number,
        }
    }

    fn table(&self, number: usize) -> Table {
        let mut lot = random(self.seed, Use::Scene, number);
        let mut world = table::bare(&mut lot);
        if let Some(table) = &self.scene.table {
            world.table = table.material(lot.random());
            world.table_mm = table.place(world.table_mm);
        }
        if let Some(light) = &self.scene.light {
            world.light = light.0;
        }
        let glasses: Vec<_> = self.scene.glasses.iter().map(super::GlassSpec::glass).collect();
        world.bodies.extend(glasses.iter().flat_map(things::Glass::bodies));
        world.bodies.extend(self.scene.cutlery.iter().flat_map(super::CutlerySpec::bodies));
        for napkin in &self.scene.napkins {
            world.bodies.extend(napkin.bodies(&mut lot));
        }
        for telephone in &self.scene.telephones {
            world.bodies.extend(telephone.bodies(&mut lot));
        }
        Table { world, vessels: glasses.iter().map(|glass| glass.vessel).collect() }
    }

    fn stances(&self, number: usize, session: &Session, images: usize) -> Vec<Stance> {
        match &session.view {
            View::Stand(stance, _) => vec![*stance; images],
            View::Poses(poses) => poses.clone(),
            View::Head(head) => {
                let mut lot = random(self.seed, Use::Head, number);
                let heads = head.walk.poses(&mut lot, images);
                let mut about = |most: f64| between(&mut lot, (-most, most));
                let stance = |pose| {
                    let over = Point2::new(about(head.shift_mm), about(head.shift_mm));
                    Stance { head: pose, stand: (over, about(head.yaw_rad)) }
                };
                heads.into_iter().map(stance).collect()
            }
        }
    }

    fn frame(
        &self,
        number: usize,
        session: &Session,
        served: &[(usize, &Container)],
        table: &Table,
        stance: Stance,
        (at, images): (usize, usize),
    ) -> Frame {
        let mut lot = random(self.seed, Use::Image, number * MOST_IMAGES + at);
        let mut world = table.world.clone();
        let shown: Vec<_> = self.shown(session, served, (at, images)).collect();
        for (index, each) in &shown {
            world.bodies.extend(each.ware.bodies(each.at_mm, each.turn_rad, &self.glazes[*index]));
            let full = each.full * (1.0 - session.eaten * through(at, images.saturating_sub(1)));
            if each.full > 0.0 {
                // All images of a session have the same randomness, so that they show the same food, and less and less of it.
                let mut food = random(self.seed, Use::Food, number * MOST_IMAGES + index);
                world.bodies.extend(things::food(&mut food, &each.ware, each.at_mm, full));
            }
        }
        for hand in &self.scene.hands {
            world.bodies.extend(hand.0.bodies(&mut lot));
        }
        let placed = |(_, each): &&(usize, &Container)| Placed {
            object: each.name.as_str().into(),
            ware: each.ware,
            at_mm: each.at_mm,
            turn_rad: each.turn_rad,
        };
        Frame {
            time_s: time_s(session, at),
            world,
            placed: shown.iter().map(placed).collect(),
            vessels: table.vessels.clone(),
            head: stance.head,
            stand: stance.stand,
            exposure: self.exposure(&mut lot, session),
            seed: lot.random(),
        }
    }

    /// The containers on the table in an image.
    fn shown<'b>(
        &self,
        session: &Session,
        served: &'b [(usize, &'a Container)],
        (at, images): (usize, usize),
    ) -> impl Iterator<Item = &'b (usize, &'a Container)> + use<'a, 'b> {
        let is_laid = (session.bare[0]..1.0 - session.bare[1]).contains(&through(at, images));
        let only = session.one_at_a_time.then(|| at % served.len().max(1));
        served
            .iter()
            .enumerate()
            .filter(move |(i, _)| is_laid && only.is_none_or(|only| only == *i))
            .map(|(_, each)| each)
    }

    fn exposure(&self, lot: &mut impl Rng, session: &Session) -> Exposure {
        let motion = if matches!(session.view, View::Head(_)) { HEAD_MOTION } else { 0.0 };
        let drawn = table::exposure(lot, self.width_px, motion);
        self.scene.picture.clone().map_or(drawn, Exposure::from)
    }
}

fn motion(session: &Session, stances: &[Stance]) -> (Motion, f64) {
    let rests = stances.iter().enumerate().map(|(at, stance)| (time_s(session, at), stance.head)).collect();
    let resting = Motion { rests, half_rest_s: 0.5 * (session.period_s - TURN_S) };
    match &session.view {
        View::Stand(stance, _) => (Motion::fixed(stance.head), 0.0),
        View::Poses(_) => (resting, 0.0),
        View::Head(head) => (resting, head.sway_deg),
    }
}

#[expect(clippy::cast_precision_loss, reason = "some thousand images")]
fn time_s(session: &Session, at: usize) -> f64 {
    session.period_s * (at as f64 + 1.0) + LATER_S
}

#[expect(clippy::cast_precision_loss, reason = "some thousand images")]
fn through(at: usize, images: usize) -> f64 {
    at as f64 / images.max(1) as f64
}

fn height_mm(stance: &Stance) -> f64 {
    stance.head.range_mm * stance.head.pitch_deg.to_radians().sin()
}
