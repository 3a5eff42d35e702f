//! Fields that headers and blocks share.

use jiff::civil::DateTime;

/// The N bytes at `at`; zeros beyond the end, which no caller asks for: headers and blocks have fixed sizes.
pub(super) fn bytes_at<const N: usize>(bytes: &[u8], at: usize) -> [u8; N] {
    bytes.get(at..).and_then(|rest| rest.first_chunk()).copied().unwrap_or([0; N])
}

pub(super) fn u16_at(bytes: &[u8], at: usize) -> u16 {
    u16::from_le_bytes(bytes_at(bytes, at))
}

pub(super) fn u32_at(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(bytes_at(bytes, at))
}

/// The date and time packed as `YYYYYYMM MMDDDDDh hhhhmmmm mmssssss`, the year from 2000; `nanosecond` is added. None
/// when there is no such day or time, as with 0 and all ones, which loggers write for "unknown".
pub(super) fn civil(packed: u32, nanosecond: i32) -> Option<DateTime> {
    let field = |shift: u32, bits: u32| (packed >> shift) & ((1 << bits) - 1);
    let small = |shift, bits| i8::try_from(field(shift, bits)).ok();
    let year = i16::try_from(2000 + field(26, 6)).ok()?;
    let (month, day) = (small(22, 4)?, small(17, 5)?);
    let (hour, minute, second) = (small(12, 5)?, small(6, 6)?, small(0, 6)?);
    DateTime::new(year, month, day, hour, minute, second, nanosecond).ok()
}

/// Nominal rate in Hz of a rate code: 3200 at 15 and half of it with each step down. None for step 0, which only files
/// older than the code have, with the rate elsewhere.
pub(super) fn nominal_rate_hz(code: u8) -> Option<f64> {
    let step = code & 0x0f;
    (step > 0).then(|| 3200.0 / f64::from(1_u32 << (15 - step)))
}

/// Full scale of the accelerometer of a rate code, in g: 16, 8, 4 or 2.
pub(super) fn range_g(code: u8) -> u8 {
    16 >> (code >> 6)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packed_time() {
        let packed = (26 << 26) | (2 << 22) | (28 << 17) | (23 << 12) | (59 << 6) | 58;
        assert_eq!(civil(packed, 500_000_000).map(|time| time.to_string()), Some("2026-02-28T23:59:58.5".to_owned()));
        for impossible in [0, u32::MAX, packed + (1 << 17), packed + 2] {
            assert_eq!(civil(impossible, 0), None, "{impossible:08x}");
        }
    }

    #[test]
    fn rate_codes() {
        assert_eq!(nominal_rate_hz(0x4a), Some(100.0));
        assert_eq!(nominal_rate_hz(0x0f), Some(3200.0));
        assert_eq!(nominal_rate_hz(0x06), Some(6.25));
        assert_eq!(nominal_rate_hz(0x40), None);
        assert_eq!([0x0a, 0x4a, 0x8a, 0xca].map(range_g), [16, 8, 4, 2]);
    }
}
