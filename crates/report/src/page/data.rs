//! Rows for the script, as compact JSON.

use std::collections::HashMap;

use serde::Serialize;

/// A table that the script shows a page at a time.
#[derive(Debug, Default, Serialize)]
pub(super) struct Grid {
    pub(super) columns: Vec<GridColumn>,
    /// The words that cells of text name by their index here.
    pub(super) words: Vec<String>,
    /// The rows, each with one cell per column.
    pub(super) rows: Vec<Vec<Datum>>,
}

/// A column of a [`Grid`].
#[derive(Debug, Serialize)]
pub(super) struct GridColumn {
    pub(super) name: String,
    pub(super) heading: String,
    /// Its meaning, for people.
    pub(super) meaning: &'static str,
    pub(super) kind: GridKind,
    /// Number of decimals of its numbers.
    pub(super) decimals: usize,
    /// Whether only the view of a single row shows the column.
    pub(super) detail: bool,
}

/// The kind of the cells of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum GridKind {
    /// Indices of [`Grid::words`].
    Text,
    /// Numbers, or text that begins with one.
    Number,
    /// Numbers that are sorted by their magnitude, such as errors.
    Magnitude,
    /// Milliseconds since 1970 UTC.
    Time,
    /// Either 0 or 1.
    Flag,
}

/// A cell of a [`Grid`].
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub(super) enum Datum {
    Word(usize),
    Number(f64),
    Whole(i64),
    Shown(String),
    Nothing(()),
}

/// A list of words, each of which is kept once, numbered in the order in which they came.
#[derive(Debug, Default)]
pub(super) struct Words {
    places: HashMap<String, usize>,
    words: Vec<String>,
}

impl Words {
    /// The cell that names a word by its index; a new word is added to the list.
    pub(super) fn place(&mut self, word: &str) -> Datum {
        if word.is_empty() {
            return Datum::Nothing(());
        }
        if let Some(place) = self.places.get(word) {
            return Datum::Word(*place);
        }
        self.places.insert(word.to_owned(), self.words.len());
        self.words.push(word.to_owned());
        Datum::Word(self.words.len() - 1)
    }

    pub(super) fn into_list(self) -> Vec<String> {
        self.words
    }
}

/// A number, rounded to so many decimals, or an empty cell. Digits that nobody sees would be most of the page.
pub(super) fn rounded(number: Option<f64>, decimals: usize) -> Datum {
    let scale = 10_f64.powi(i32::try_from(decimals).unwrap_or(0));
    let rounded = number.map(|number| (number * scale).round() / scale).filter(|number| number.is_finite());
    rounded.map_or(Datum::Nothing(()), |number| Datum::Number(if number == 0.0 { 0.0 } else { number }))
}

/// The value as JSON that can stand in a `<script>` element: nothing in it ends the element, or a line of script.
pub(super) fn script_json<T: Serialize>(value: &T) -> Result<String, serde_json::Error> {
    let json = serde_json::to_string(value)?;
    let mut escaped = String::with_capacity(json.len());
    for character in json.chars() {
        match character {
            // In JSON these characters occur in strings alone, where an escape means the same.
            '<' | '>' | '&' | '\u{2028}' | '\u{2029}' => {
                escaped.push_str(&format!("\\u{:04x}", u32::from(character)));
            }
            _ => escaped.push(character),
        }
    }
    Ok(escaped)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use super::*;

    #[test]
    fn nothing_in_a_name_ends_the_element_and_it_reads_back() {
        let name = "</script><!-- \u{2028}\u{2029} & \"quoted\" ' \\ \u{1f35c}";
        let json = script_json(&name).unwrap();
        assert!(!json.contains(['<', '>', '&', '\u{2028}', '\u{2029}']), "{json}");
        assert_eq!(serde_json::from_str::<String>(&json).unwrap(), name);
    }

    #[test]
    fn numbers_are_as_short_as_they_are_shown() {
        let text = |number, decimals| serde_json::to_string(&rounded(number, decimals)).unwrap();
        assert_eq!(text(Some(54.987_654), 2), "54.99");
        assert_eq!(text(Some(-0.001), 2), "0.0");
        assert_eq!(text(Some(f64::NAN), 2), "null");
        assert_eq!(text(None, 2), "null");
    }
}
