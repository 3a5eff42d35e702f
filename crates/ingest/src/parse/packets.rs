//! One binary packet: a header with the time of its first sample, then the samples of all channels.

use model::UtcNs;

use super::Converter;
use crate::profile::{Endian, PacketLayout, SampleOrder, Scalar};
use crate::sample::Sample;

/// Parses packets of one layout.
#[derive(Debug, Clone)]
pub struct PacketParser {
    packet_bytes: usize,
    stamp_offset: usize,
    stamp_type: Scalar,
    sample_type: Scalar,
    endian: Endian,
    /// Byte offset of the first value of each used channel.
    channel_offsets: Vec<usize>,
    /// Bytes from a channel's value to its next.
    step_bytes: usize,
    samples: usize,
    missing: Option<f64>,
    rate_hz: f64,
    converter: Converter,
}

/// Why a packet, or a layout, gives no samples.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PacketError {
    /// The slice is not one packet.
    #[error("expected a packet of {expected} bytes, got {got}")]
    Length {
        /// Bytes of a packet.
        expected: usize,
        /// Bytes given.
        got: usize,
    },
    /// The stamp is no time between 1970 and 2262.
    #[error("the stamp {0} s is not a time between 1970 and 2262")]
    Stamp(String),
    /// The layout has no such channel or field, or is beyond all sizes.
    #[error("the layout does not declare {0}")]
    Layout(&'static str),
}

