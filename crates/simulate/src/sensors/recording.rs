//! The packets of both sensors during one session.

use model::UtcNs;
use rand::Rng;

use super::{
    Accelerometer, MOUNT_PITCH_DEG, Motion, PACKET_PERIOD_S, RangeSensor, encode_packet, packet_sample_times_s,
};

/// Seconds by which the range sensor starts later than the accelerometer, so that their packets do not line up.
const RANGE_STARTS_S: f64 = 0.375;

/// A recording of both sensors during one session.
#[derive(Debug, Clone, Copy)]
pub struct Recording<'a> {
    /// Time at which the accelerometer's record begins.
    pub start: UtcNs,
    /// Motion of the head, in seconds since the start.
    pub motion: &'a Motion,
    /// Time for which both sensors record.
    pub duration_s: f64,
}

impl Recording<'_> {
    /// The packets of the accelerometer, in the order of time. The optical channel is not modelled, and is 0.
    #[must_use]
    pub fn acceleration(&self, random: impl Rng) -> Vec<Vec<u8>> {
        let Some(mut sensor) = Accelerometer::new(random, MOUNT_PITCH_DEG) else {
            return Vec::new();
        };
        let packet = |first_s: f64| {
            let mut channels = vec![Vec::new(); 4];
            for time_s in packet_sample_times_s(first_s) {
                let [x, y, z] = self.motion.pose_at(time_s).map_or([-1; 3], |pose| sensor.sample(pose));
                channels.iter_mut().zip([x, y, z, 0]).for_each(|(channel, count)| channel.push(count));
            }
            encode_packet(posix_s(self.start) + first_s, &channels)
        };
        self.packet_starts_s(0.0).map(packet).collect()
    }

    /// The packets of the range sensor, in the order of time.
    #[must_use]
    pub fn range(&self, random: &mut impl Rng) -> Vec<Vec<u8>> {
        let starts_s: Vec<f64> = self.packet_starts_s(RANGE_STARTS_S).collect();
        let end_s = starts_s.last().map_or(0.0, |last_s| last_s + PACKET_PERIOD_S);
        let sensor = RangeSensor::record(random, self.motion, end_s);
        let packet = |first_s: f64| {
            let counts = packet_sample_times_s(first_s).map(|time_s| sensor.reading_at(time_s)).collect();
            encode_packet(posix_s(self.start) + first_s, &[counts])
        };
        starts_s.into_iter().map(packet).collect()
    }

    /// The starts of the packets that cover the session, in seconds since its start. The first one is at `first_s`.
    fn packet_starts_s(&self, first_s: f64) -> impl Iterator<Item = f64> + use<> {
        let end_s = self.duration_s;
        (0_u32..)
            .map(move |packet| first_s + f64::from(packet) * PACKET_PERIOD_S)
            .take_while(move |start_s| *start_s < end_s)
    }
}

#[expect(clippy::cast_precision_loss, reason = "whole seconds are exact, and the rest is below 1 s")]
/// A time in seconds since 1970-01-01 UTC.
pub(crate) fn posix_s(time: UtcNs) -> f64 {
    let (seconds, nanoseconds) = (time.0.div_euclid(1_000_000_000), time.0.rem_euclid(1_000_000_000));
    seconds as f64 + nanoseconds as f64 * 1e-9
}
