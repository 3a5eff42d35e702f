//! Options of the preset `large`.

use std::ops::RangeInclusive;

use crate::error::SimulateError;

/// Limits of the options, which keep the packets of a session and the pictures of one object in memory.
const SESSIONS: RangeInclusive<u32> = 1..=100_000;
const IMAGES: RangeInclusive<u32> = 1..=2000;
const SIDE_PX: RangeInclusive<u32> = 32..=4096;

/// The options of the preset `large`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LargeOptions {
    /// Seed of all randomness. The same options give the same study.
    pub seed: u64,
    /// Number of sessions, 1 to 100,000.
    pub sessions: u32,
    /// Number of images of each session, 1 to 2000. There is one every 10 s.
    pub images: u32,
    /// Width and height of the pictures, 32 to 4096 px each.
    pub size_px: [u32; 2],
    /// Share of the sessions that are damaged, in per cent from 0 to 100.
    pub damage_pct: f64,
}

impl Default for LargeOptions {
    /// 300 whole sessions of 24 images of 320 x 240 px.
    fn default() -> Self {
        Self { seed: 1, sessions: 300, images: 24, size_px: [320, 240], damage_pct: 0.0 }
    }
}

impl LargeOptions {
    /// Refuses options that are out of range.
    pub(super) fn check(&self) -> Result<(), SimulateError> {
        let [width, height] = self.size_px;
        let numbers = [
            ("sessions", self.sessions, SESSIONS),
            ("images", self.images, IMAGES),
            ("image width", width, SIDE_PX),
            ("image height", height, SIDE_PX),
        ];
        if let Some((option, got, range)) = numbers.into_iter().find(|(_, got, range)| !range.contains(got)) {
            return Err(SimulateError::Option {
                option,
                got: got.to_string(),
                expected: format!("{} to {}", range.start(), range.end()),
            });
        }
        if !(0.0..=100.0).contains(&self.damage_pct) {
            let expected = "0 to 100 per cent of the sessions".to_owned();
            return Err(SimulateError::Option { option: "damage", got: self.damage_pct.to_string(), expected });
        }
        Ok(())
    }

    /// The number of sessions that are damaged: the share of all, rounded, with halves up.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a part of the sessions")]
    pub(super) fn damaged_sessions(&self) -> usize {
        (f64::from(self.sessions) * self.damage_pct / 100.0).round() as usize
    }
}
