//! How samples lie in files: packets and CSV.

use serde::{Deserialize, Serialize};

/// Binary packets of one size, one after the other. The stamp is the time of a packet's first sample.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PacketLayout {
    /// What precedes the samples, in order. One field is named `stamp`: seconds since 1970-01-01 UTC.
    pub header: Vec<HeaderField>,
    /// Byte order of header and samples.
    pub endian: Endian,
    /// Type of one value.
    #[serde(default = "default_sample_type")]
    pub sample_type: Scalar,
    /// Names of the channels in order: `x`, `y`, `z` or `range` are used, others skipped.
    pub channels: Vec<String>,
    /// Samples per packet and channel.
    pub samples: usize,
    /// How channels follow each other.
    pub order: SampleOrder,
    /// Value that stands for 'no sample'. An acceleration sample is missing where x, y and z all have it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub missing: Option<f64>,
}

fn default_sample_type() -> Scalar {
    Scalar::I16
}

/// A field of a packet's header.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HeaderField {
    /// Name; `stamp` is the time, others are skipped.
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

/// The time column of a CSV file: time since 1970-01-01 UTC.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TimeColumn {
    /// Its name in the file's first line.
    pub column: String,
    /// Its unit.
    pub unit: TimeUnit,
}

/// Unit of a time column.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TimeUnit {
    /// Seconds.
    S,
    /// Milliseconds.
    Ms,
    /// Microseconds.
    Us,
    /// Nanoseconds.
    Ns,
}

impl TimeUnit {
    /// Nanoseconds in one unit, as a power of ten.
    #[must_use]
    pub fn power_of_ten_ns(self) -> u32 {
        match self {
            Self::S => 9,
            Self::Ms => 6,
            Self::Us => 3,
            Self::Ns => 0,
        }
    }
}

/// Columns of an accelerometer's CSV file, by their names in its first line.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AccelerationColumns {
    /// Time.
    pub time: TimeColumn,
    /// Sensor x, in counts.
    pub x: String,
    /// Sensor y, in counts.
    pub y: String,
    /// Sensor z, in counts.
    pub z: String,
    /// What separates columns: one ASCII character.
    #[serde(default = "comma")]
    pub delimiter: char,
}

/// Columns of a range sensor's CSV file, by their names in its first line.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RangeColumns {
    /// Time.
    pub time: TimeColumn,
    /// Reading, in counts.
    pub range: String,
    /// What separates columns: one ASCII character.
    #[serde(default = "comma")]
    pub delimiter: char,
}

fn comma() -> char {
    ','
}
