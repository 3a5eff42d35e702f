//! The walk of a worn camera's pose from picture to picture.

use rand::Rng;

use crate::sensors::HeadPose;

/// Share of the way back to the pitch of rest that the pitch goes from one picture to the next.
const PULL: f64 = 0.3;

/// A bounded random walk of the pitch about a pitch of rest, and of the height. Ranges are (least, most).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Walk {
    pub first_pitch_deg: (f64, f64),
    pub pitch_deg: (f64, f64),
    pub rest_pitch_deg: f64,
    pub pitch_step_deg: f64,
    pub first_height_mm: (f64, f64),
    pub height_mm: (f64, f64),
    pub height_step_mm: f64,
    pub roll_deg: (f64, f64),
}

impl Walk {
    /// A random series of `number` poses in the order of time.
    pub fn poses(&self, random: &mut impl Rng, number: usize) -> Vec<HeadPose> {
        let mut pitch_deg = between(random, self.first_pitch_deg);
        let mut height_mm = between(random, self.first_height_mm);
        let pose = |_| {
            let step = between(random, (-self.pitch_step_deg, self.pitch_step_deg));
            pitch_deg += PULL * (self.rest_pitch_deg - pitch_deg) + step;
            pitch_deg = pitch_deg.clamp(self.pitch_deg.0, self.pitch_deg.1);
            height_mm += between(random, (-self.height_step_mm, self.height_step_mm));
            height_mm = height_mm.clamp(self.height_mm.0, self.height_mm.1);
            let roll_deg = between(random, self.roll_deg);
            HeadPose { pitch_deg, roll_deg, range_mm: height_mm / pitch_deg.to_radians().sin() }
        };
        (0..number).map(pose).collect()
    }
}

/// A random number from a range that may be a single point.
pub(super) fn between(random: &mut impl Rng, (least, most): (f64, f64)) -> f64 {
    if least < most { random.random_range(least..most) } else { least }
}
