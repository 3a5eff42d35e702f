//! The motion of a head -> what an accelerometer and a range sensor store on the card.

mod accelerometer;
mod motion;
mod packets;
mod range;

pub use accelerometer::Accelerometer;
pub use motion::{HeadPose, Motion};
pub use packets::{PACKET_PERIOD_S, SAMPLES_PER_PACKET, encode_packet, packet_sample_times_s};
pub use range::RangeSensor;

/// Samples per second of both sensors' records.
pub const SAMPLE_RATE_HZ: f64 = 128.0;
