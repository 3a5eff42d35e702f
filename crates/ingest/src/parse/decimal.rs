//! Decimal times, exactly: an f64 of today's seconds is 240 ns coarse.

use model::UtcNs;

/// The time that a decimal number of 10^`power_of_ten_ns` ns since 1970-01-01 UTC gives, cut to 1 ns. None for anything
/// else than `digits[.digits]`, for times before 1970 and after 2262.
pub(super) fn utc_ns(text: &[u8], power_of_ten_ns: u32) -> Option<UtcNs> {
    let text = text.strip_prefix(b"+").unwrap_or(text);
    let (whole, fraction) = match text.iter().position(|byte| *byte == b'.') {
        Some(dot) => (&text[..dot], &text[dot + 1..]),
        None => (text, &[][..]),
    };
    if whole.is_empty() || !fraction.iter().all(u8::is_ascii_digit) {
        return None;
    }
    let digits = |total: Option<i64>, digit: &u8| {
        let digit = digit.is_ascii_digit().then(|| i64::from(digit - b'0'))?;
        total?.checked_mul(10)?.checked_add(digit)
    };
    let shifted = (0..power_of_ten_ns as usize).map(|place| fraction.get(place).unwrap_or(&b'0'));
    whole.iter().chain(shifted).fold(Some(0), digits).map(UtcNs)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimal_times_are_exact() {
        assert_eq!(utc_ns(b"1760676790.103992576", 9), Some(UtcNs(1_760_676_790_103_992_576)));
        assert_eq!(utc_ns(b"1760676790103992576", 0), Some(UtcNs(1_760_676_790_103_992_576)));
        assert_eq!(utc_ns(b"1760676790103.5", 6), Some(UtcNs(1_760_676_790_103_500_000)));
        assert_eq!(utc_ns(b"+12.", 3), Some(UtcNs(12_000)));
    }

    #[test]
    fn what_is_no_time_is_refused() {
        for text in ["", ".5", "-1", "1e9", "1.2.3", "NaN", "99999999999999999999", "0x10", "1 2"] {
            assert_eq!(utc_ns(text.as_bytes(), 9), None, "{text}");
        }
    }
}
