//! The header block at the start of a CWA file.

use jiff::civil::DateTime;

use super::fields::{bytes_at, civil, nominal_rate_hz, range_g, u16_at, u32_at};

/// Bytes of a header.
pub const HEADER_BYTES: usize = 1024;

/// The first bytes of a header: "MD" and the number of bytes that follow, 1020.
const MAGIC: [u8; 4] = [b'M', b'D', 0xfc, 0x03];

/// The settings of the logger. Nothing of them is needed to read the blocks, and no checksum guards them.
#[derive(Debug, Clone, PartialEq)]
pub struct Header {
    /// The logger's make.
    pub hardware: Hardware,
    /// Number of the logger.
    pub device_id: u32,
    /// Number of the recording.
    pub session_id: u32,
    /// Nominal rate in Hz, when the code is known.
    pub nominal_rate_hz: Option<f64>,
    /// Full scale of the accelerometer in g.
    pub range_g: u8,
    /// The time at which the recording was to start, on the logger's clock; none when it was not limited.
    pub logging_start: Option<DateTime>,
    /// The time at which the recording was to end, on the logger's clock; none when it was not limited.
    pub logging_end: Option<DateTime>,
    /// Revision of the firmware.
    pub firmware: u8,
}

/// The logger's make.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Hardware {
    /// Accelerometer only.
    Ax3,
    /// Accelerometer and gyroscope.
    Ax6,
    /// A code that this reader does not know.
    Other(u8),
}

impl Header {
    /// The header in these bytes; none when they are not one.
    #[must_use]
    pub fn parse(bytes: &[u8; HEADER_BYTES]) -> Option<Self> {
        if !bytes.starts_with(&MAGIC) {
            return None;
        }
        let [hardware] = bytes_at(bytes, 4);
        let [rate_code] = bytes_at(bytes, 36);
        let [firmware] = bytes_at(bytes, 41);
        Some(Self {
            hardware: match hardware {
                0x00 | 0x17 | 0xff => Hardware::Ax3,
                0x64 => Hardware::Ax6,
                code => Hardware::Other(code),
            },
            device_id: device_id(u16_at(bytes, 5), u16_at(bytes, 11)),
            session_id: u32_at(bytes, 7),
            nominal_rate_hz: nominal_rate_hz(rate_code),
            range_g: range_g(rate_code),
            logging_start: civil(u32_at(bytes, 13), 0),
            logging_end: civil(u32_at(bytes, 17), 0),
            firmware,
        })
    }
}

/// Loggers of numbers below 65536 leave the upper half erased.
fn device_id(lower: u16, upper: u16) -> u32 {
    let upper = if upper == u16::MAX { 0 } else { upper };
    (u32::from(upper) << 16) | u32::from(lower)
}
