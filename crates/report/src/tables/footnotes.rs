//! Footnotes: the rows that they belong to, and their letters.

use model::{Note, TableSpec};

use super::printed::{Setup, is_same};
use crate::table::{Cell, Footnote, RowKind, TableRow};

/// A row whose footnotes have no letters yet. Its last cell is the column of notes.
pub(super) struct NotedRow {
    pub(super) kind: RowKind,
    pub(super) label: Option<String>,
    /// The cells without the last one.
    pub(super) cells: Vec<Cell>,
    pub(super) notes: Vec<String>,
}

/// The study's notes, which are handed out to the rows that they belong to.
pub(super) struct Notes<'a> {
    left: Vec<(&'a Note, bool)>,
}

impl<'a> Notes<'a> {
    pub(super) fn from_spec(spec: &'a TableSpec) -> Self {
        Self { left: spec.notes.iter().map(|note| (note, false)).collect() }
    }

    fn take(&mut self, belongs: impl Fn(&Note) -> bool) -> Vec<String> {
        let mut texts = Vec::new();
        for (note, taken) in &mut self.left {
            if belongs(note) {
                *taken = true;
                texts.push(note.text.clone());
            }
        }
        texts
    }

    /// Hands out the notes of an object's row at a setup.
    pub(super) fn of_setup(&mut self, object: &str, setup: Setup) -> Vec<String> {
        self.take(|note| {
            let names_setup = note.setup_height_mm.is_some() || note.setup_pitch_deg.is_some();
            names_setup
                && note.object.as_deref().is_none_or(|named| named == object)
                && note.setup_height_mm.is_none_or(|height| is_same(height, setup.height_mm))
                && note.setup_pitch_deg.is_none_or(|pitch| is_same(pitch, setup.pitch_deg))
        })
    }

    /// Hands out the notes of an object as a whole.
    pub(super) fn of_object(&mut self, object: &str) -> Vec<String> {
        self.take(|note| {
            note.setup_height_mm.is_none() && note.setup_pitch_deg.is_none() && note.object.as_deref() == Some(object)
        })
    }

    /// Hands out the notes of the table, and those whose row is not in it, so that no note is lost.
    pub(super) fn rest(&mut self) -> Vec<String> {
        let mut texts = Vec::new();
        for (note, taken) in &mut self.left {
            if !std::mem::replace(taken, true) {
                texts.push(match &note.object {
                    Some(object) => format!("{object}: {}", note.text),
                    None => note.text.clone(),
                });
            }
        }
        texts
    }
}

/// Gives every footnote its letter, in the order of the rows. Equal texts share a letter.
pub(super) fn mark(rows: Vec<NotedRow>) -> (Vec<TableRow>, Vec<Footnote>) {
    let mut footnotes: Vec<Footnote> = Vec::new();
    let rows = rows
        .into_iter()
        .map(|NotedRow { kind, label, mut cells, notes }| {
            let mut marks: Vec<String> = notes.iter().map(|text| mark_of(text, &mut footnotes)).collect();
            marks.sort_by(|a, b| a.len().cmp(&b.len()).then_with(|| a.cmp(b)));
            marks.dedup();
            cells.push(if notes.is_empty() { Cell::Empty } else { Cell::Text(notes.join("; ")) });
            TableRow { kind, label, cells, marks }
        })
        .collect();
    (rows, footnotes)
}

fn mark_of(text: &str, footnotes: &mut Vec<Footnote>) -> String {
    if let Some(known) = footnotes.iter().find(|footnote| footnote.text == text) {
        return known.mark.clone();
    }
    let mark = letters(footnotes.len());
    footnotes.push(Footnote { mark: mark.clone(), text: text.to_owned() });
    mark
}

/// The letters of the footnote with this index: a, b, ... z, aa, ab, ...
fn letters(index: usize) -> String {
    let last = char::from(b'a' + u8::try_from(index % 26).unwrap_or_default());
    if index < 26 { last.to_string() } else { letters(index / 26 - 1) + &last.to_string() }
}

#[cfg(test)]
mod tests {
    use super::letters;

    #[test]
    fn letters_go_on_after_z() {
        assert_eq!([0, 25, 26, 27, 51, 52, 701, 702].map(letters), ["a", "z", "aa", "ab", "az", "ba", "zz", "aaa"]);
    }
}
