//! Writes the MCAP file of a session under a temporary name, then renames it.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use foxglove::messages::CompressedImage;
use mcap::records::{MessageHeader, Metadata};
use mcap::{McapError, WriteOptions, Writer};
use model::{Camera, UtcNs};
use tempfile::NamedTempFile;

use super::calibration::calibration;
use super::messages::{AccelerationBlock, ExtraBlock, ImageFile, RangeBlock};
use super::metadata::Records;
use super::{CAMERA_FRAME, LONGEST_MESSAGE_NS, SENSOR_CHUNK_BYTES, timestamp, topic};
use crate::parse::image_header::Encoding;
use crate::summary::ImageEntry;
use crate::timeline::{Block, Times};

/// Fixed, so that equal input gives equal bytes whatever the version of the library.
const LIBRARY: &str = "aim-batch-ingest";

const PARTIAL_PREFIX: &str = ".ingest-";
const PARTIAL_SUFFIX: &str = ".partial";

/// Whether a file of that name is one that ingest writes before it gives it its name. Where no ingest is at work, it was
/// left by one that was killed.
#[must_use]
pub fn is_partial(name: &OsStr) -> bool {
    name.to_str().is_some_and(|name| name.starts_with(PARTIAL_PREFIX) && name.ends_with(PARTIAL_SUFFIX))
}

/// Why the MCAP file cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// The system refuses.
    #[error(transparent)]
    Io(#[from] std::io::Error),
    /// The MCAP library refuses.
    #[error(transparent)]
    Mcap(McapError),
    /// A message has no schema: a defect of the program.
    #[error("the message type of {0} has no schema")]
    NoSchema(String),
}

impl From<McapError> for WriteError {
    /// The library's own words do not say what the system said.
    fn from(error: McapError) -> Self {
        match error {
            McapError::Io(error) => Self::Io(error),
            other => Self::Mcap(other),
        }
    }
}

/// Whether images are kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Keep {
    /// They are written: a session's own file.
    Images,
    /// They are only listed, and nothing is made durable: a survey, which is soon deleted.
    ListOfImages,
}

/// Sensor messages come first, each sensor in chunks of its own, then one chunk per image, then the list of images: a pass
/// over a sensor reads nothing else.
pub(crate) struct SessionWriter {
    mcap: Writer<BufWriter<NamedTempFile>>,
    channels: BTreeMap<String, u16>,
    out: PathBuf,
    encoded: Vec<u8>,
    first_time: Option<UtcNs>,
    last_time: Option<UtcNs>,
    keep: Keep,
    sequences: BTreeMap<u16, u32>,
}

impl SessionWriter {
    pub fn create(out: &Path, keep: Keep) -> Result<Self, WriteError> {
        let folder = out.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        std::fs::create_dir_all(folder)?;
        let mut builder = tempfile::Builder::new();
        builder.prefix(PARTIAL_PREFIX).suffix(PARTIAL_SUFFIX);
        #[cfg(unix)]
        {
            // A temporary file is its owner's alone; the MCAP file has the permissions of any new file.
            use std::os::unix::fs::PermissionsExt;
            builder.permissions(std::fs::Permissions::from_mode(0o666));
        }
        let file = BufWriter::with_capacity(256 * 1024, builder.tempfile_in(folder)?);
        // JPEG does not shrink, and is most of a session; chunks have checksums, so the whole needs none.
        let options = WriteOptions::new()
            .compression(None)
            .chunk_size(Some(SENSOR_CHUNK_BYTES))
            .calculate_data_section_crc(false)
            .library(LIBRARY);
        Ok(Self {
            mcap: options.create(file)?,
            channels: BTreeMap::new(),
            out: out.to_owned(),
            encoded: Vec::new(),
            first_time: None,
            last_time: None,
            keep,
            sequences: BTreeMap::new(),
        })
    }

    /// Time of the earliest message so far.
    pub fn first_time(&self) -> Option<UtcNs> {
        self.first_time
    }

    /// Writes samples of the accelerometer.
    pub fn acceleration(&mut self, block: Block, extra: &[String]) -> Result<(), WriteError> {
        self.keep_in_order(&block.times)?;
        for Block { times, channels, extra: columns, .. } in block.parts(LONGEST_MESSAGE_NS) {
            let (time, (step_ns, offset_ns)) = (times.first(), wire_times(&times));
            self.carry(time, (step_ns, &offset_ns), columns, extra)?;
            let Ok([x_g, y_g, z_g]) = <[Vec<f32>; 3]>::try_from(channels) else { continue };
            self.write(topic::ACCELERATION, time, &AccelerationBlock { step_ns, offset_ns, x_g, y_g, z_g })?;
        }
        Ok(())
    }

    /// Writes samples of the range sensor.
    pub fn range(&mut self, block: Block, extra: &[String]) -> Result<(), WriteError> {
        self.keep_in_order(&block.times)?;
        for Block { times, channels, extra: columns, .. } in block.parts(LONGEST_MESSAGE_NS) {
            let (time, (step_ns, offset_ns)) = (times.first(), wire_times(&times));
            self.carry(time, (step_ns, &offset_ns), columns, extra)?;
            let Ok([range_mm]) = <[Vec<f32>; 1]>::try_from(channels) else { continue };
            self.write(topic::RANGE, time, &RangeBlock { step_ns, offset_ns, range_mm })?;
        }
        Ok(())
    }

    /// The samples of a sensor are at their end.
    pub fn end_of_sensor(&mut self) -> Result<(), WriteError> {
        self.last_time = None;
        Ok(self.mcap.flush()?)
    }