impl PacketParser {
    /// A parser of that layout. `rate_hz` is the step between a packet's samples.
    ///
    /// # Errors
    /// [`PacketError::Layout`] for a layout that [`Profile::check`](crate::Profile::check) refuses.
    pub fn new(layout: &PacketLayout, rate_hz: f64, converter: Converter) -> Result<Self, PacketError> {
        let mut header_bytes = 0;
        let mut stamp = None;
        for field in &layout.header {
            if field.field == "stamp" {
                stamp = Some((header_bytes, field.scalar));
            }
            header_bytes += field.scalar.bytes();
        }
        let (stamp_offset, stamp_type) = stamp.ok_or(PacketError::Layout("stamp"))?;
        let size = layout.sample_type.bytes();
        let samples_bytes = layout.samples.checked_mul(layout.channels.len()).and_then(|n| n.checked_mul(size));
        let packet_bytes =
            samples_bytes.and_then(|n| n.checked_add(header_bytes)).ok_or(PacketError::Layout("a possible size"))?;
        let (channel_bytes, step_bytes) = match layout.order {
            SampleOrder::ChannelMajor => (layout.samples * size, size),
            SampleOrder::Interleaved => (size, layout.channels.len() * size),
        };
        let offset_of = |name: &&'static str| {
            let index = layout.channels.iter().position(|channel| channel == name).ok_or(PacketError::Layout(name))?;
            Ok(header_bytes + index * channel_bytes)
        };
        Ok(Self {
            packet_bytes,
            stamp_offset,
            stamp_type,
            sample_type: layout.sample_type,
            endian: layout.endian,
            channel_offsets: converter.channels().iter().map(offset_of).collect::<Result<_, _>>()?,
            step_bytes,
            samples: layout.samples,
            missing: layout.missing,
            rate_hz,
            converter,
        })
    }

    /// Bytes of a packet.
    #[must_use]
    pub fn packet_bytes(&self) -> usize {
        self.packet_bytes
    }

    /// Appends the samples of one packet, in order of time: sample i is at stamp + i / rate. Missing ones are left out.
    ///
    /// # Errors
    /// [`PacketError`] when the slice is not one packet or its stamp is no time; nothing is then appended.
    pub fn parse(&self, packet: &[u8], out: &mut Vec<Sample>) -> Result<(), PacketError> {
        if packet.len() != self.packet_bytes {
            return Err(PacketError::Length { expected: self.packet_bytes, got: packet.len() });
        }
        let start = self.stamp(packet)?;
        for i in 0..self.samples {
            let mut counts = [0.0; 3];
            let mut is_missing = true;
            for (count, offset) in counts.iter_mut().zip(&self.channel_offsets) {
                *count = self.scalar(packet, offset + i * self.step_bytes, self.sample_type);
                is_missing &= self.missing.is_some_and(|missing| (*count - missing).abs() < f64::EPSILON);
            }
            if !is_missing && counts.iter().all(|count| count.is_finite()) {
                #[expect(clippy::cast_precision_loss, reason = "a packet has far fewer than 2^53 samples")]
                let time = start.plus_seconds(i as f64 / self.rate_hz);
                out.push(self.converter.sample(time, counts));
            }
        }
        Ok(())
    }

    fn stamp(&self, packet: &[u8]) -> Result<UtcNs, PacketError> {
        let bytes = packet.get(self.stamp_offset..).unwrap_or_default();
        let whole = |seconds: Option<i64>| seconds.filter(|s| *s >= 0).and_then(|s| s.checked_mul(1_000_000_000));
        let ns = match self.stamp_type {
            Scalar::I64 => whole(self.array(bytes).map(i64::from_le_bytes)),
            Scalar::U64 => whole(self.array(bytes).and_then(|b| i64::try_from(u64::from_le_bytes(b)).ok())),
            scalar => ns_of_seconds(self.scalar(packet, self.stamp_offset, scalar)),
        };
        let text = || self.scalar(packet, self.stamp_offset, self.stamp_type).to_string();
        ns.map(UtcNs).ok_or_else(|| PacketError::Stamp(text()))
    }

    /// The number at `offset`; NaN beyond the packet's end, which [`Self::parse`] has ruled out.
    #[expect(clippy::cast_precision_loss, reason = "64-bit integers are read exactly where it matters, as stamps")]
    fn scalar(&self, packet: &[u8], offset: usize, scalar: Scalar) -> f64 {
        let bytes = packet.get(offset..).unwrap_or_default();
        let value = match scalar {
            Scalar::I8 => self.array(bytes).map(|b| f64::from(i8::from_le_bytes(b))),
            Scalar::U8 => self.array(bytes).map(|b| f64::from(u8::from_le_bytes(b))),
            Scalar::I16 => self.array(bytes).map(|b| f64::from(i16::from_le_bytes(b))),
            Scalar::U16 => self.array(bytes).map(|b| f64::from(u16::from_le_bytes(b))),
            Scalar::I32 => self.array(bytes).map(|b| f64::from(i32::from_le_bytes(b))),
            Scalar::U32 => self.array(bytes).map(|b| f64::from(u32::from_le_bytes(b))),
            Scalar::I64 => self.array(bytes).map(|b| i64::from_le_bytes(b) as f64),
            Scalar::U64 => self.array(bytes).map(|b| u64::from_le_bytes(b) as f64),
            Scalar::F32 => self.array(bytes).map(|b| f64::from(f32::from_le_bytes(b))),
            Scalar::F64 => self.array(bytes).map(f64::from_le_bytes),
        };
        value.unwrap_or(f64::NAN)
    }

    /// The first N bytes, least significant first.
    fn array<const N: usize>(&self, bytes: &[u8]) -> Option<[u8; N]> {
        let mut array = *bytes.first_chunk()?;
        if self.endian == Endian::Big {
            array.reverse();
        }
        Some(array)
    }
}

/// Whole and fractional seconds apart, so that nothing is lost beyond the stamp's own 240 ns.
#[expect(clippy::cast_possible_truncation, reason = "the range is checked, and floor() and round() give whole numbers")]
fn ns_of_seconds(seconds: f64) -> Option<i64> {
    let latest = 9.2e9; // in the year 2261; i64 nanoseconds end in 2262
    if !(0.0..latest).contains(&seconds) {
        return None;
    }
    let whole = seconds.floor();
    Some(whole as i64 * 1_000_000_000 + ((seconds - whole) * 1e9).round() as i64)
}
