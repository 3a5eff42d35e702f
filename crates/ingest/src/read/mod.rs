//! Reads the MCAP file of a session, one chunk at a time.

mod chunk;
mod error;
mod raw;
mod records;
mod samples;
mod summary;

pub use error::ReadError;
pub(crate) use raw::RawMessage;

use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};

use model::{CameraSpec, Orientation, Problem, UtcNs};

use crate::mcap_file::messages::ImageFile;
use crate::mcap_file::metadata::{Facts, SEAL};
use crate::mcap_file::{SURVEY, topic};
use crate::profile::Profile;
use crate::sample::Sample;
use crate::summary::{Counts, DroppedImage, ImageEntry};
use crate::timeline::Timeline;
use error::Damage;
use summary::Index;

/// The metadata of a session's MCAP file.
#[derive(Debug, Clone, PartialEq)]
pub struct SessionMetadata {
    /// Name of the session.
    pub session: String,
    /// Program and version that wrote the file.
    pub program: String,
    /// Version of the ingest that wrote the file.
    pub ingest_version: u32,
    /// Key of what went in; see [`inputs_key`](crate::inputs_key).
    pub key: String,
    /// Time zone in which times without one were read.
    pub time_zone: String,
    /// Device profile, resolved.
    pub profile: Profile,
    /// Camera pitch minus sensor pitch as the profile declares it, degrees.
    pub mount_pitch_deg: f64,
    /// Camera as it was when the card was ingested.
    pub camera: CameraSpec,
    /// SHA-256 of every input file, by its path relative to the card; `unreadable` where it could not be read.
    pub inputs_sha256: BTreeMap<String, String>,
    /// Samples and images in the file.
    pub counts: Counts,
    /// The account of the clocks.
    pub timeline: Timeline,
    /// Images of the card that could not be used, sorted by file.
    pub dropped_images: Vec<DroppedImage>,
    /// The problems of the card.
    pub problems: Vec<Problem>,
}

impl SessionMetadata {
    /// Whether the file is a survey: it lists the images and has none of them.
    #[must_use]
    pub fn is_survey(&self) -> bool {
        self.key.starts_with(SURVEY)
    }
}

/// Reads the MCAP file of a session. Memory is bounded by the chunks that overlap in time, and one image.
#[derive(Debug)]
pub struct SessionReader {
    path: PathBuf,
    file: File,
    index: Index,
    metadata: SessionMetadata,
    /// The list of images, once it has been read: entry and sequence number.
    images: Option<Vec<(ImageEntry, u32)>>,
}

impl SessionReader {
    /// Opens a file and reads its index and metadata.
    ///
    /// # Errors
    /// [`ReadError`] when the file cannot be read, is damaged, or is not of this program.
    pub fn open(path: &Path) -> Result<Self, ReadError> {
        let file = File::open(path).map_err(|error| ReadError::new(path, Damage::Io(error)))?;
        let (index, records) = Index::read(&file).map_err(|damage| ReadError::new(path, damage))?;
        if !records.contains_key(SEAL) {
            return Err(ReadError::new(path, Damage::NotOurs));
        }
        let facts = Facts::from_records(records).map_err(|error| ReadError::new(path, error.into()))?;
        let metadata = SessionMetadata {
            session: facts.session,
            program: facts.program,
            ingest_version: facts.ingest_version,
            key: facts.key,
            time_zone: facts.time_zone,
            mount_pitch_deg: facts.profile.mount_pitch_deg,
            profile: facts.profile,
            camera: facts.camera,
            inputs_sha256: facts.inputs_sha256,
            counts: facts.counts,
            timeline: facts.timeline,
            dropped_images: facts.dropped_images,
            problems: facts.problems,
        };
        Ok(Self { path: path.to_owned(), file, index, metadata, images: None })
    }

    /// The metadata of the file.
    #[must_use]
    pub fn metadata(&self) -> &SessionMetadata {
        &self.metadata
    }

    /// The images in order of time (of file where times are equal). No image is read.
    ///
    /// # Errors
    /// [`ReadError`] when the file is damaged.
    pub fn images(&mut self) -> Result<Vec<ImageEntry>, ReadError> {
        Ok(self.image_list()?.iter().map(|(entry, _)| entry.clone()).collect())
    }

