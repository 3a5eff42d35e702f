//! One data block: a stamp and up to 120 samples.

use jiff::civil::DateTime;

use super::fields::{bytes_at, civil, nominal_rate_hz, u16_at, u32_at};
use super::samples::Layout;

/// Bytes of a data block.
pub const BLOCK_BYTES: usize = 512;

/// The first bytes of a data block: "AX" and the number of bytes that follow, 508.
pub(super) const MAGIC: [u8; 4] = [b'A', b'X', 0xfc, 0x01];

/// Set when the field holds the fraction of the stamp's second; the field else holds the logger's number.
const HAS_FRACTION: u16 = 0x8000;

/// A data block.
#[derive(Debug, Clone, PartialEq)]
pub struct Block {
    /// Number of the recording.
    pub session_id: u32,
    /// Number of the block in the recording.
    pub sequence: u32,
    /// The logger's clock at sample [`stamp_index`](Self::stamp_index), to 1/32768 s; old firmware: to 1 s.
    pub stamp: DateTime,
    /// The sample that the stamp is of, counted from the block's first. It often lies beyond the block, for the logger
    /// fetches samples from its sensor in batches and notes the time of the last fetch.
    pub stamp_index: i32,
    /// The rate that was set, in Hz. The true one is off by a percent or so.
    pub nominal_rate_hz: f64,
    /// Acceleration in g, sensor axes x, y, z.
    pub samples: Vec<[f32; 3]>,
    /// Angular rate in degrees per second about x, y, z, one for each sample; none without a gyroscope.
    pub gyro_deg_per_s: Option<Vec<[f32; 3]>>,
}

/// Why a block gives no samples.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum BlockError {
    /// It does not begin as a data block does.
    #[error("a data block begins with 41 58 fc 01, got {:02x} {:02x} {:02x} {:02x}", got[0], got[1], got[2], got[3])]
    NotADataBlock {
        /// The first bytes.
        got: [u8; 4],
    },
    /// The words do not sum to 0.
    #[error("the words of the block sum to {sum:#06x} instead of 0: bytes were altered")]
    Checksum {
        /// The sum modulo 2^16.
        sum: u16,
    },
    /// The stamp is no date and time.
    #[error("the packed stamp {stamp:#010x} is not a date and time")]
    Date {
        /// The stamp as it stands in the block.
        stamp: u32,
    },
    /// The rate is not given by a known code.
    #[error("unknown rate code {code:#04x}")]
    Rate {
        /// The code.
        code: u8,
    },
    /// The samples are stored in an unknown way.
    #[error("unknown layout of samples: {axes} axes, packing {packing}")]
    Layout {
        /// Axes for each sample.
        axes: u8,
        /// Code of how a sample is stored.
        packing: u8,
    },
    /// More samples than a block has room for.
    #[error("{count} samples in a block that has room for {room}")]
    SampleCount {
        /// The samples that it claims.
        count: u16,
        /// The most there can be.
        room: usize,
    },
}

impl BlockError {
    /// Stable code, snake case.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::NotADataBlock { .. } => "not_a_data_block",
            Self::Checksum { .. } => "bad_checksum",
            Self::Date { .. } => "impossible_date",
            Self::Rate { .. } => "unknown_rate_code",
            Self::Layout { .. } => "unknown_layout",
            Self::SampleCount { .. } => "too_many_samples",
        }
    }

    /// Whether the bytes are those that the logger wrote, so that the next block follows at once.
    pub(super) fn is_whole_block(&self) -> bool {
        !matches!(self, Self::NotADataBlock { .. } | Self::Checksum { .. })
    }
}

impl Block {
    /// The block in these bytes.
    ///
    /// # Errors
    /// [`BlockError`] when they are not one, were altered, or hold what this reader does not know.
    pub fn parse(bytes: &[u8; BLOCK_BYTES]) -> Result<Self, BlockError> {
        let got = bytes_at(bytes, 0);
        if got != MAGIC {
            return Err(BlockError::NotADataBlock { got });
        }
        let sum = word_sum(bytes);
        if sum != 0 {
            return Err(BlockError::Checksum { sum });
        }
        let [rate_code, axes_and_packing] = bytes_at(bytes, 24);
        let nominal_rate_hz = nominal_rate_hz(rate_code).ok_or(BlockError::Rate { code: rate_code })?;
        let (stamp, stamp_index) = stamp(bytes, nominal_rate_hz)?;
        let layout = Layout::new(axes_and_packing, u16_at(bytes, 18))?;
        let count = u16_at(bytes, 28);
        let (samples, gyro_deg_per_s) = layout.read(bytes, count)?;
        Ok(Self {
            session_id: u32_at(bytes, 6),
            sequence: u32_at(bytes, 10),
            stamp,
            stamp_index,
            nominal_rate_hz,
            samples,
            gyro_deg_per_s,
        })
    }
}

/// Sum of the little-endian words modulo 2^16; 0 for a whole block, whose last word is chosen so.
fn word_sum(bytes: &[u8; BLOCK_BYTES]) -> u16 {
    let words = bytes.as_chunks().0.iter().map(|word| u16::from_le_bytes(*word));
    words.fold(0, u16::wrapping_add)
}

/// The stamp with its fraction, and the sample that it is of.
///
/// Readers older than the fraction take the stamp for a whole second. For their sake a logger that writes the fraction
/// moves the index back by the whole samples which fit into it at the nominal rate; that is undone here. As in the
/// firmware, rates of 12.5 Hz and less count by their whole Hz.
fn stamp(bytes: &[u8; BLOCK_BYTES], nominal_rate_hz: f64) -> Result<(DateTime, i32), BlockError> {
    let packed = u32_at(bytes, 14);
    let device_or_fraction = u16_at(bytes, 4);
    let index = i32::from(i16::from_le_bytes(bytes_at(bytes, 26)));
    let has_fraction = device_or_fraction & HAS_FRACTION != 0;
    let fraction = if has_fraction { f64::from(device_or_fraction & !HAS_FRACTION) / 32768.0 } else { 0.0 };
    let moved = (fraction * nominal_rate_hz.floor()).floor() as i32;
    let nanosecond = (fraction * 1e9).round() as i32;
    let stamp = civil(packed, nanosecond).ok_or(BlockError::Date { stamp: packed })?;
    Ok((stamp, index + moved))
}
