//! From a TOML error to file, line, column, key and the nearest known key.

use std::path::Path;

use toml::de::Error;

use super::ConfigError;

pub(super) fn config_error(error: &Error, text: &str, path: &Path) -> ConfigError {
    let path = path.to_owned();
    let start = error.span().map_or(0, |span| span.start.min(text.len()));
    if let Some((key, known)) = unknown_field(error.message()) {
        let (line, column) = line_and_column(text, offset_of_key(text, start, &key));
        return ConfigError::UnknownKey { path, line, column, nearest: nearest(&key, &known), key, known };
    }
    let (line, column) = line_and_column(text, start);
    let mut message = error.message().replace('\n', "; ");
    // serde calls TOML's own dates and times maps.
    if message.contains("invalid type: map") && error.span().and_then(|span| text.get(span)).is_some_and(is_date_time) {
        message = format!("{message}; a date or time stands here without quotes: write it in quotes");
    }
    ConfigError::Malformed { path, line, column, key: key_at(text, line), message }
}

/// The known word that is most like `word`.
#[must_use]
pub fn nearest(word: &str, known: &[String]) -> Option<String> {
    let likeness = |candidate: &String| strsim::jaro_winkler(word, candidate);
    known.iter().max_by(|a, b| likeness(a).total_cmp(&likeness(b))).cloned()
}

fn is_date_time(value: &str) -> bool {
    value.trim().parse::<toml::value::Datetime>().is_ok()
}

/// The key and the known keys in serde's "unknown field `a`, expected `b`", "... one of `b`, `c`", "... no fields".
fn unknown_field(message: &str) -> Option<(String, Vec<String>)> {
    let rest = message.strip_prefix("unknown field `")?;
    let (key, rest) = rest.split_once('`')?;
    let known = rest.split('`').skip(1).step_by(2).map(str::to_owned).collect();
    Some((key.to_owned(), known))
}

/// serde buffers tagged tables, and the span is then that of the whole table: looks for the key from there on.
fn offset_of_key(text: &str, start: usize, key: &str) -> usize {
    let Some(tail) = text.get(start..) else { return start };
    let is_key_char = |c: char| c.is_alphanumeric() || c == '_' || c == '-';
    let is_key = |at: usize| {
        let before = tail.get(..at).and_then(|t| t.chars().next_back());
        let after = tail.get(at + key.len()..).unwrap_or_default();
        !before.is_some_and(is_key_char)
            && after.trim_start_matches(['"', '\'', ' ', '\t']).starts_with(['=', '.', ']'])
    };
    tail.match_indices(key).find(|(at, _)| is_key(*at)).map_or(start, |(at, _)| start + at)
}

fn line_and_column(text: &str, offset: usize) -> (usize, usize) {
    let before = text.get(..offset).unwrap_or(text);
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().map_or(0, |tail| tail.chars().count()) + 1;
    (line, column)
}

/// The key that the line sets, with the table header above it, for people to find it.
fn key_at(text: &str, line: usize) -> Option<String> {
    let above = || text.lines().take(line);
    let header = |l: &&str| l.trim_start().starts_with('[') && !l.contains('=');
    let table = above().filter(header).last().map(|l| l.trim().trim_matches(['[', ']']).trim().to_owned());
    // A line may begin with the braces of a table in a list.
    let key =
        above().last().and_then(|l| l.split_once('=')).map(|(key, _)| key.trim_start_matches([' ', '\t', '[', '{']));
    let key = key.map(|key| key.trim_end().to_owned());
    match (table, key) {
        (Some(table), Some(key)) => Some(format!("{table}.{key}")),
        (table, key) => key.or(table),
    }
}
