//! How samples lie in binary packets.

use serde::{Deserialize, Serialize};

use super::{Epoch, TimeUnit};

/// Binary packets of one size, one after the other. A packet of one sample is a record.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PacketLayout {
    /// The fields that precede the samples, in order. One field is named `stamp`: the packet's time. One may be named `sequence`: a
    /// number that rises by one from packet to packet.
    pub header: Vec<HeaderField>,
    /// The meaning of the stamp.
    #[serde(default, skip_serializing_if = "is_default")]
    pub stamp: PacketStamp,
    /// The source of the step between a packet's samples.
    #[serde(default, skip_serializing_if = "is_default")]
    pub step: Step,
    /// Byte order of header and samples.
    pub endian: Endian,
    /// Type of one value.
    #[serde(default = "default_sample_type")]
    pub sample_type: Scalar,
    /// Names of the channels in order: `x`, `y`, `z` or `range` are used, those in `extra` carried along, others skipped.
    pub channels: Vec<String>,
    /// Samples per packet and channel.
    pub samples: usize,
    /// How channels follow each other.
    pub order: SampleOrder,
    /// Value that stands for 'no sample'. An acceleration sample is missing where x, y and z all have it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub missing: Option<f64>,
}

fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

fn default_sample_type() -> Scalar {
    Scalar::I16
}

/// A field of a packet's header.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HeaderField {
    /// Name; `stamp` is the time, `sequence` counts packets, others are skipped.
    pub field: String,
    /// Type, hence size.
    #[serde(rename = "type")]
    pub scalar: Scalar,
}

/// Type of a number in a packet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Scalar {
    /// 8-bit signed.
    I8,
    /// 8-bit unsigned.
    U8,
    /// 16-bit signed.
    I16,
    /// 16-bit unsigned.
    U16,
    /// 32-bit signed.
    I32,
    /// 32-bit unsigned.
    U32,
    /// 64-bit signed.
    I64,
    /// 64-bit unsigned.
    U64,
    /// IEEE 754 single.
    F32,
    /// IEEE 754 double.
    F64,
}

impl Scalar {
    /// Size in bytes.
    #[must_use]
    pub fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }
}

/// Byte order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Endian {
    /// Least significant byte first.
    Little,
    /// Most significant byte first.
    Big,
}

/// How the channels of a packet follow each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SampleOrder {
    /// All samples of the first channel, then all of the second.
    ChannelMajor,
    /// The first sample of all channels, then the second.
    Interleaved,
}

/// The meaning of a packet's stamp.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PacketStamp {
    /// Its unit.
    pub unit: TimeUnit,
    /// Which moment of the packet it is.
    pub at: StampAt,
    /// Its zero.
    pub epoch: Epoch,
    /// The counter starts anew after 2^`wrap_bits` units.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wrap_bits: Option<u32>,
}

impl PacketStamp {
    /// After how many ns the counter starts anew, if it does.
    #[must_use]
    pub fn wrap_ns(&self) -> Option<i128> {
        self.unit.wrap_ns(self.wrap_bits)
    }
}

/// Which moment of a packet its stamp is.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StampAt {
    /// Its first sample.
    #[default]
    First,
    /// Its last sample.
    Last,
    /// One step after its last sample, when it was written.
    End,
}

/// The source of the step between the samples of a packet.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Step {
    /// The nominal rate: holes between packets are real. Where that would reach into the next packet, its stamp.
    #[default]
    Nominal,
    /// The stamps: packets without a gap between them touch.
    Stamps,
}
