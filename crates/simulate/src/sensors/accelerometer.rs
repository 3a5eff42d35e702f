//! A model of the ADXL362: gravity, noise, and counts of 1 mg.

use rand::Rng;
use rand_distr::{Distribution, Normal};

use super::motion::HeadPose;

/// Counts per g at +-2 g.
const COUNTS_PER_G: f64 = 1000.0;

/// SD of the noise before shaping, in counts (mg). Shaping raises it by sqrt 2, to the sensor's 4 mg.
const NOISE_COUNTS: f64 = 2.8;

/// The accelerometer's counts for a turning head. Only gravity and noise: the acceleration of the head's own motion is
/// left out.
///
/// Noise and rounding are *shaped*: what one sample is off by is taken back by the next one, so that the sum over any
/// window is right to a few counts and its mean keeps the published pitch to about 0.003 degrees, though one count is
/// 0.06 degrees. A real sensor's noise is not so kind; here the noise must not hide an error of arithmetic.
#[derive(Debug, Clone)]
pub struct Accelerometer<R> {
    random: R,
    noise: Normal<f64>,
    mount_pitch_deg: f64,
    owed_counts: [f64; 3],
}

impl<R: Rng> Accelerometer<R> {
    /// `mount_pitch_deg`: how much further down the camera looks than the sensor's forward axis. None if the noise
    /// model has no such distribution (it always has).
    pub fn new(random: R, mount_pitch_deg: f64) -> Option<Self> {
        let noise = Normal::new(0.0, NOISE_COUNTS).ok()?;
        Some(Self { random, noise, mount_pitch_deg, owed_counts: [0.0; 3] })
    }

    /// The next sample: x right, y down, z forward in the device frame. At rest upright it reads (0, -1000, 0), the
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

/// The unit vector 'up' in the device frame: that of the camera, turned up by the mount about the axis x that both share.
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
