//! A session before it is written, and its lots.

use model::UtcNs;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::frame::Frame;
use crate::sensors::Motion;

/// 2026-02-02 08:00:00 UTC, and from one session to the next.
const FIRST_START: UtcNs = UtcNs(1_770_019_200_000_000_000);
const SESSION_PERIOD_S: f64 = 6.0 * 3600.0;

/// A session.
#[derive(Debug, Clone)]
pub struct Plan {
    /// Its name.
    pub name: String,
    /// Height (mm) and pitch (degrees) of a bench's setup.
    pub setup: Option<(f64, f64)>,
    /// Who wears the camera; on a bench nobody.
    pub participant: Option<String>,
    /// How the head moves.
    pub motion: Motion,
    /// Sway of a living head about that, in degrees (amplitude).
    pub sway_deg: f64,
    /// Its pictures, in the order of time.
    pub frames: Vec<Frame>,
    /// Its place among the sessions.
    pub number: usize,
}

impl Plan {
    /// When it starts.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "a few sessions")]
    pub fn start(&self) -> UtcNs {
        FIRST_START.plus_seconds(self.number as f64 * SESSION_PERIOD_S)
    }
}

/// What the randomness is used for: each use has its own stream, so that one does not depend on another's length.
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

/// A stream of randomness, for the `of`-th session or picture.
pub(super) fn random(seed: u64, what: Use, of: usize) -> ChaCha8Rng {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream((of as u64) << 8 | what as u64);
    random
}
