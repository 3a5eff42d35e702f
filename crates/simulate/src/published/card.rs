//! Writes the files of a session, its card and its marks, from its plan.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::plan::{SessionPlan, ShotPlan};
use crate::error::SimulateError;
use crate::render::Renderer;
use crate::sensors::Recording;
use crate::study::{StudyFolder, image_stem, labelme_json};

/// A writer of sessions into a study.
pub(super) struct CardWriter<'a> {
    pub folder: &'a StudyFolder,
    pub seed: u64,
    pub size_px: [u32; 2],
    /// The renderer of pictures; none where there are to be no pictures.
    pub renderer: Option<Renderer>,
}

impl CardWriter<'_> {
    /// Writes session.toml and the packets of the sensors. Those of each sensor are in two files.
    pub(super) fn write_sensors(&self, session: &SessionPlan) -> Result<(), SimulateError> {
        let card = format!("cards/{}", session.name);
        self.folder.write(&format!("{card}/session.toml"), session.toml.as_bytes())?;
        let recording = Recording { start: session.start, motion: &session.motion, duration_s: session.duration_s() };
        let acceleration = recording.acceleration(self.random(session, 1));
        let range = recording.range(&mut self.random(session, 2));
        for (prefix, packets) in [("ACC", acceleration), ("RNG", range)] {
            let (first, second) = packets.split_at(packets.len() / 2);
            self.folder.write(&format!("{card}/SENSORS/{prefix}0001.BIN"), &first.concat())?;
            self.folder.write(&format!("{card}/SENSORS/{prefix}0002.BIN"), &second.concat())?;
        }
        Ok(())
    }

    /// The stream of noise of a sensor in a session. Each has its own, so that none depends on the length of another.
    fn random(&self, session: &SessionPlan, sensor: u64) -> ChaCha8Rng {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        random.set_stream(session.start.0.unsigned_abs() ^ sensor);
        random
    }

    /// Writes the picture, where pictures are wanted, and the marks of every rater.
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
