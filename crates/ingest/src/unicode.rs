//! The one form in which names are compared.

use std::borrow::Cow;

use unicode_normalization::{IsNormalized, UnicodeNormalization, is_nfc_quick};

/// The text in Unicode's normalisation form C (UAX #15), in which letters with marks are one character where there is one. What
/// people type is mostly in it, while macOS stores names of files with the marks apart. Names are the same if this text is.
#[must_use]
pub fn nfc<'a>(text: impl Into<Cow<'a, str>>) -> String {
    let text: Cow<'a, str> = text.into();
    match is_nfc_quick(text.chars()) {
        IsNormalized::Yes => text.into_owned(),
        IsNormalized::No | IsNormalized::Maybe => text.nfc().collect(),
    }
}

/// The text with its characters beyond ASCII as `\u{...}`: what tells two names apart that look alike.
#[must_use]
pub fn spelled_out(text: &str) -> String {
    let spelled = |c: char| if c.is_ascii() { c.to_string() } else { c.escape_unicode().to_string() };
    text.chars().map(spelled).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Forms of UAX #15: a letter with a mark, two marks in either order, Hangul, and the Angstrom sign.
    #[test]
    fn one_name_has_one_form() {
        for (one, other) in [
            ("u\u{308}", "\u{fc}"),
            ("a\u{323}\u{307}", "a\u{307}\u{323}"),
            ("\u{1112}\u{1161}\u{11ab}", "\u{d55c}"),
            ("\u{212b}", "A\u{30a}"),
            ("plain", "plain"),
        ] {
            assert_eq!(nfc(one), nfc(other), "{}", spelled_out(one));
        }
        assert_ne!(nfc("\u{fb01}"), nfc("fi"), "a ligature is another name");
    }

    #[test]
    fn spelled_out_names_differ_where_the_names_do() {
        assert_eq!(spelled_out("mu\u{308}"), "mu\\u{308}");
        assert_eq!(spelled_out("m\u{fc}"), "m\\u{fc}");
    }
}
