//! A session plan -> the files of its card and its marks.

use model::UtcNs;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::plan::{SessionPlan, ShotPlan};
use crate::error::SimulateError;
use crate::render::Renderer;
use crate::sensors::{Accelerometer, HeadPose, PACKET_PERIOD_S, RangeSensor, encode_packet, packet_sample_times_s};
use crate::study::{StudyFolder, image_stem, labelme_json};

/// How much further down the camera looks than the accelerometer's forward axis (the profile's `mount_pitch_deg`).
const MOUNT_PITCH_DEG: f64 = 21.0;

/// Writes sessions into a study.
pub(super) struct CardWriter<'a> {
    pub folder: &'a StudyFolder,
    pub seed: u64,
    pub size_px: [u32; 2],
    /// None: no pictures.
    pub renderer: Option<Renderer>,
}

impl CardWriter<'_> {
    /// session.toml and the sensors' packets, each sensor's in two files.
    pub(super) fn write_sensors(&self, session: &SessionPlan) -> Result<(), SimulateError> {
        let card = format!("cards/{}", session.name);
        self.folder.write(&format!("{card}/session.toml"), session.toml.as_bytes())?;
        for (prefix, packets) in [("ACC", self.acceleration(session)), ("RNG", self.range(session))] {
            let (first, second) = packets.split_at(packets.len() / 2);
            self.folder.write(&format!("{card}/SENSORS/{prefix}0001.BIN"), &first.concat())?;
            self.folder.write(&format!("{card}/SENSORS/{prefix}0002.BIN"), &second.concat())?;
        }
        Ok(())
    }

    /// Each session and sensor has its own stream of noise, so that one does not depend on another's length.
    fn random(&self, session: &SessionPlan, sensor: u64) -> ChaCha8Rng {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        random.set_stream(session.start.0.unsigned_abs() ^ sensor);
        random
    }

    fn acceleration(&self, session: &SessionPlan) -> Vec<Vec<u8>> {
        let Some(mut sensor) = Accelerometer::new(self.random(session, 1), MOUNT_PITCH_DEG) else {
            return Vec::new();
        };
        let packet = |first_s: f64| {
            let mut channels = vec![Vec::new(); 4];
            for time_s in packet_sample_times_s(first_s) {
                // The optical channel is not modelled: 0.
                let [x, y, z] = session.motion.at(time_s).map_or([-1; 3], |pose: HeadPose| sensor.sample(pose));
                channels.iter_mut().zip([x, y, z, 0]).for_each(|(channel, count)| channel.push(count));
            }
            encode_packet(posix_s(session.start) + first_s, &channels)
        };
        packet_starts_s(session, 0.0).map(packet).collect()
    }

    fn range(&self, session: &SessionPlan) -> Vec<Vec<u8>> {
        let starts_s: Vec<f64> = packet_starts_s(session, RANGE_STARTS_S).collect();
        let end_s = starts_s.last().map_or(0.0, |last_s| last_s + PACKET_PERIOD_S);
        let sensor = RangeSensor::record(&mut self.random(session, 2), &session.motion, end_s);
        let packet = |first_s: f64| {
            let counts = packet_sample_times_s(first_s).map(|time_s| sensor.at(time_s)).collect();
            encode_packet(posix_s(session.start) + first_s, &[counts])
        };
        starts_s.into_iter().map(packet).collect()
    }

    /// The picture, if pictures are wanted, and every rater's marks.
    pub(super) fn write_shot(&self, session: &SessionPlan, shot: &ShotPlan) -> Result<(), SimulateError> {
        let stem = image_stem(session.start.plus_seconds(shot.time_s))?;
        let image = format!("cards/{}/IMAGES/{stem}.JPG", session.name);
        if let Some(renderer) = &self.renderer {
            let jpeg = renderer.render(&shot.scene, &shot.pose).to_jpeg(&image)?;
            self.folder.write(&image, &jpeg)?;
        }
        for marks in &shot.marks {
            let json = labelme_json(&format!("../../../{image}"), self.size_px, &marks.lines)?;
            self.folder.write(&format!("marks/{}/{}/{stem}.json", marks.rater, session.name), &json)?;
        }
        Ok(())
    }
}

/// The range sensor starts later than the accelerometer, so that their packets do not line up.
const RANGE_STARTS_S: f64 = 0.375;

/// Starts of the packets that cover a session, in seconds since its own start.
fn packet_starts_s(session: &SessionPlan, first_s: f64) -> impl Iterator<Item = f64> + use<> {
    let end_s = session.duration_s();
    (0_u32..)
        .map(move |packet| first_s + f64::from(packet) * PACKET_PERIOD_S)
        .take_while(move |start_s| *start_s < end_s)
}

#[expect(clippy::cast_precision_loss, reason = "whole seconds are exact, and the rest is below 1 s")]
fn posix_s(time: UtcNs) -> f64 {
    let (seconds, nanoseconds) = (time.0.div_euclid(1_000_000_000), time.0.rem_euclid(1_000_000_000));
    seconds as f64 + nanoseconds as f64 * 1e-9
}
