//! A recording with what was found in it: one self-contained MCAP file for Foxglove, Rerun and other viewers
//! (docs/viewers.md).

mod log;
mod numbers;
mod overlay;
mod scene;
mod topics;

use std::path::{Path, PathBuf};

use foxglove::messages::CompressedImage;
use model::{Camera, Feature, FrameRow, ResultRow, View};

pub use log::{LogLevel, LogNote};

use crate::mcap_file::messages::{AccelerationBlock, ExtraBlock, ImageFile, RangeBlock};
use crate::mcap_file::metadata::{ANNOTATED, annotated};
use crate::mcap_file::{Keep, SessionWriter, WriteError, timestamp, topic};
use crate::read::{RawMessage, ReadError, SessionReader};
use crate::summary::ImageEntry;
use numbers::{FrameNumbers, SizeNumbers};

/// The contents of an annotated recording.
#[derive(Debug, Clone, Copy)]
pub struct Annotating<'a> {
    /// The session's recording.
    pub recording: &'a Path,
    /// The file to be made.
    pub out: &'a Path,
    /// The key of everything that the notes are made from; [`annotated_key`] reads it back.
    pub key: &'a str,
    /// Camera of the pictures, as sizes are measured.
    pub camera: &'a Camera,
    /// Who marked, sorted: each has a colour.
    pub raters: &'a [String],
    /// The notes on the session besides its images.
    pub log: &'a [LogNote],
}

/// The notes on one image.
#[derive(Debug, Clone, PartialEq)]
pub struct ImageNotes<'a> {
    /// Its row of the ledger.
    pub frame: &'a FrameRow,
    /// The view that sizes were measured by; none without a pose.
    pub view: Option<View>,
    /// The marks in it.
    pub marks: Vec<MarkNote>,
    /// Its sizes, one of each quantity.
    pub sizes: Vec<&'a ResultRow>,
    /// The picture with marks and sizes drawn on it, as a JPEG file, for viewers that do not draw them.
    pub drawn_jpeg: Option<Vec<u8>>,
}

/// A line or curve in a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct MarkNote {
    /// Name of the object.
    pub object: String,
    /// Who marked.
    pub rater: String,
    /// The feature of the object that it shows.
    pub feature: Feature,
    /// Whether the last point joins the first.
    pub closed: bool,
    /// Its points, in pixels of the recorded picture.
    pub points_px: Vec<[f64; 2]>,
    /// Height above the table of the plane that it lies on, in mm; none where it lies on no level plane.
    pub plane_z_mm: Option<f64>,
}

/// Why there is no annotated recording.
#[derive(Debug, thiserror::Error)]
pub enum AnnotateError {
    /// The recording.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The new file.
    #[error("cannot write the annotated recording: {source}: {}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Why.
        source: WriteError,
    },
    /// The caller asked to stop.
    #[error("stopped")]
    Stopped,
}

/// The key that an annotated recording was made with; none where there is no such file, or it is not whole.
#[must_use]
pub fn annotated_key(path: &Path) -> Option<String> {
    let records = SessionReader::open(path).ok()?.records().ok()?;
    records.get(ANNOTATED)?.get("key").cloned()
}

/// Writes the file: all messages of the recording, and beside each image what `notes` gives of it, from its bytes. None ends the
/// work. Memory is bounded by a chunk of samples, and an image with its notes.
///
/// # Errors
/// [`AnnotateError`]; a file that was there stays.
pub fn annotate_session<'n>(
    what: &Annotating<'_>,
    mut notes: impl FnMut(&ImageEntry, &[u8]) -> Option<ImageNotes<'n>>,
) -> Result<(), AnnotateError> {
    let mut reader = SessionReader::open(what.recording)?;
    let images = reader.images()?;
    let refuse = |source| AnnotateError::Write { path: what.out.to_owned(), source };
    let mut file = Annotated { writer: SessionWriter::create(what.out, Keep::Images).map_err(refuse)?, what };
    for chunk in reader.sensor_chunks() {
        let messages = reader.raw_messages(&chunk)?;
        file.samples(&messages).map_err(refuse)?;
    }
    // Each after the messages of an earlier time, as far as images give one.
    let mut log = what.log.iter().peekable();
    for image in &images {
        let message = reader.raw_image(image)?.upright(what.recording)?;
        let jpeg = message.image(what.recording)?;
        let noted = notes(image, &jpeg).ok_or(AnnotateError::Stopped)?;
        file.begin_image().map_err(refuse)?;
        while let Some(note) = log.next_if(|note| note.time <= image.time) {
            file.log(note).map_err(refuse)?;
        }
        file.image(image, &message, noted).map_err(refuse)?;
    }
    file.begin_image().map_err(refuse)?;
    log.try_for_each(|note| file.log(note)).map_err(refuse)?;
    for message in reader.raw_list()? {
        file.writer.copy::<ImageFile>(topic::FILE, message.sequence, message.time, &message.data).map_err(refuse)?;
    }
    let records = annotated(reader.records()?, what.key);
    file.writer.finish(records).map_err(refuse)
}