    /// The bytes of an image as they were on the card. `file` as in [`ImageEntry::file`].
    ///
    /// # Errors
    /// [`ReadError`] when there is no such image, or the file is damaged.
    pub fn image_bytes(&mut self, file: &str) -> Result<Vec<u8>, ReadError> {
        let listed = self.image_list()?.iter().find(|(entry, _)| entry.file == file).map(|(entry, _)| entry.clone());
        match listed {
            Some(entry) => self.raw_image(&entry)?.image(&self.path),
            None => Err(ReadError::new(&self.path, Damage::NoImage(file.to_owned()))),
        }
    }

    /// Calls `each` with all samples: first the accelerometer's, then the range sensor's, each in order of time.
    ///
    /// # Errors
    /// [`ReadError`] when the file is damaged; `each` has then been called with the samples before the damage.
    pub fn for_each_sample(&mut self, mut each: impl FnMut(Sample)) -> Result<(), ReadError> {
        self.for_each_acceleration(|time, g| each(Sample::Acceleration { time, g: g.map(f64::from) }))?;
        self.for_each_range(|time, mm| each(Sample::Range { time, mm: f64::from(mm) }))
    }

    /// Calls `each` with time and specific force (g, device frame) of all samples of the accelerometer, in order of time.
    ///
    /// # Errors
    /// The errors of [`Self::for_each_sample`].
    pub fn for_each_acceleration(&mut self, each: impl FnMut(UtcNs, [f32; 3])) -> Result<(), ReadError> {
        let read = samples::for_each::<samples::Acceleration>(&self.file, &self.index, topic::ACCELERATION, each);
        read.map_err(|damage| ReadError::new(&self.path, damage))
    }

    /// Calls `each` with time and range (mm, codes included) of all samples of the range sensor, in order of time.
    ///
    /// # Errors
    /// The errors of [`Self::for_each_sample`].
    pub fn for_each_range(&mut self, each: impl FnMut(UtcNs, f32)) -> Result<(), ReadError> {
        let read = samples::for_each::<samples::Range>(&self.file, &self.index, topic::RANGE, each);
        read.map_err(|damage| ReadError::new(&self.path, damage))
    }

    /// Names of the channels that are carried along and not used.
    #[must_use]
    pub fn extra_channels(&self) -> Vec<String> {
        self.index.topics_with(topic::EXTRA)
    }

    /// Calls `each` with time and value (as the device counts it; NaN where missing) of all samples of a channel that is
    /// carried along, in order of time; never for a name that is not in [`Self::extra_channels`].
    ///
    /// # Errors
    /// The errors of [`Self::for_each_sample`].
    pub fn for_each_extra(&mut self, name: &str, each: impl FnMut(UtcNs, f32)) -> Result<(), ReadError> {
        let topic = format!("{}{name}", topic::EXTRA);
        let read = samples::for_each::<samples::Extra>(&self.file, &self.index, &topic, each);
        read.map_err(|damage| ReadError::new(&self.path, damage))
    }

    fn image_list(&mut self) -> Result<&[(ImageEntry, u32)], ReadError> {
        if self.images.is_none() {
            let images = self.read_image_list().map_err(|damage| ReadError::new(&self.path, damage))?;
            self.images = Some(images);
        }
        Ok(self.images.as_deref().unwrap_or_default())
    }

    fn read_image_list(&self) -> Result<Vec<(ImageEntry, u32)>, Damage> {
        let mut images = Vec::new();
        for chunk in self.index.chunks_of(&[topic::FILE]) {
            chunk::for_each_message(&self.file, chunk, |header, data| {
                if self.index.topic(header.channel_id) == Some(topic::FILE) {
                    let ImageFile { file, bytes, width_px, height_px, orientation } = prost::Message::decode(data)?;
                    let time = chunk::time_of(header)?;
                    let orientation = Orientation::from_exif(orientation).unwrap_or_default();
                    let entry = ImageEntry { file, time, bytes, width_px, height_px, orientation };
                    images.push((entry, header.sequence));
                }
                Ok(())
            })?;
        }
        images.sort_by(|(a, _), (b, _)| (a.time, &a.file).cmp(&(b.time, &b.file)));
        Ok(images)
    }
}

/// Whether `out` is an MCAP file with that key. False for anything that is not such a file.
#[must_use]
pub fn ingest_is_current(out: &Path, key: &str) -> bool {
    SessionReader::open(out).is_ok_and(|reader| reader.metadata().key == key)
}
