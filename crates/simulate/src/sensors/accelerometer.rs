//! A model of the accelerometer ADXL362: gravity, noise, and counts of 1 mg.

use rand::Rng;
use rand_distr::{Distribution, Normal};

use super::motion::HeadPose;

/// Counts per g in the range of +-2 g.
const COUNTS_PER_G: f64 = 1000.0;

/// SD of the noise before it is shaped, in counts (mg). Shaping multiplies it by sqrt 2, which gives the sensor's 4 mg.
const NOISE_COUNTS: f64 = 2.8;

/// An accelerometer on a turning head. It reads gravity and noise; the acceleration of the head's own motion is left out.
///
/// Noise and rounding are *shaped*: the next sample takes back the error of each sample. So the sum over any window is right
/// to a few counts, and its mean keeps the published pitch to about 0.003 degrees, although one count is 0.06 degrees. The noise
/// of a real sensor is not so kind, but here the noise must not hide an error of arithmetic.
#[derive(Debug, Clone)]
pub struct Accelerometer<R> {
    random: R,
    noise: Normal<f64>,
    mount_pitch_deg: f64,
    owed_counts: [f64; 3],
}

impl<R: Rng> Accelerometer<R> {
    /// An accelerometer on a device whose camera looks `mount_pitch_deg` further down than the sensor's forward axis. None where
    /// the distribution of the noise is not possible, which does not occur.
    pub fn new(random: R, mount_pitch_deg: f64) -> Option<Self> {
        let noise = Normal::new(0.0, NOISE_COUNTS).ok()?;
        Some(Self { random, noise, mount_pitch_deg, owed_counts: [0.0; 3] })
    }

    /// The next sample in counts: x right, y down, z forward in the device frame. At rest and upright it is (0, -1000, 0), the
    /// specific force that holds the head up.
    pub fn sample(&mut self, pose: HeadPose) -> [i16; 3] {
        let true_counts = up_in_device(pose, self.mount_pitch_deg).map(|share| COUNTS_PER_G * share);
        std::array::from_fn(|axis| {
            let wanted = true_counts[axis] - self.owed_counts[axis];
            let stored = to_count(wanted + self.noise.sample(&mut self.random));
            self.owed_counts[axis] = f64::from(stored) - wanted;
            stored
        })
    }
}

/// The unit vector 'up' in the device frame: the one in the camera frame, turned up by the mount about the axis x, which both
/// frames share.
pub(crate) fn up_in_device(pose: HeadPose, mount_pitch_deg: f64) -> [f64; 3] {
    let (sin_pitch, cos_pitch) = pose.pitch_deg.to_radians().sin_cos();
    let (sin_roll, cos_roll) = pose.roll_deg.to_radians().sin_cos();
    let (sin_mount, cos_mount) = mount_pitch_deg.to_radians().sin_cos();
    let (down_y, down_z) = (cos_roll * cos_pitch, sin_pitch);
    [-sin_roll * cos_pitch, -(cos_mount * down_y + sin_mount * down_z), -(cos_mount * down_z - sin_mount * down_y)]
}

#[expect(clippy::cast_possible_truncation, reason = "the float-to-integer cast saturates, as the sensor does")]
fn to_count(value: f64) -> i16 {
    value.round() as i16
}
