//! The plan of a session before it is written, and its streams of randomness.

use model::UtcNs;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::frame::Frame;
use crate::sensors::Motion;

/// Start of the first session, 2026-02-02 08:00:00 UTC.
const FIRST_START: UtcNs = UtcNs(1_770_019_200_000_000_000);
/// Seconds from the start of one session to that of the next.
const SESSION_PERIOD_S: f64 = 6.0 * 3600.0;

/// The plan of a session.
#[derive(Debug, Clone)]
pub struct Plan {
    /// Its name.
    pub name: String,
    /// Height in mm and pitch in degrees of the setup, on a bench.
    pub setup: Option<(f64, f64)>,
    /// The person who wears the camera; none on a bench.
    pub participant: Option<String>,
    /// Motion of the head.
    pub motion: Motion,
    /// Amplitude of the sway of a living head about that motion.
    pub sway_deg: f64,
    /// Its pictures, in the order of time.
    pub frames: Vec<Frame>,
    /// Its number among the sessions, from 0.
    pub number: usize,
}

impl Plan {
    /// The time at which it starts.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "a few sessions")]
    pub fn start(&self) -> UtcNs {
        FIRST_START.plus_seconds(self.number as f64 * SESSION_PERIOD_S)
    }
}

/// A use of randomness. Each use has a stream of its own, so that none depends on the length of another.
#[derive(Debug, Clone, Copy)]
pub(super) enum Use {
    Scene,
    Head,
    Acceleration,
    Range,
    Image,
    Glaze,
    Food,
}

/// The stream of randomness for a use in the `of`-th session or picture.
pub(super) fn random(seed: u64, what: Use, of: usize) -> ChaCha8Rng {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream((of as u64) << 8 | what as u64);
    random
}
