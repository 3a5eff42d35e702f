//! The packets that an accelerometer and a range sensor on a moving head store on the card.

mod accelerometer;
mod motion;
mod packets;
mod range;
mod recording;

pub use accelerometer::Accelerometer;
pub(crate) use accelerometer::up_in_device;
pub use motion::{HeadPose, Motion};
pub use packets::{PACKET_PERIOD_S, SAMPLES_PER_PACKET, encode_packet, packet_sample_times_s};
pub use range::RangeSensor;
pub use recording::Recording;
pub(crate) use recording::posix_s;

/// Number of samples per second in the records of both sensors.
pub const SAMPLE_RATE_HZ: f64 = 128.0;

/// The mount offset: how much further down the camera looks than the accelerometer's forward axis (`mount_pitch_deg` of the
/// profile aim2-packets).
pub const MOUNT_PITCH_DEG: f64 = 21.0;
