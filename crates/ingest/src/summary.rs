//! The outcome of the ingest of one session.

use model::{FrameReason, Orientation, Problem, UtcNs};
use serde::{Deserialize, Serialize};

/// An image in the MCAP file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ImageEntry {
    /// Path relative to the card, with `/`.
    pub file: String,
    /// The time at which it was taken.
    pub time: UtcNs,
    /// Size of the file.
    pub bytes: u64,
    /// Width.
    pub width_px: u32,
    /// Height.
    pub height_px: u32,
    /// How EXIF tells viewers to turn it. All sizes and pixels of this program are those of the stored picture.
    pub orientation: Orientation,
}

/// An image of the card that is not in the MCAP file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct DroppedImage {
    /// Path relative to the card, with `/`.
    pub file: String,
    /// Size of the file.
    pub bytes: u64,
    /// Width, where the header could be read.
    pub width_px: Option<u32>,
    /// Height, where the header could be read.
    pub height_px: Option<u32>,
    /// Why: [`FrameReason::EmptyImage`], [`FrameReason::NotAnImage`], [`FrameReason::DamagedImage`],
    /// [`FrameReason::WrongSize`], [`FrameReason::NoTime`] or [`FrameReason::TimesDisagree`].
    pub reason: FrameReason,
    /// The facts behind the reason: expected and got.
    pub detail: String,
    /// The time at which it was taken, where that is known.
    pub time: Option<UtcNs>,
}

/// How much of what is in the MCAP file.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counts {
    /// Acceleration samples.
    pub acceleration: u64,
    /// Range samples.
    pub range: u64,
    /// Images.
    pub images: u64,
    /// Images of the card that could not be used.
    pub dropped_images: u64,
}

/// The outcome of the ingest of one session.
#[derive(Debug, Clone, PartialEq)]
pub struct IngestSummary {
    /// Name of the session.
    pub session: String,
    /// Key of what went in; see [`inputs_key`](crate::inputs_key).
    pub key: String,
    /// Input files read.
    pub files: usize,
    /// Bytes in them.
    pub bytes: u64,
    /// Images in the MCAP file.
    pub images: u64,
    /// All counts.
    pub counts: Counts,
    /// Images that could not be used, sorted by file.
    pub dropped_images: Vec<DroppedImage>,
    /// The problems of the card.
    pub problems: Vec<Problem>,
}
