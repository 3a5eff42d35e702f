//! The layout of a session's MCAP file: topics, messages, metadata records. Writer and reader share it.

mod calibration;
pub(crate) mod messages;
pub(crate) mod metadata;
mod writer;

use foxglove::messages::Timestamp;
use model::UtcNs;

pub use writer::WriteError;
pub use writer::is_partial;
pub(crate) use writer::{Keep, SessionWriter};

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

/// A message holds samples of less than this time. Readers look messages up by the time of their first sample, so a window of time in
/// the middle of a longer one would seem to be empty.
pub(crate) const LONGEST_MESSAGE_NS: u64 = 1_000_000_000;

/// Sensor messages gather to about this.
pub(crate) const SENSOR_CHUNK_BYTES: u64 = 1024 * 1024;

/// No chunk of ours is larger: one image, or sensor messages.
pub(crate) const LARGEST_CHUNK_BYTES: u64 = crate::card::LARGEST_IMAGE_BYTES + 2 * SENSOR_CHUNK_BYTES;

/// The key of a survey begins with this, so that a survey never passes for the file of its session.
pub(crate) const SURVEY: &str = "survey:";

/// A time as the messages have it; none after the year 2106, where their 32-bit seconds end. The MCAP's own time goes on to 2262.
pub(crate) fn timestamp(time: UtcNs) -> Option<Timestamp> {
    let seconds = u32::try_from(time.0.div_euclid(1_000_000_000)).ok()?;
    let ns = u32::try_from(time.0.rem_euclid(1_000_000_000)).ok()?;
    Timestamp::new_checked(seconds, ns)
}
