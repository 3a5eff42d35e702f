//! Names of files as text, whatever bytes they consist of.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::path::Path;

use model::{Problem, ProblemCode};

use super::{CardFile, Place};

/// A path relative to the card, with `/`. Bytes that are not UTF-8, and control characters, are written `\xff`, a backslash
/// in a name as `\\`: no two files get the same name.
pub(super) fn card_name(relative: &Path) -> String {
    let parts: Vec<String> = relative.iter().map(name_text).collect();
    parts.join("/")
}

/// The name of a file or folder as text. Bytes that are not UTF-8, and control characters, are written `\xff`, a backslash as
/// `\\`: no two get the same.
#[must_use]
pub fn name_text(name: &OsStr) -> String {
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
