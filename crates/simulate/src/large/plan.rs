//! The plan of a session, before anything is written. It follows from the seed and the number of the session alone.

use model::UtcNs;
use rand::seq::SliceRandom;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::damage::Damage;
use super::gallery::{Gallery, NEAR_POSES};
use super::objects::OBJECTS;
use super::options::LargeOptions;
use crate::sensors::{HeadPose, Motion};

/// Start of the first session, 2026-01-05 08:00:00 UTC.
const FIRST_START: UtcNs = UtcNs(1_767_600_000_000_000_000);
/// Seconds from the start of one session to that of the next.
const SESSION_PERIOD_S: f64 = 6.0 * 3600.0;

/// Number of sessions of one participant, which come one after the other.
const SESSIONS_PER_PARTICIPANT: usize = 10;

/// Seconds from the start of a session to its first image, which are not a multiple of a sample's period.
const FIRST_IMAGE_S: f64 = 10.25;
/// Seconds from one image to the next.
const IMAGE_PERIOD_S: f64 = 10.0;

/// Seconds between two images in which the head can turn.
const TURN_S: f64 = 1.6;

/// One image in so many is taken near the target pitch.
const NEAR_EVERY: usize = 3;
/// Of the images near the target pitch, the first one is marked, and about this share of the others.
const MARKED_SHARE: f64 = 0.5;

/// A use of randomness. Each use has a stream of its own, so that none depends on the length of another.
#[derive(Debug, Clone, Copy)]
pub(super) enum Use {
    Damaged,
    Noise,
    Poses,
    Plan,
    Acceleration,
    Range,
    Pictures,
    Damage,
}

/// The stream of randomness for a use in the `of`-th session, or for the `of`-th object.
pub(super) fn random(seed: u64, what: Use, of: usize) -> ChaCha8Rng {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream((of as u64) << 8 | what as u64);
    random
}

/// An image to be taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Shot {
    /// Index of the sight of its container that it shows.
    pub sight: usize,
    /// Whether the rater has marked it.
    pub marked: bool,
}

/// A session, which is one card with pictures of one container.
#[derive(Debug, Clone)]
pub(super) struct Session {
    pub number: usize,
    pub name: String,
    pub participant: String,
    pub damage: Option<Damage>,
}

impl Session {
    /// All sessions. The damaged ones are drawn by lot, and get the kinds of damage in turn.
    pub(super) fn all(options: &LargeOptions) -> Vec<Self> {
        let count = options.sessions as usize;
        let mut lot: Vec<usize> = (0..count).collect();
        lot.shuffle(&mut random(options.seed, Use::Damaged, 0));
        let mut damaged = lot[..options.damaged_sessions().min(count)].to_vec();
        damaged.sort_unstable();
        let damage_of = |number| damaged.binary_search(&number).ok().map(Damage::in_turn);
        (0..count)
            .map(|number| Self {
                number,
                name: format!("S{:05}", number + 1),
                participant: format!("P{:04}", number / SESSIONS_PER_PARTICIPANT + 1),
                damage: damage_of(number),
            })
            .collect()
    }

    /// Index in [`OBJECTS`] of the container that the session shows.
    pub(super) fn object(&self) -> usize {
        self.number % OBJECTS.len()
    }

    #[expect(clippy::cast_precision_loss, reason = "at most 100,000 sessions")]
    pub(super) fn start(&self) -> UtcNs {
        FIRST_START.plus_seconds(self.number as f64 * SESSION_PERIOD_S)
    }

    pub(super) fn shots(&self, options: &LargeOptions, gallery: &Gallery) -> Vec<Shot> {
        let mut random = random(options.seed, Use::Plan, self.number);
        let shot = |at: usize| {
            let sights = if at.is_multiple_of(NEAR_EVERY) { NEAR_POSES } else { gallery.sights.len() };
            let sight = random.random_range(0..sights);
            let by_chance = random.random_bool(MARKED_SHARE);
            Shot { sight, marked: at == 0 || (sight < NEAR_POSES && by_chance) }
        };
        (0..options.images as usize).map(shot).collect()
    }
}

/// The time of the `at`-th image in seconds since the start of the session.
#[expect(clippy::cast_precision_loss, reason = "some thousand images")]
pub(super) fn image_time_s(at: usize) -> f64 {
    FIRST_IMAGE_S + at as f64 * IMAGE_PERIOD_S
}

/// The motion of a head that rests at the pose of each image and turns in between.
pub(super) fn motion(heads: impl Iterator<Item = HeadPose>) -> Motion {
    let rests = heads.enumerate().map(|(at, head)| (image_time_s(at), head)).collect();
    Motion { rests, half_rest_s: 0.5 * (IMAGE_PERIOD_S - TURN_S) }
}
