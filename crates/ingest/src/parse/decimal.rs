//! Times as numbers, without losing digits: an f64 of today's seconds is 240 ns coarse.

/// Nanoseconds of a decimal number of 10^`power_of_ten_ns` ns, cut to 1 ns. None for anything else than
/// `digits[.digits]`, and beyond i64. A number with an exponent is as exact as an f64.
pub(super) fn ns(text: &[u8], power_of_ten_ns: u32) -> Option<i64> {
    let text = text.strip_prefix(b"+").unwrap_or(text);
    if text.iter().any(|byte| byte.eq_ignore_ascii_case(&b'e')) {
        return ns_of(fast_float2::parse(text).ok()?, 10_i64.checked_pow(power_of_ten_ns)?);
    }
    let (whole, fraction) = match text.iter().position(|byte| *byte == b'.') {
        Some(dot) => (&text[..dot], &text[dot + 1..]),
        None => (text, &[][..]),
    };
    if whole.is_empty() || !fraction.iter().all(u8::is_ascii_digit) {
        return None;
    }
    let places = power_of_ten_ns as usize;
    let (shifted, missing) = match fraction.get(..places) {
        Some(shifted) => (shifted, 0),
        None => (fraction, places - fraction.len()),
    };
    if !whole.iter().all(u8::is_ascii_digit) {
        return None;
    }
    let value = |digit: &u8| i64::from(digit - b'0');
    let digits = whole.iter().chain(shifted);
    let zeros = 10_i64.checked_pow(u32::try_from(missing).ok()?)?;
    if whole.len() + places <= 18 {
        // No checks needed, and that is nearly all of the time.
        return Some(digits.fold(0, |total, digit| 10 * total + value(digit)) * zeros);
    }
    digits
        .copied()
        .try_fold(0, |total: i64, digit| total.checked_mul(10)?.checked_add(value(&digit)))?
        .checked_mul(zeros)
}

/// Nanoseconds of a number of units, whole and fraction apart, so that nothing is lost beyond the number's own digits.
/// It is none for a number that is negative, not finite or beyond i64.
#[expect(clippy::cast_possible_truncation, reason = "the range is checked, and floor() and round() give whole numbers")]
#[expect(clippy::cast_precision_loss, reason = "a unit is at most 1e9 ns")]
pub(super) fn ns_of(units: f64, unit_ns: i64) -> Option<i64> {
    let largest = i64::MAX as f64 / unit_ns as f64 - 1.0;
    if !(0.0..largest).contains(&units) {
        return None;
    }
    let whole = units.floor();
    Some(whole as i64 * unit_ns + ((units - whole) * unit_ns as f64).round() as i64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimal_times_are_exact() {
        assert_eq!(ns(b"1760676790.103992576", 9), Some(1_760_676_790_103_992_576));
        assert_eq!(ns(b"1760676790103992576", 0), Some(1_760_676_790_103_992_576));
        assert_eq!(ns(b"1760676790103.5", 6), Some(1_760_676_790_103_500_000));
        assert_eq!(ns(b"+12.", 3), Some(12_000));
        assert_eq!(ns(b"1.7487792000e+09", 9), Some(1_748_779_200_000_000_000));
    }

    #[test]
    fn what_is_no_time_is_refused() {
        for text in ["", ".5", "-1", "1e", "1.2.3", "NaN", "99999999999999999999", "0x10", "1 2"] {
            assert_eq!(ns(text.as_bytes(), 9), None, "{text}");
        }
        for units in [-1.0, f64::NAN, f64::INFINITY, 1e300] {
            assert_eq!(ns_of(units, 1_000_000_000), None, "{units}");
        }
        assert_eq!(ns_of(1.5, 1_000_000), Some(1_500_000));
    }
}
