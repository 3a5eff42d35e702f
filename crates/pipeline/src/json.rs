//! JSON as annotation tools write it: with Python's `NaN`, and with whole numbers written as floats or as texts.

use std::borrow::Cow;

use serde_json::value::RawValue;

/// Whole numbers with more digits than this are no ids or sizes of any tool.
const MOST_DIGITS: i64 = 40;

/// The bytes of a JSON text in which `NaN`, `Infinity` and `-Infinity`, which Python writes though JSON does not have them, are
/// `null`. Strings stay as they are.
pub(crate) fn with_null_for_nan(bytes: &[u8]) -> Cow<'_, [u8]> {
    let mut replaced = Vec::new();
    let (mut rest, mut is_string) = (bytes, false);
    let mut copied = 0; // the number of bytes that `replaced` stands for
    while let [first, after @ ..] = rest {
        let word = [&b"-Infinity"[..], b"Infinity", b"NaN"].into_iter().find(|word| rest.starts_with(word));
        rest = match (is_string, *first, word) {
            (true, b'\\', _) => after.get(1..).unwrap_or_default(),
            (_, b'"', _) => {
                is_string = !is_string;
                after
            }
            (false, _, Some(word)) => {
                let begin = bytes.len() - rest.len();
                replaced.extend_from_slice(bytes.get(copied..begin).unwrap_or_default());
                replaced.extend_from_slice(b"null");
                copied = begin + word.len();
                rest.get(word.len()..).unwrap_or_default()
            }
            _ => after,
        };
    }
    if copied == 0 {
        return Cow::Borrowed(bytes);
    }
    replaced.extend_from_slice(bytes.get(copied..).unwrap_or_default());
    Cow::Owned(replaced)
}

/// The digits of a whole number, with `-` where it is negative and without leading zeros: `7` for `7`, `7.0`, `70e-1` and `007`.
/// None for every other text. No float is involved, so the digits are exact.
pub(crate) fn whole_number(text: &str) -> Option<String> {
    let text = text.trim();
    let (sign, unsigned) = text.strip_prefix('-').map_or(("", text), |rest| ("-", rest));
    let (mantissa, exponent) = unsigned.split_once(['e', 'E']).unwrap_or((unsigned, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let mut digits = format!("{whole}{fraction}");
    if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        return None;
    }
    let zeros = exponent.parse::<i64>().ok()?.checked_sub(i64::try_from(fraction.len()).ok()?)?;
    if zeros.abs() > MOST_DIGITS {
        return None;
    }
    (0..zeros).for_each(|_| digits.push('0'));
    for _ in zeros..0 {
        if !matches!(digits.pop(), None | Some('0')) {
            return None;
        }
    }
    match digits.trim_start_matches('0') {
        "" => Some("0".to_owned()),
        digits => Some(format!("{sign}{digits}")),
    }
}

/// The text of a JSON value that is a text or a number, written as in the file. None for other values, and for no value.
pub(crate) fn text_of(value: Option<&RawValue>) -> Option<String> {
    let written = value?.get();
    match written.as_bytes().first()? {
        b'"' => serde_json::from_str(written).ok(),
        b'-' | b'0'..=b'9' => Some(written.to_owned()),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use super::*;

    #[test]
    fn nan_becomes_null_outside_of_strings_alone() {
        let replaced = |text: &str| String::from_utf8(with_null_for_nan(text.as_bytes()).into_owned()).unwrap();
        for (text, expected) in [
            (r#"{"a": NaN, "b": [-Infinity, Infinity,1]}"#, r#"{"a": null, "b": [null, null,1]}"#),
            (r#"{"NaN": "NaN \" NaN \\", "c": NaN}"#, r#"{"NaN": "NaN \" NaN \\", "c": null}"#),
            ("NaN", "null"),
            (r#""NaN\"#, r#""NaN\"#),
        ] {
            assert_eq!(replaced(text), expected, "{text}");
        }
        assert!(matches!(with_null_for_nan(br#"{"a": 1}"#), Cow::Borrowed(_)));
    }

    #[test]
    fn whole_numbers_have_one_form() {
        for text in ["7", "7.0", "7.", "70e-1", "0.7e1", "7E0", " 007 ", "7e+0"] {
            assert_eq!(whole_number(text).as_deref(), Some("7"), "{text}");
        }
        for (text, expected) in [
            ("-0.0", Some("0")),
            ("-12", Some("-12")),
            ("0e30", Some("0")),
            ("20240101123456789", Some("20240101123456789")),
            ("1.2345678901234568e19", Some("12345678901234568000")),
            ("7.5", None),
            ("1e99", None),
            ("1e-99", None),
            ("", None),
            (".", None),
            ("a", None),
            ("7a", None),
            ("1e9999999999999999999", None),
        ] {
            assert_eq!(whole_number(text).as_deref(), expected, "{text}");
        }
    }
}