    fn carry(
        &mut self,
        time: UtcNs,
        (step_ns, offset_ns): (f64, &[u64]),
        columns: Vec<Vec<f32>>,
        names: &[String],
    ) -> Result<(), WriteError> {
        for (value, name) in columns.into_iter().zip(names) {
            let message = ExtraBlock { step_ns, offset_ns: offset_ns.to_vec(), value };
            self.write(&format!("{}{name}", topic::EXTRA), time, &message)?;
        }
        Ok(())
    }

    /// Closes the chunk where time goes back.
    fn keep_in_order(&mut self, times: &Times) -> Result<(), WriteError> {
        if self.last_time.is_some_and(|last| times.first() < last) {
            self.mcap.flush()?;
        }
        self.last_time = Some(times.last());
        Ok(())
    }

    /// Writes an image into a chunk of its own.
    pub fn image(&mut self, time: UtcNs, encoding: Encoding, bytes: Vec<u8>) -> Result<(), WriteError> {
        if self.keep == Keep::ListOfImages {
            return Ok(());
        }
        self.mcap.flush()?;
        let message = CompressedImage {
            timestamp: timestamp(time),
            frame_id: CAMERA_FRAME.to_owned(),
            data: bytes.into(),
            format: encoding.name().to_owned(),
        };
        self.write(topic::IMAGE, time, &message).map(|_| ())
    }

    /// Writes the list of images, in the order of their sequence numbers from 0.
    pub fn image_list(&mut self, entries: &[ImageEntry]) -> Result<(), WriteError> {
        self.mcap.flush()?;
        for entry in entries {
            let message = ImageFile {
                file: entry.file.clone(),
                bytes: entry.bytes,
                width_px: entry.width_px,
                height_px: entry.height_px,
                orientation: entry.orientation.exif(),
            };
            self.write(topic::FILE, entry.time, &message)?;
        }
        Ok(())
    }

    pub fn calibration(&mut self, camera: &Camera, time: UtcNs) -> Result<(), WriteError> {
        self.write(topic::CALIBRATION, time, &calibration(camera, time)).map(|_| ())
    }

    /// Writes the metadata, makes the file durable and gives it its name.
    pub fn finish(mut self, records: Records) -> Result<(), WriteError> {
        for (name, metadata) in records {
            self.mcap.write_metadata(&Metadata { name, metadata })?;
        }
        self.mcap.finish()?;
        let file = self.mcap.into_inner().into_inner().map_err(std::io::IntoInnerError::into_error)?;
        if self.keep == Keep::ListOfImages {
            file.persist(&self.out).map_err(|error| error.error)?;
            return Ok(());
        }
        file.as_file().sync_all()?;
        file.persist(&self.out).map_err(|error| error.error)?;
        #[cfg(unix)]
        if let Some(folder) = self.out.parent().filter(|folder| !folder.as_os_str().is_empty()) {
            std::fs::File::open(folder)?.sync_all()?; // the rename itself
        }
        Ok(())
    }

    /// Writes a message that says something of a recording.
    pub fn note<M: prost::Message + foxglove::Encode>(
        &mut self,
        topic: &str,
        time: UtcNs,
        message: &M,
    ) -> Result<(), WriteError> {
        self.write(topic, time, message).map(|_| ())
    }

    /// Writes a message of type `M` as another file has it, under the number that it has there.
    pub fn copy<M: foxglove::Encode>(
        &mut self,
        topic: &str,
        sequence: u32,
        time: UtcNs,
        data: &[u8],
    ) -> Result<(), WriteError> {
        let channel_id = self.channel::<M>(topic)?;
        let log_time = time.0.max(0).unsigned_abs();
        let header = MessageHeader { channel_id, sequence, log_time, publish_time: log_time };
        self.first_time = Some(self.first_time.map_or(time, |first| first.min(time)));
        Ok(self.mcap.write_to_known_channel(&header, data)?)
    }

    fn write<M: prost::Message + foxglove::Encode>(
        &mut self,
        topic: &str,
        time: UtcNs,
        message: &M,
    ) -> Result<u32, WriteError> {
        let channel_id = self.channel::<M>(topic)?;
        let sequence = self.sequences.entry(channel_id).or_default();
        let log_time = time.0.max(0).unsigned_abs(); // ingest refuses times before 1970
        let header = MessageHeader { channel_id, sequence: *sequence, log_time, publish_time: log_time };
        *sequence = sequence.wrapping_add(1);
        self.encoded.clear();
        message.encode_raw(&mut self.encoded);
        self.mcap.write_to_known_channel(&header, &self.encoded)?;
        self.first_time = Some(self.first_time.map_or(time, |first| first.min(time)));
        Ok(header.sequence)
    }

    fn channel<M: foxglove::Encode>(&mut self, topic: &str) -> Result<u16, WriteError> {
        if let Some(id) = self.channels.get(topic) {
            return Ok(*id);
        }
        let schema = M::get_schema().ok_or(WriteError::NoSchema(topic.to_owned()))?;
        let schema_id = self.mcap.add_schema(&schema.name, &schema.encoding, &schema.data)?;
        let id = self.mcap.add_channel(schema_id, topic, &M::get_message_encoding(), &BTreeMap::new())?;
        self.channels.insert(topic.to_owned(), id);
        Ok(id)
    }
}

/// Times as sensor messages have them: a step, or an offset from the first for each.
fn wire_times(times: &Times) -> (f64, Vec<u64>) {
    match times {
        Times::Even { step_ns, .. } => (*step_ns, Vec::new()),
        Times::Each(times) => {
            let first = times.first().map_or(0, |first| first.0);
            (0.0, times.iter().map(|time| time.0.abs_diff(first)).collect())
        }
    }
}
