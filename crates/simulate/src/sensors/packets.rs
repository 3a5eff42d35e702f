//! Packets of the profile `aim2-packets`: a stamp, then 1022 samples of each channel, channel after channel.

use super::SAMPLE_RATE_HZ;

/// Number of samples of each channel in a packet.
pub const SAMPLES_PER_PACKET: usize = 1022;

/// Seconds from the first sample of a packet to the first one of the next packet. 1022 samples last 7.984 s; the remaining
/// 16 ms are a real hole in the record.
pub const PACKET_PERIOD_S: f64 = 8.0;

/// The times in seconds of the samples of a packet whose first sample is at `first_s`.
pub fn packet_sample_times_s(first_s: f64) -> impl Iterator<Item = f64> {
    (0_u32..).take(SAMPLES_PER_PACKET).map(move |sample| first_s + f64::from(sample) / SAMPLE_RATE_HZ)
}

/// The bytes of a packet. `stamp_s` is the time of its first sample in seconds since 1970-01-01 UTC.
#[must_use]
pub fn encode_packet(stamp_s: f64, channels: &[Vec<i16>]) -> Vec<u8> {
    let counts = channels.iter().flatten().flat_map(|count| count.to_le_bytes());
    stamp_s.to_le_bytes().into_iter().chain(counts).collect()
}
