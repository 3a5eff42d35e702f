//! Names of files as text, whatever bytes they consist of.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use model::{Problem, ProblemCode};

use super::{CardFile, Place};
use crate::unicode::{nfc, spelled_out};

/// A path relative to the card, with `/`. Bytes that are not UTF-8, and control characters, are written `\xff`, a backslash
/// in a name as `\\`: no two files get the same name.
pub(super) fn card_name(relative: &Path) -> String {
    let parts: Vec<String> = relative.iter().map(exact_name_text).collect();
    parts.join("/")
}

/// The name of a file or folder as text in the form in which names are compared ([`nfc`]), else as [`exact_name_text`].
#[must_use]
pub fn name_text(name: &OsStr) -> String {
    nfc(exact_name_text(name))
}

/// The entry of `folder` that has this name, as [`name_text`] gives it, in whatever Unicode form; the exact one comes first. None
/// where there is no such entry, or the folder cannot be listed.
#[must_use]
pub fn entry_named(folder: &Path, name: &str) -> Option<PathBuf> {
    let exact = folder.join(name);
    if !name.is_empty() && !name.contains(['/', '\\']) && exact.symlink_metadata().is_ok() {
        return Some(exact);
    }
    let mut entries: Vec<PathBuf> =
        std::fs::read_dir(folder).ok()?.filter_map(|entry| Some(entry.ok()?.path())).collect();
    entries.sort();
    let wanted = nfc(name);
    entries.into_iter().find(|path| path.file_name().is_some_and(|entry| name_text(entry) == wanted))
}

/// Gives files the names in the form in which names are compared, but for those that would then be the same; these keep the form
/// that they have, and are told.
pub(super) fn normalise(files: &mut [CardFile], place: &Place) -> Option<Problem> {
    let mut by_name: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    for (number, file) in files.iter().enumerate() {
        by_name.entry(nfc(&file.name)).or_default().push(number);
    }
    let mut alike: Vec<(String, Vec<String>)> = Vec::new();
    for (name, numbers) in by_name {
        if let &[number] = numbers.as_slice() {
            files[number].name = name;
        } else {
            alike.push((name, numbers.iter().map(|number| spelled_out(&files[*number].name)).collect()));
        }
    }
    let (name, spelled) = alike.first()?;
    let others = match alike.len() {
        1 => String::new(),
        more => format!(", and {} more such names", more - 1),
    };
    let fact = format!("names are the same but for their Unicode form: {}{others}; all are used", spelled.join(", "));
    let remedy = "rename all but one: marks of this name belong to neither";
    Some(place.note(ProblemCode::NamesDifferInForm, name, fact, remedy))
}

/// The name of a file or folder as text. Bytes that are not UTF-8, and control characters, are written `\xff`, a backslash as
/// `\\`: no two get the same.
#[must_use]
pub fn exact_name_text(name: &OsStr) -> String {
    let bytes = name.as_encoded_bytes();
    let mut text = String::with_capacity(bytes.len());
    let escape = |text: &mut String, bytes: &[u8]| {
        bytes.iter().for_each(|byte| text.push_str(&format!("\\x{byte:02x}")));
    };
    for chunk in bytes.utf8_chunks() {
        for character in chunk.valid().chars() {
            match character {
                '\\' => text.push_str("\\\\"),
                _ if character.is_control() => escape(&mut text, character.encode_utf8(&mut [0; 4]).as_bytes()),
                _ => text.push(character),
            }
        }
        escape(&mut text, chunk.invalid());
    }
    text
}

/// Names that other systems cannot keep: not UTF-8, or the same but for upper and lower case.
pub(super) fn odd_names(files: &[CardFile], place: &Place) -> Vec<Problem> {
    [not_utf8(files, place), differ_in_case(files, place)].into_iter().flatten().collect()
}

fn not_utf8(files: &[CardFile], place: &Place) -> Option<Problem> {
    let mut odd = files.iter().filter(|file| file.path.to_str().is_none());
    let first = odd.next()?;
    let fact = match odd.count() {
        0 => "the file's name is not UTF-8; it is used, with the odd bytes written as \\x..".to_owned(),
        more => format!("{} names are not UTF-8, first this one; their odd bytes are written as \\x..", more + 1),
    };
    Some(place.note(ProblemCode::NameNotUtf8, &first.name, fact, "rename the files if another program must read them"))
}

fn differ_in_case(files: &[CardFile], place: &Place) -> Option<Problem> {
    let mut by_lower_case: BTreeMap<String, Vec<&CardFile>> = BTreeMap::new();
    for file in files {
        by_lower_case.entry(file.name.to_lowercase()).or_default().push(file);
    }
    let mut alike = by_lower_case.into_values().filter(|files| files.len() > 1);
    let first = alike.next()?;
    let names: Vec<&str> = first.iter().map(|file| file.name.as_str()).collect();
    let others = match alike.count() {
        0 => String::new(),
        more => format!(", and {more} more such names"),
    };
    let fact = format!("names differ only in upper and lower case: {}{others}; all are used", names.join(", "));
    let remedy = "copy the card on Linux only: on Windows and macOS one of them overwrites the other";
    Some(place.note(ProblemCode::NamesDifferInCase, names[0], fact, remedy))
}

#[cfg(all(test, unix))]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use super::super::{Card, Patterns};
    use super::entry_named;

    const TYPED: &str = "I/k\u{e4}se.jpg";
    const STORED: &str = "I/ka\u{308}se.jpg";

    fn card(files: &[&str]) -> (tempfile::TempDir, Card) {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("I")).unwrap();
        files.iter().for_each(|file| std::fs::write(folder.path().join(file), file).unwrap());
        let card = Card::list(folder.path()).unwrap();
        (folder, card)
    }

    #[test]
    fn a_picture_has_its_name_in_one_form() {
        let (folder, card) = card(&[STORED]);
        assert_eq!(card.files[0].name, TYPED);
        assert!(card.problems.is_empty());
        for pattern in ["I/k\u{e4}*.jpg", "I/ka\u{308}*.jpg"] {
            assert_eq!(card.fitting(&Patterns::new(&[pattern.to_owned()]).unwrap()).len(), 1);
        }
        let there = entry_named(&folder.path().join("I"), "k\u{e4}se.jpg").unwrap();
        assert_eq!(std::fs::read(there).unwrap(), STORED.as_bytes());
        assert_eq!(entry_named(folder.path(), "k\u{e4}se.jpg"), None);
    }

    #[test]
    fn files_whose_names_become_one_keep_their_own_and_are_told() {
        let (_folder, card) = card(&[STORED, TYPED, "I/b.jpg"]);
        let names: Vec<&str> = card.files.iter().map(|file| file.name.as_str()).collect();
        assert_eq!(names, ["I/b.jpg", STORED, TYPED]);
        let told: Vec<(&str, bool)> =
            card.problems.iter().map(|problem| (problem.code.code(), problem.fact.contains("ka\\u{308}se"))).collect();
        assert_eq!(told, [("names_differ_in_form", true)]);
    }
}
