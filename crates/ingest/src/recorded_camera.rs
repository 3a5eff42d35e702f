//! How much of the camera a session's MCAP file holds.

use model::CameraSpec;
use serde::{Deserialize, Serialize};

/// The camera that a session was recorded with.
///
/// A run needs no more than the size of the pictures here: its MCAP files then stay good when the camera's calibration
/// changes, and sizes are measured anew without reading a card.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RecordedCamera {
    /// All of it: the file gets a `foxglove.CameraCalibration`, and is another file when the camera changes.
    Calibrated(CameraSpec),
    /// Size of its pictures.
    PictureSize {
        /// Width.
        width_px: u32,
        /// Height.
        height_px: u32,
    },
}

impl RecordedCamera {
    /// The same, no more than the size of the pictures.
    #[must_use]
    pub fn without_calibration(&self) -> Self {
        let (width_px, height_px) = self.size_px();
        Self::PictureSize { width_px, height_px }
    }

    /// Width and height of the pictures.
    #[must_use]
    pub fn size_px(&self) -> (u32, u32) {
        match self {
            Self::Calibrated(spec) => (spec.width_px, spec.height_px),
            Self::PictureSize { width_px, height_px } => (*width_px, *height_px),
        }
    }

    /// Its name, where more than the size is known.
    #[must_use]
    pub fn name(&self) -> Option<&str> {
        match self {
            Self::Calibrated(spec) => Some(&spec.name),
            Self::PictureSize { .. } => None,
        }
    }
}
