//! One image of a card: taken, or dropped with a reason.

use std::io::Read;
use std::path::Path;

use jiff::tz::TimeZone;
use model::{CameraSpec, FrameReason, UtcNs};

use super::{CardFile, Inputs, open_hashing, size};
use crate::parse::image_extent::{self, ImageExtent};
use crate::parse::image_header::{self, Encoding};
use crate::parse::image_orientation::orientation_of;
use crate::parse::image_time::{self, TimeError};
use crate::profile::ImageTime;
use crate::progress::IngestProgress;
use crate::summary::{DroppedImage, ImageEntry};

/// An image is held in memory; a camera that a head carries writes a few MB.
pub(crate) const LARGEST_IMAGE_BYTES: u64 = 64 * 1024 * 1024;

/// An image that can be used, with the bytes of its file, unchanged.
pub(crate) struct TakenImage {
    pub entry: ImageEntry,
    pub encoding: Encoding,
    pub bytes: Vec<u8>,
    pub remarks: Remarks,
}

/// The oddities of an image that can be used.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Remarks {
    /// Bytes behind the picture's end marker that belong to no picture.
    pub bytes_after: u64,
    /// Stray bytes between the segments of the picture, which decoders pass over.
    pub stray_bytes: u64,
    /// The extension is that of another encoding.
    pub has_wrong_extension: bool,
    /// Name and EXIF should both give the time, and only one does.
    pub has_one_time: bool,
}

/// The text in place of a hash for an image that is too large: nobody waits for 10 GB that cannot be a picture.
pub(crate) fn too_large(file: &CardFile) -> Option<String> {
    (file.bytes > LARGEST_IMAGE_BYTES).then(|| format!("too_large:{}", file.bytes))
}

/// The bytes of one image, hashed to the file's end whatever it is, unless it is too large.
pub(crate) fn read_image(
    file: &CardFile,
    inputs: &mut Inputs,
    progress: &dyn IngestProgress,
) -> Result<Vec<u8>, DroppedImage> {
    let dropped = |detail: String| Err(without_header(file, FrameReason::NotAnImage, detail));
    if let Some(reason) = too_large(file) {
        progress.advance(file.bytes);
        inputs.add_refused(file, reason);
        return dropped(format!("{} is larger than the largest picture, 64 MiB; it is not read", size(file.bytes)));
    }
    let mut reader = match open_hashing(file, progress) {
        Ok(reader) => reader,
        Err(error) => {
            inputs.add_unreadable(file);
            return dropped(format!("cannot be read: {error}"));
        }
    };
    let mut bytes = Vec::with_capacity(usize::try_from(file.bytes).unwrap_or(0));
    let read = reader.by_ref().take(LARGEST_IMAGE_BYTES + 1).read_to_end(&mut bytes);
    if let Err(error) = inputs.add(file, reader).and(read.map(|_| ())) {
        return dropped(format!("cannot be read: {error}"));
    }
    if bytes.len() as u64 > LARGEST_IMAGE_BYTES {
        return dropped(format!("larger than {LARGEST_IMAGE_BYTES} bytes"));
    }
    Ok(bytes)
}

/// Takes an image, or drops it for the first reason that applies, in the order of [`FrameReason`].
pub(crate) fn judge_image(
    file: &CardFile,
    bytes: Vec<u8>,
    time: &ImageTime,
    zone: &TimeZone,
    camera: &CameraSpec,
) -> Result<TakenImage, DroppedImage> {
    let known = time_of(file, &bytes, time, zone);
    let time = known.as_ref().ok().map(|(time, _)| *time);
    if bytes.is_empty() {
        let dropped = without_header(file, FrameReason::EmptyImage, "0 bytes".to_owned());
        return Err(DroppedImage { time, ..dropped });
    }
    let header = image_header::read(&bytes).map_err(|error| {
        let dropped = without_header(file, FrameReason::NotAnImage, error.to_string());
        DroppedImage { time, ..dropped }
    })?;
    let (width_px, height_px, encoding) = (header.width_px, header.height_px, header.encoding);
    let dropped = |reason, detail| DroppedImage {
        width_px: Some(width_px),
        height_px: Some(height_px),
        time,
        ..without_header(file, reason, detail)
    };
    let extent = image_extent::extent(encoding, &bytes);
    let extent = extent.map_err(|damage| dropped(FrameReason::DamagedImage, damage.to_string()))?;
    if (width_px, height_px) != (camera.width_px, camera.height_px) {
        let expected = format!("camera '{}' takes {} x {} px", camera.name, camera.width_px, camera.height_px);
        let detail = format!("{expected}, this one is {width_px} x {height_px} px");
        return Err(dropped(FrameReason::WrongSize, detail));
    }
    let (time, has_one_time) = known.map_err(|error| dropped(reason_of(&error), error.to_string()))?;
    let orientation = orientation_of(&bytes);
    let entry =
        ImageEntry { file: file.name.clone(), time, bytes: bytes.len() as u64, width_px, height_px, orientation };
    let has_wrong_extension = has_wrong_extension(&file.name, encoding);
    let remarks = Remarks {
        bytes_after: bytes_after(extent, &bytes),
        stray_bytes: extent.stray_bytes as u64,
        has_wrong_extension,
        has_one_time,
    };
    Ok(TakenImage { entry, encoding, bytes, remarks })
}

/// The time, and whether only one of two sources gave it.
fn time_of(file: &CardFile, bytes: &[u8], time: &ImageTime, zone: &TimeZone) -> Result<(UtcNs, bool), TimeError> {
    let name = Path::new(&file.name).file_name().and_then(|name| name.to_str()).unwrap_or_default();
    match time {
        ImageTime::Name { pattern } => image_time::from_name(name, pattern, zone).map(|time| (time, false)),
        ImageTime::Exif {} => image_time::from_exif(bytes, zone).map(|time| (time, false)),
        ImageTime::Both { pattern, tolerance_s } => {
            let from_name = image_time::from_name(name, pattern, zone);
            image_time::from_both(from_name, image_time::from_exif(bytes, zone), *tolerance_s)
        }
    }
}

fn reason_of(error: &TimeError) -> FrameReason {
    match error {
        TimeError::Disagree { .. } => FrameReason::TimesDisagree,
        _ => FrameReason::NoTime,
    }
}

fn bytes_after(extent: ImageExtent, bytes: &[u8]) -> u64 {
    if extent.has_more_pictures { 0 } else { bytes.len().saturating_sub(extent.bytes) as u64 }
}

/// Whether the extension names the other encoding; one that names none is not wrong.
fn has_wrong_extension(name: &str, encoding: Encoding) -> bool {
    let extension = Path::new(name).extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    match extension.to_ascii_lowercase().as_str() {
        "png" => encoding == Encoding::Jpeg,
        "jpg" | "jpeg" => encoding == Encoding::Png,
        _ => false,
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