/// The file while it is written.
struct Annotated<'a> {
    writer: SessionWriter,
    what: &'a Annotating<'a>,
}

impl Annotated<'_> {
    /// Messages of sensors, in a chunk of their own.
    fn samples(&mut self, messages: &[RawMessage]) -> Result<(), WriteError> {
        for RawMessage { topic, sequence, time, data } in messages {
            match topic.as_str() {
                topic::ACCELERATION => self.writer.copy::<AccelerationBlock>(topic, *sequence, *time, data)?,
                topic::RANGE => self.writer.copy::<RangeBlock>(topic, *sequence, *time, data)?,
                other if other.starts_with(topic::EXTRA) => {
                    self.writer.copy::<ExtraBlock>(topic, *sequence, *time, data)?;
                }
                _ => {}
            }
        }
        self.writer.end_of_sensor()
    }

    /// An image and all that belongs to it lie in one chunk, and are read together.
    fn begin_image(&mut self) -> Result<(), WriteError> {
        self.writer.end_of_sensor()
    }

    fn image(&mut self, image: &ImageEntry, message: &RawMessage, notes: ImageNotes<'_>) -> Result<(), WriteError> {
        let time = image.time;
        self.writer.copy::<CompressedImage>(topic::IMAGE, message.sequence, time, &message.data)?;
        self.writer.calibration(self.what.camera, time)?;
        self.writer.note(topics::FRAME, time, &FrameNumbers::from_frame(notes.frame))?;
        self.log(&log::of_frame(image, notes.frame))?;
        for row in &notes.sizes {
            self.writer.note(&topics::of_size(row), time, &SizeNumbers::from_row(row))?;
        }
        let overlay = overlay::annotations(&notes, self.what, time);
        self.writer.note(topics::OVERLAY, time, &overlay)?;
        if let Some(view) = &notes.view {
            self.writer.note(topics::TRANSFORM, time, &scene::transform(view, time))?;
            self.writer.note(topics::SCENE, time, &scene::update(view, &notes, self.what.raters, time))?;
        }
        if let Some(jpeg) = notes.drawn_jpeg {
            let picture = CompressedImage {
                timestamp: timestamp(time),
                frame_id: DRAWN_FRAME.to_owned(),
                data: jpeg.into(),
                format: "jpeg".to_owned(),
            };
            self.writer.note(topics::DRAWN, time, &picture)?;
        }
        Ok(())
    }

    fn log(&mut self, note: &LogNote) -> Result<(), WriteError> {
        self.writer.note(topics::LOG, note.time, &note.message())
    }
}

/// Pictures with marks drawn on them have another size, which no calibration describes.
const DRAWN_FRAME: &str = "drawn";

/// Colours that differ also for those who see few (Okabe and Ito 2008), without black, which pictures have themselves.
const COLOURS: [[f64; 3]; 7] = [
    [0.0, 0.62, 0.45],
    [0.9, 0.62, 0.0],
    [0.34, 0.71, 0.91],
    [0.8, 0.47, 0.65],
    [0.94, 0.89, 0.26],
    [0.84, 0.37, 0.0],
    [0.0, 0.45, 0.7],
];

fn colour(raters: &[String], rater: &str) -> foxglove::messages::Color {
    let place = raters.iter().position(|one| one == rater).unwrap_or_default();
    let [r, g, b] = COLOURS[place % COLOURS.len()];
    foxglove::messages::Color { r, g, b, a: 1.0 }
}

/// `plate: diameter 230.1 ± 1.2 mm`, with all sizes of one object by one rater, who is named where there are others.
fn label(notes: &ImageNotes<'_>, object: &str, rater: &str) -> String {
    let is_alone = notes.marks.iter().filter(|mark| mark.object == object).all(|mark| mark.rater == rater);
    let name = if is_alone { object.to_owned() } else { format!("{object} ({rater})") };
    let of_object = notes.sizes.iter().filter(|row| row.object == object && row.rater == rater);
    let sizes: Vec<String> = of_object.filter_map(|row| size_text(row)).collect();
    if sizes.is_empty() { name } else { format!("{name}: {}", sizes.join(", ")) }
}

fn size_text(row: &ResultRow) -> Option<String> {
    let sigma = row.sigma_mm.map(|mm| format!(" ± {mm:.1}")).unwrap_or_default();
    Some(format!("{} {:.1}{sigma} mm", row.quantity, row.predicted_mm?))
}
