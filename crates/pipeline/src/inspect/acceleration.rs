//! The facts of the accelerometer: the length of gravity, and the directions in which the camera looked.

use ingest::timeline::StreamFacts;
use ingest::{ReadError, SessionReader};
use jiff::tz::TimeZone;
use model::{Pose, UtcNs, median};
use nalgebra::Vector3;
use serde::Serialize;

use super::clock::ClockFacts;
use super::histogram::Histogram;
use crate::signals::down_in_camera;

/// The bins of the camera's pitch: 0 to 90 degrees.
const PITCH_BIN_DEG: f64 = 5.0;
const PITCH_BINS: u32 = 18;
/// The resolution of the median length.
const LENGTH_BIN_MG: f64 = 0.1;
/// Lengths up to 4 g are counted; a longer median is not known.
const LENGTH_BINS: u32 = 40_000;
/// No second has more samples than this. More (stamps that do not move) count as another second.
const LARGEST_SECOND: usize = 1 << 16;

const NS_PER_S: i64 = 1_000_000_000;

/// The facts of an accelerometer's recording.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AccelerationFacts {
    /// The facts of its clock.
    pub clock: ClockFacts,
    /// The median length of the specific force, to 0.1 mg, in 1/1000 of standard gravity; none without samples, or above 4
    /// g.
    pub length_median_mg: Option<f64>,
    /// The pitch of the camera in degrees, by the medians of x, y and z over each second: the depression of its axis below
    /// the horizontal, with the mount offset added.
    pub pitch_deg: Histogram,
}

/// The facts of the accelerometer's samples, streamed. None where the profile declares no accelerometer.
pub(super) fn read(
    reader: &mut SessionReader,
    facts: Option<&StreamFacts>,
    zone: &TimeZone,
    mount_pitch_deg: f64,
) -> Result<Option<AccelerationFacts>, ReadError> {
    let Some(facts) = facts else { return Ok(None) };
    let mut lengths_mg = Histogram::new(0.0, LENGTH_BIN_MG, LENGTH_BINS);
    let mut pitches = Pitches::new(mount_pitch_deg);
    reader.for_each_acceleration(|time, g| {
        let g = g.map(f64::from);
        lengths_mg.add(1000.0 * Vector3::from(g).norm());
        pitches.add(time, g);
    })?;
    Ok(Some(AccelerationFacts {
        clock: ClockFacts::new(facts, zone),
        length_median_mg: lengths_mg.median(),
        pitch_deg: pitches.finish(),
    }))
}

/// The pitch second by second; holds the samples of one second.
struct Pitches {
    mount_pitch_rad: f64,
    second: i64,
    axes: [Vec<f64>; 3],
    histogram: Histogram,
}

impl Pitches {
    fn new(mount_pitch_deg: f64) -> Self {
        Self {
            mount_pitch_rad: mount_pitch_deg.to_radians(),
            second: 0,
            axes: [Vec::new(), Vec::new(), Vec::new()],
            histogram: Histogram::new(0.0, PITCH_BIN_DEG, PITCH_BINS),
        }
    }

    fn add(&mut self, time: UtcNs, g: [f64; 3]) {
        let second = time.0.div_euclid(NS_PER_S);
        if second != self.second || self.axes[0].len() >= LARGEST_SECOND {
            self.end_of_second();
            self.second = second;
        }
        for (axis, value) in self.axes.iter_mut().zip(g) {
            axis.push(value);
        }
    }

    fn end_of_second(&mut self) {
        if self.axes[0].is_empty() {
            return;
        }
        let specific_force_g = Vector3::from(self.axes.each_mut().map(|axis| median(std::mem::take(axis))));
        let down = down_in_camera(&specific_force_g, self.mount_pitch_rad);
        if let Ok((pitch_rad, _)) = Pose::pitch_roll_of_down(&down) {
            self.histogram.add(pitch_rad.to_degrees());
        }
    }

    fn finish(mut self) -> Histogram {
        self.end_of_second();
        self.histogram
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_second_counts_once_with_its_median() {
        let mut pitches = Pitches::new(21.0);
        let (sin, cos) = 30_f64.to_radians().sin_cos();
        for i in 0..30 {
            // Two seconds of a head that looks 30 degrees down, a bump among them, then half a second upright.
            let g = if i == 7 {
                [3.0, 3.0, 3.0]
            } else if i < 24 {
                [0.0, -cos, -sin]
            } else {
                [0.0, -1.0, 0.0]
            };
            pitches.add(UtcNs(i * NS_PER_S / 12), g);
        }
        let histogram = pitches.finish();
        assert_eq!((histogram.counts[10], histogram.counts[4], histogram.total()), (2, 1, 3));
    }

    #[test]
    fn stamps_that_do_not_move_take_no_more_memory() {
        let mut pitches = Pitches::new(0.0);
        (0..3 * LARGEST_SECOND).for_each(|_| pitches.add(UtcNs(0), [0.0, -1.0, 0.0]));
        assert!(pitches.axes[0].len() <= LARGEST_SECOND);
        assert_eq!(pitches.finish().counts[0], 3);
    }
}
