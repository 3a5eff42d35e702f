//! One image of a card: taken, or dropped with a reason.

use std::io::Read;
use std::path::Path;

use jiff::tz::TimeZone;
use model::{CameraSpec, FrameReason, UtcNs};

use super::{CardFile, Inputs, open_hashing};
use crate::parse::image_header::{self, Encoding};
use crate::parse::image_time::{self, TimeError};
use crate::profile::ImageTime;
use crate::progress::IngestProgress;
use crate::summary::{DroppedImage, ImageEntry};

/// An image is held in memory; a camera that a head carries writes a few MB.
pub(crate) const LARGEST_IMAGE_BYTES: u64 = 64 * 1024 * 1024;

/// An image that can be used, with its bytes.
pub(crate) struct TakenImage {
    pub entry: ImageEntry,
    pub encoding: Encoding,
    pub bytes: Vec<u8>,
}

/// Reads one image, and hashes it to its end whatever it is.
pub(crate) fn read_image(
    file: &CardFile,
    time: &ImageTime,
    zone: &TimeZone,
    camera: &CameraSpec,
    inputs: &mut Inputs,
    progress: &dyn IngestProgress,
) -> Result<TakenImage, DroppedImage> {
    let dropped = |reason, detail: String| Err(without_header(file, reason, detail));
    let mut reader = match open_hashing(file, progress) {
        Ok(reader) => reader,
        Err(error) => {
            inputs.add_unreadable(file);
            return dropped(FrameReason::NotAnImage, format!("cannot be read: {error}"));
        }
    };
    let mut bytes = Vec::with_capacity(usize::try_from(file.bytes.min(LARGEST_IMAGE_BYTES)).unwrap_or(0));
    let read = reader.by_ref().take(LARGEST_IMAGE_BYTES + 1).read_to_end(&mut bytes);
    if let Err(error) = inputs.add(file, reader).and(read.map(|_| ())) {
        return dropped(FrameReason::NotAnImage, format!("cannot be read: {error}"));
    }
    if bytes.len() as u64 > LARGEST_IMAGE_BYTES {
        return dropped(FrameReason::NotAnImage, format!("larger than {LARGEST_IMAGE_BYTES} bytes"));
    }
    judge(file, bytes, time, zone, camera)
}

/// The first reason that applies, in the order of [`FrameReason`].
fn judge(
    file: &CardFile,
    bytes: Vec<u8>,
    time: &ImageTime,
    zone: &TimeZone,
    camera: &CameraSpec,
) -> Result<TakenImage, DroppedImage> {
    let known_time = time_of(file, &bytes, time, zone);
    if bytes.is_empty() {
        let dropped = without_header(file, FrameReason::EmptyImage, "0 bytes".to_owned());
        return Err(DroppedImage { time: known_time.ok(), ..dropped });
    }
    let header = match image_header::read(&bytes) {
        Ok(header) => header,
        Err(error) => {
            let dropped = without_header(file, FrameReason::NotAnImage, error.to_string());
            return Err(DroppedImage { time: known_time.ok(), ..dropped });
        }
    };
    let (width_px, height_px) = (header.width_px, header.height_px);
    let dropped = |reason, detail, time| DroppedImage {
        width_px: Some(width_px),
        height_px: Some(height_px),
        time,
        ..without_header(file, reason, detail)
    };
    if (width_px, height_px) != (camera.width_px, camera.height_px) {
        let expected = format!("camera '{}' takes {} x {} px", camera.name, camera.width_px, camera.height_px);
        let detail = format!("{expected}, this one is {width_px} x {height_px} px");
        return Err(dropped(FrameReason::WrongSize, detail, known_time.ok()));
    }
    let time = known_time.map_err(|error| dropped(FrameReason::NoTime, error.to_string(), None))?;
    let entry = ImageEntry { file: file.name.clone(), time, bytes: bytes.len() as u64, width_px, height_px };
    Ok(TakenImage { entry, encoding: header.encoding, bytes })
}

fn time_of(file: &CardFile, bytes: &[u8], time: &ImageTime, zone: &TimeZone) -> Result<UtcNs, TimeError> {
    match time {
        ImageTime::Name { pattern } => {
            let name = Path::new(&file.name).file_name().and_then(|name| name.to_str()).unwrap_or_default();
            image_time::from_name(name, pattern, zone)
        }
        ImageTime::Exif {} => image_time::from_exif(bytes, zone),
    }
}

fn without_header(file: &CardFile, reason: FrameReason, detail: String) -> DroppedImage {
    DroppedImage {
        file: file.name.clone(),
        bytes: file.bytes,
        width_px: None,
        height_px: None,
        reason,
        detail,
        time: None,
    }
}
