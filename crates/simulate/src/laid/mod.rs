//! The presets `bench` and `worn`: laid tables that are as hard as real ones, recorded by sensors that err as real ones do, with
//! their truth.
//!
//! [`bench()`] and [`worn()`] plan sessions. Every [`Frame`] is a world, a pose and an exposure; it can be photographed, and it
//! gives the truth, without any file. [`write()`] makes a study of them. Everything follows from the seed alone, for any number
//! of threads.

mod bench;
mod catalogue;
mod frame;
mod options;
mod plan;
mod rectangular;
mod scene_file;
mod sensors;
mod table;
#[cfg(test)]
mod tests;
mod things;
mod walk;
mod ware;
mod worn;
mod write;

pub use bench::bench;
pub use frame::{Frame, Placed, Truth};
pub use options::{LaidOptions, LaidPreset, camera, write};
pub use plan::Plan;
pub use scene_file::{SceneCamera, SceneSpec};
pub use things::Vessel;
pub use ware::{Wall, Ware};
pub use worn::worn;

use crate::sensors::HeadPose;

/// Periods of the sway of a living head, in seconds, and their shares of its amplitude.
const SWAYS: [(f64, f64); 3] = [(4.3, 0.5), (1.9, 0.3), (0.8, 0.2)];

/// The pose at a time of a head that sways about `head` by up to `amplitude_deg`, at the same height. `number` tells sessions
/// apart.
fn sway(head: HeadPose, amplitude_deg: f64, number: usize, time_s: f64) -> HeadPose {
    if amplitude_deg <= 0.0 {
        return head;
    }
    #[expect(clippy::cast_precision_loss, reason = "a phase")]
    let phase = number as f64;
    let sum = |turn: f64| -> f64 {
        let part = |(period_s, share): (f64, f64)| {
            share * (std::f64::consts::TAU * time_s / period_s + phase * period_s + turn).sin()
        };
        SWAYS.into_iter().map(part).sum()
    };
    let height_mm = head.range_mm * head.pitch_deg.to_radians().sin();
    let pitch_deg = head.pitch_deg + amplitude_deg * sum(0.0);
    HeadPose {
        pitch_deg,
        roll_deg: head.roll_deg + amplitude_deg * sum(1.6),
        range_mm: height_mm / pitch_deg.to_radians().sin(),
    }
}
