//! What the MCAP file of a session holds: topics, messages, metadata records. Writer and reader share it.

mod calibration;
pub(crate) mod messages;
pub(crate) mod metadata;
mod writer;

pub use writer::WriteError;
pub use writer::is_partial;
pub(crate) use writer::{Keep, SessionWriter, timestamp};

/// Topics.
pub(crate) mod topic {
    /// Channels that are carried along: this and their name.
    pub const EXTRA: &str = "/extra/";
    pub const ACCELERATION: &str = "/imu/acceleration";
    pub const RANGE: &str = "/range";
    pub const IMAGE: &str = "/camera/image";
    pub const CALIBRATION: &str = "/camera/calibration";
    pub const FILE: &str = "/camera/file";
}

/// The frame that images and calibration refer to: x right, y down, z forward.
pub(crate) const CAMERA_FRAME: &str = "camera";

/// Sensor messages gather to about this.
pub(crate) const SENSOR_CHUNK_BYTES: u64 = 1024 * 1024;

/// No chunk of ours is larger: one image, or sensor messages.
pub(crate) const LARGEST_CHUNK_BYTES: u64 = crate::card::LARGEST_IMAGE_BYTES + 2 * SENSOR_CHUNK_BYTES;
