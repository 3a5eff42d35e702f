//! Writes the files of a session, its card and its marks, from its plan.

use model::UtcNs;
use model::results::TruthRow;
use rand_chacha::ChaCha8Rng;

use super::damage::{Damage, Sensor, SessionFile};
use super::gallery::{Gallery, Noise};
use super::objects::{Object, TrueSizes};
use super::options::LargeOptions;
use super::plan::{Session, Shot, Use, image_time_s, motion, random};
use crate::error::SimulateError;
use crate::render::Picture;
use crate::sensors::{HeadPose, Recording};
use crate::study::{StudyFolder, image_stem, labelme_json};

/// The only rater.
const RATER: &str = "R1";

/// A writer of the sessions of one container.
pub(super) struct SessionWriter<'a> {
    pub folder: &'a StudyFolder,
    pub options: &'a LargeOptions,
    pub object: &'a Object,
    pub gallery: &'a Gallery,
    pub noise: &'a Noise,
}

impl SessionWriter<'_> {
    /// Writes the card and the marks of a session, and returns its truth.
    pub(super) fn write(&self, session: &Session) -> Result<Vec<TruthRow>, SimulateError> {
        let mut files = Files {
            folder: self.folder,
            damage: session.damage,
            random: random(self.options.seed, Use::Damage, session.number),
        };
        let card = format!("cards/{}", session.name);
        self.folder.make_folder(&card)?; // it is there even when it is empty
        let toml = format!("participant = \"{}\"\n", session.participant);
        files.write(SessionFile::Toml, &format!("{card}/session.toml"), toml.into_bytes())?;
        let shots = session.shots(self.options, self.gallery);
        self.write_packets(&mut files, session, &card, &shots)?;
        let mut light = random(self.options.seed, Use::Pictures, session.number);
        let write_shot = |(at, shot)| self.write_shot(&mut files, session, at, shot, &mut light);
        shots.iter().enumerate().map(write_shot).collect()
    }

    fn write_packets(
        &self,
        files: &mut Files<'_>,
        session: &Session,
        card: &str,
        shots: &[Shot],
    ) -> Result<(), SimulateError> {
        let motion = motion(shots.iter().map(|shot| self.gallery.sights[shot.sight].head));
        let recording = Recording { start: session.start(), motion: &motion, duration_s: image_time_s(shots.len()) };
        let random = |what| random(self.options.seed, what, session.number);
        let acceleration = recording.acceleration(random(Use::Acceleration));
        let range = recording.range(&mut random(Use::Range));
        for (sensor, prefix, packets) in [(Sensor::Acceleration, "ACC", acceleration), (Sensor::Range, "RNG", range)] {
            let (first, last) = packets.split_at(packets.len() / 2);
            for (number, packets, is_last) in [(1, first, false), (2, last, true)] {
                let file = SessionFile::Packets { sensor, is_last };
                files.write(file, &format!("{card}/SENSORS/{prefix}{number:04}.BIN"), packets.concat())?;
            }
        }
        Ok(())
    }

    fn write_shot(
        &self,
        files: &mut Files<'_>,
        session: &Session,
        at: usize,
        shot: &Shot,
        light: &mut ChaCha8Rng,
    ) -> Result<TruthRow, SimulateError> {
        let sight = &self.gallery.sights[shot.sight];
        let time_utc = session.start().plus_seconds(image_time_s(at));
        let stem = image_stem(time_utc)?;
        let image = format!("IMAGES/{stem}.JPG");
        let path = format!("cards/{}/{image}", session.name);
        let mut picture = self.noise.taken_anew(&sight.picture, light);
        if session.damage == Some(Damage::WrongSize) {
            picture = upper_half(picture);
        }
        files.write(SessionFile::Picture { at }, &path, picture.to_jpeg(&path)?)?;
        if shot.marked {
            let json = labelme_json(&format!("../../../{path}"), self.options.size_px, &sight.marks)?;
            files.write(SessionFile::Marks, &format!("marks/{RATER}/{}/{stem}.json", session.name), json)?;
        }
        Ok(self.truth(session, shot, &image, time_utc))
    }

    /// The truth of an image as it was taken, before any damage.
    fn truth(&self, session: &Session, shot: &Shot, image: &str, time_utc: UtcNs) -> TruthRow {
        let HeadPose { pitch_deg, roll_deg, range_mm } = self.gallery.sights[shot.sight].head;
        let TrueSizes { true_diameter_mm, true_width_mm, true_length_mm, true_height_mm } = self.object.true_sizes();
        TruthRow {
            participant: Some(session.participant.clone()),
            object: Some(self.object.name.to_owned()),
            kind: Some(self.object.kind),
            shape: Some(self.object.shape),
            true_diameter_mm,
            true_width_mm,
            true_length_mm,
            true_height_mm,
            turn_deg: Some(0.0),
            marked: shot.marked,
            ..TruthRow::of_image(&session.name, image, time_utc, [pitch_deg, roll_deg, range_mm])
        }
    }
}

/// A writer of a session's files, which damages them where the session is damaged.
struct Files<'a> {
    folder: &'a StudyFolder,
    damage: Option<Damage>,
    random: ChaCha8Rng,
}

impl Files<'_> {
    fn write(&mut self, file: SessionFile, path: &str, bytes: Vec<u8>) -> Result<(), SimulateError> {
        let left = match self.damage {
            Some(damage) => damage.apply(file, bytes, &mut self.random),
            None => Some(bytes),
        };
        left.map_or(Ok(()), |bytes| self.folder.write(path, &bytes))
    }
}

fn upper_half(mut picture: Picture) -> Picture {
    picture.height_px /= 2;
    picture.rgb.truncate(3 * picture.width_px as usize * picture.height_px as usize);
    picture
}
