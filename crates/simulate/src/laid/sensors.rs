//! The packets that the sensors of a session store, with the errors of real sensors.

use model::Camera;
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::plan::{Plan, Use, random};
use super::sway;
use crate::error::SimulateError;
use crate::sensors::{
    HeadPose, MOUNT_PITCH_DEG, PACKET_PERIOD_S, encode_packet, packet_sample_times_s, posix_s, up_in_device,
};

/// Counts of the ADXL362 per g, in the range of +-2 g.
const COUNTS_PER_G: f64 = 1000.0;
/// Seconds from one reading of the VL53L0X to the next.
const READING_S: f64 = 0.033;
/// Code of the VL53L0X for no target.
const NO_TARGET: i16 = 8190;
/// Seconds by which the range sensor starts later than the accelerometer, so that their packets do not line up.
const RANGE_STARTS_S: f64 = 0.375;
/// Seconds for which the recording goes on after the last picture.
const AFTER_S: f64 = 6.0;

/// The errors of the sensors of a study.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SensorErrors {
    /// Zero-g offset of each axis of the accelerometer; none where each session draws its own.
    pub zero_g_offset_mg: Option<[f64; 3]>,
    /// SD of the zero-g offsets that sessions draw.
    pub zero_g_offset_sd_mg: f64,
    /// SD of a sample of the accelerometer.
    pub acceleration_noise_mg: f64,
    /// Scale of the range sensor less one; none where each session draws its own.
    pub range_scale: Option<f64>,
    /// SD of the scales that sessions draw.
    pub range_scale_sd: f64,
    /// SD of a reading of the range sensor, as a share of the distance.
    pub range_noise: f64,
    /// Least SD of a reading of the range sensor.
    pub range_noise_least_mm: f64,
    /// Share of the readings that are lost.
    pub range_lost: f64,
    /// Share of the readings that are held for another period.
    pub range_held: f64,
    /// The greatest distance that the range sensor reads.
    pub range_furthest_mm: f64,
}

impl Default for SensorErrors {
    /// The errors of typical sensors. ADXL362: a noise of 550 ug/sqrt Hz over 50 Hz, and zero-g offsets after soldering (data sheet,
    /// table 1: up to 35 mg on X and Y; most are smaller). VL53L0X: the ranging errors of its data sheet, table 11, and its reach
    /// over dark surfaces.
    fn default() -> Self {
        Self {
            zero_g_offset_mg: None,
            zero_g_offset_sd_mg: 8.0,
            acceleration_noise_mg: 4.0,
            range_scale: None,
            range_scale_sd: 0.01,
            range_noise: 0.012,
            range_noise_least_mm: 2.0,
            range_lost: 0.03,
            range_held: 0.02,
            range_furthest_mm: 1200.0,
        }
    }
}

fn normal(random: &mut ChaCha8Rng) -> f64 {
    StandardNormal.sample(random)
}

#[expect(clippy::cast_possible_truncation, reason = "the float-to-integer cast saturates, as the sensors do")]
fn to_count(value: f64) -> i16 {
    value.round() as i16
}

impl Plan {
    fn head_at(&self, time_s: f64) -> Option<HeadPose> {
        Some(sway(self.motion.pose_at(time_s)?, self.sway_deg, self.number, time_s))
    }

    fn packet_starts_s(&self, first_s: f64) -> impl Iterator<Item = f64> + use<> {
        let end_s = self.frames.last().map_or(0.0, |frame| frame.time_s) + AFTER_S;
        (0_u32..)
            .map(move |packet| first_s + f64::from(packet) * PACKET_PERIOD_S)
            .take_while(move |start| *start < end_s)
    }

    /// The packets of the accelerometer, with gravity, noise and zero-g offset.
    pub(super) fn acceleration(&self, seed: u64, errors: &SensorErrors) -> Vec<Vec<u8>> {
        let mut random = random(seed, Use::Acceleration, self.number);
        let drawn: [f64; 3] = std::array::from_fn(|_| errors.zero_g_offset_sd_mg * normal(&mut random));
        let offset = errors.zero_g_offset_mg.unwrap_or(drawn);
        let packet = |first_s: f64| {
            let mut channels = vec![Vec::new(); 4];
            for time_s in packet_sample_times_s(first_s) {
                let up = self.head_at(time_s).map_or([0.0; 3], |head| up_in_device(head, MOUNT_PITCH_DEG));
                for axis in 0..3 {
                    let noise = errors.acceleration_noise_mg * normal(&mut random);
                    let mg = COUNTS_PER_G * up[axis] + offset[axis] + noise;
                    channels[axis].push(to_count(mg));
                }
                channels[3].push(0);
            }
            encode_packet(posix_s(self.start()) + first_s, &channels)
        };
        self.packet_starts_s(0.0).map(packet).collect()
    }

    /// The packets of the range sensor. At each picture it reads its cone over the things there, and in between in proportion to the
    /// distance to the table. Noise, scale, and held and lost readings are added.
    pub(super) fn range(
        &self,
        seed: u64,
        camera: &Camera,
        errors: &SensorErrors,
    ) -> Result<Vec<Vec<u8>>, SimulateError> {
        let mut random = random(seed, Use::Range, self.number);
        let drawn = errors.range_scale_sd * normal(&mut random);
        let scale = 1.0 + errors.range_scale.unwrap_or(drawn);
        let shares = self
            .frames
            .iter()
            .map(|frame| Ok((frame.time_s, frame.cone_mm(&frame.view(camera)?) / frame.head.range_mm)));
        let shares: Vec<(f64, f64)> = shares.collect::<Result<_, SimulateError>>()?;
        let starts_s: Vec<f64> = self.packet_starts_s(RANGE_STARTS_S).collect();
        let end_s = starts_s.last().map_or(0.0, |last| last + PACKET_PERIOD_S);
        let (mut readings, mut time_s) = (Vec::new(), 0.0);
        while time_s < end_s {
            let seen_mm =
                self.head_at(time_s).map_or(f64::NAN, |head| head.range_mm * between(&shares, time_s) * scale);
            let sd_mm = (errors.range_noise * seen_mm).max(errors.range_noise_least_mm);
            let noisy_mm = seen_mm + normal(&mut random) * sd_mm;
            let (is_lost, is_held) = (random.random_bool(errors.range_lost), random.random_bool(errors.range_held));
            readings.push(match readings.last() {
                Some(held) if is_held => *held,
                _ if is_lost || noisy_mm.is_nan() || noisy_mm > errors.range_furthest_mm => NO_TARGET,
                _ => to_count(noisy_mm),
            });
            time_s += READING_S;
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an index of a reading")]
        let held = |time_s: f64| readings.get((time_s / READING_S) as usize).copied().unwrap_or(NO_TARGET);
        let packet = |first_s: f64| {
            encode_packet(posix_s(self.start()) + first_s, &[packet_sample_times_s(first_s).map(held).collect()])
        };
        Ok(starts_s.into_iter().map(packet).collect())
    }
}

/// The value at a time, interpolated between the nearest two of (time, value). Beyond the ends it is that of the end.
fn between(values: &[(f64, f64)], time_s: f64) -> f64 {
    let next = values.partition_point(|(at, _)| *at <= time_s);
    match (next.checked_sub(1).and_then(|i| values.get(i)), values.get(next)) {
        (Some(a), Some(b)) => a.1 + (b.1 - a.1) * (time_s - a.0) / (b.0 - a.0),
        (Some(only), None) | (None, Some(only)) => only.1,
        (None, None) => 1.0,
    }
}
