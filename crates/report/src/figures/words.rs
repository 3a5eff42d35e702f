//! Words on figures: names from people, made safe and short, and numbers as text.

/// The text without characters that XML forbids, control characters, and those that turn the direction of the text after them.
/// U+FFFD stands in their place.
pub(super) fn clean(text: &str) -> String {
    let is_bad = |character: char| {
        character.is_control()
            || matches!(character, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
            || matches!(character, '\u{fffe}' | '\u{ffff}')
    };
    text.chars().map(|character| if is_bad(character) { '\u{fffd}' } else { character }).collect()
}

/// A name as it stands in a sentence.
pub(super) fn named(name: &str) -> String {
    if name.trim().is_empty() { "(no name)".to_owned() } else { clean(name) }
}

/// The name, shortened so that it takes no more than `width` units at the size `size`. Letters are left out in the middle, since
/// names differ at both ends.
pub(super) fn fitted(name: &str, width: f64, size: f64) -> String {
    let name = named(name);
    if estimated_width(&name, size) <= width {
        return name;
    }
    let letters: Vec<char> = name.chars().collect();
    let mut kept = letters.len();
    loop {
        kept = kept.saturating_sub(1);
        let (head, tail) = (kept.div_ceil(2), kept / 2);
        let ends = letters.iter().take(head).chain([&'\u{2026}']).chain(letters.iter().skip(letters.len() - tail));
        let text: String = ends.collect();
        if kept == 0 || estimated_width(&text, size) <= width {
            return text;
        }
    }
}

/// Estimated width of a text at the size `size`. The font is not known; the estimate is no less than the width in common fonts.
pub(super) fn estimated_width(text: &str, size: f64) -> f64 {
    let em = |character: char| match character {
        'i' | 'j' | 'l' | 't' | 'f' | 'r' | '.' | ',' | ':' | ';' | '\'' | '|' | '(' | ')' | ' ' => 0.38,
        'm' | 'w' | 'M' | 'W' | '@' | '%' => 0.98,
        'A'..='Z' | '#' | '&' | '+' | '=' | '<' | '>' | '\u{2212}' | '~' => 0.78,
        '\u{1100}'.. => 1.1,
        _ => 0.63,
    };
    text.chars().map(em).sum::<f64>() * size
}

/// A number as text, with a true minus sign, but none before zero.
pub(super) fn number(value: f64, decimals: usize) -> String {
    let text = format!("{:.decimals$}", value.abs());
    let is_zero = !text.bytes().any(|byte| byte.is_ascii_digit() && byte != b'0');
    if value < 0.0 && !is_zero { format!("\u{2212}{text}") } else { text }
}

/// A number as text, with a plus or a true minus sign, but none before zero.
pub(super) fn signed(value: f64, decimals: usize) -> String {
    let text = number(value, decimals);
    let is_zero = !text.bytes().any(|byte| byte.is_ascii_digit() && byte != b'0');
    if value > 0.0 && !is_zero { format!("+{text}") } else { text }
}

/// A number of things as `1 image` or `2 images`.
pub(super) fn counted(n: usize, one: &str) -> String {
    if n == 1 { format!("{n} {one}") } else { format!("{n} {one}s") }
}

/// Words as a list: `a`, `a and b`, `a, b and c`.
pub(super) fn listed(words: &[String]) -> String {
    match words {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_shortened_in_the_middle_and_never_wider_than_asked() {
        assert_eq!(fitted("bowl", 100.0, 12.0), "bowl");
        assert_eq!(fitted(" ", 100.0, 12.0), "(no name)");
        let long = fitted(&"participant-0042-lunch-".repeat(40), 120.0, 12.0);
        assert!(long.starts_with("part") && long.ends_with("lunch-") && long.contains('\u{2026}'), "{long}");
        assert!(estimated_width(&long, 12.0) <= 120.0);
        assert_eq!(fitted("abc", 0.0, 12.0), "\u{2026}");
        assert_eq!(clean("a\u{202e}b\0\u{ffff}\n"), "a\u{fffd}b\u{fffd}\u{fffd}\u{fffd}");
    }

    #[test]
    fn numbers() {
        assert_eq!([number(-1.25, 1), number(-0.01, 1), signed(0.3, 1)], ["\u{2212}1.2", "0.0", "+0.3"]);
        assert_eq!(listed(&["a", "b", "c"].map(str::to_owned)), "a, b and c");
    }
}
