//! What lies on a card and is not read, because no pattern of the profile fits it.

use std::fs::File;
use std::io::Read;

use model::{Problem, ProblemCode};

use super::patterns::{PatternError, Patterns, is_hidden};
use super::place::amount;
use super::{Card, CardFile, Place};
use crate::parse::image_header;

/// Files of the study, and of operating systems, that belong to no sensor.
const HOUSEKEEPING: [&str; 3] = ["session.toml", "thumbs.db", "desktop.ini"];
const PICTURE_EXTENSIONS: [&str; 3] = ["jpg", "jpeg", "png"];
/// At most this many unread files are opened, to see whether they are pictures.
const MOST_OPENED: usize = 1000;

/// A profile's patterns, and those of its images among them.
pub(crate) struct Declared<'a> {
    pub all: &'a [String],
    pub images: &'a [String],
}

impl Card {
    /// A note on the files that no pattern fits, and what is neither a file nor a folder.
    ///
    /// # Errors
    /// [`PatternError`] for a pattern that cannot be used.
    pub(crate) fn unread(&self, declared: &Declared<'_>, place: &Place) -> Result<Vec<Problem>, PatternError> {
        let patterns = Patterns::new(declared.all)?;
        let mut problems: Vec<Problem> = self.special.iter().map(|name| not_a_file(name, &patterns, place)).collect();
        let is_unread = |file: &&CardFile| !patterns.fits(&file.name) && !is_housekeeping(&file.name);
        let unread: Vec<&CardFile> = self.files.iter().filter(is_unread).collect();
        if let Some(first) = unread.first() {
            let examples: Vec<&str> = unread.iter().take(3).map(|file| file.name.as_str()).collect();
            let bytes = unread.iter().map(|file| file.bytes).sum();
            let files = amount(unread.len(), "file", bytes);
            let verb = if unread.len() == 1 { "fits" } else { "fit" };
            let and_more = if unread.len() > examples.len() { ", ..." } else { "" };
            let examples = examples.join(", ");
            let fact = format!("{files} {verb} no pattern of the profile and stay unread: {examples}{and_more}");
            // A single one is named; several are the card's matter.
            let file = if unread.len() == 1 { first.name.as_str() } else { "" };
            problems.push(place.note(ProblemCode::UnreadFiles, file, fact, remedy(&unread, declared)?));
        }
        Ok(problems)
    }
}

/// Whether a file that no pattern fits is nothing to tell of.
pub(crate) fn is_housekeeping(name: &str) -> bool {
    is_hidden(name) || HOUSEKEEPING.contains(&name.rsplit('/').next().unwrap_or(name).to_lowercase().as_str())
}

/// Something lost only where a pattern asks for it.
fn not_a_file(name: &str, patterns: &Patterns, place: &Place) -> Problem {
    let fact = "neither a file nor a folder (a pipe, socket or device); it is not opened";
    let remedy = "copy the card again";
    if patterns.fits(name) {
        place.problem(ProblemCode::NotAFile, name, fact, remedy)
    } else {
        place.note(ProblemCode::NotAFile, name, fact, remedy)
    }
}

/// What probably keeps the files from being read.
fn remedy(unread: &[&CardFile], declared: &Declared<'_>) -> Result<String, PatternError> {
    let all = Patterns::any_case(declared.all)?;
    let images = Patterns::any_case(declared.images)?;
    let mut kinds: Vec<(&str, usize, &str)> = Vec::new();
    for (index, file) in unread.iter().enumerate() {
        let may_open = !declared.images.is_empty() && index < MOST_OPENED;
        let Some(kind) = kind_of(file, &all, &images, may_open) else { continue };
        match kinds.iter_mut().find(|known| known.0 == kind) {
            Some(known) => known.1 += 1,
            None => kinds.push((kind, 1, &file.name)),
        }
    }
    if kinds.is_empty() {
        return Ok("if they are recordings, add patterns to the device profile; else nothing".to_owned());
    }
    let kinds: Vec<String> = kinds.iter().map(|(kind, count, name)| format!("{count} {kind} ({name})")).collect();
    Ok(format!("add patterns to the device profile, or rename the files: {}", kinds.join("; ")))
}

fn kind_of(file: &CardFile, all: &Patterns, images: &Patterns, may_open: bool) -> Option<&'static str> {
    if all.fits(&file.name) {
        Some("with only upper and lower case unlike a pattern")
    } else if is_sibling(&file.name, images) {
        Some("with another extension of pictures than the patterns")
    } else if may_open && begins_like_picture(file) {
        Some("with the first bytes of a JPEG or PNG picture")
    } else {
        None
    }
}

/// Whether a picture's name would fit with another extension of pictures.
fn is_sibling(name: &str, images: &Patterns) -> bool {
    let Some((stem, extension)) = name.rsplit_once('.') else { return false };
    PICTURE_EXTENSIONS.contains(&extension.to_lowercase().as_str())
        && PICTURE_EXTENSIONS.iter().any(|sibling| images.fits(&format!("{stem}.{sibling}")))
}

fn begins_like_picture(file: &CardFile) -> bool {
    let mut start = Vec::new();
    let read = File::open(&file.path).and_then(|opened| opened.take(8).read_to_end(&mut start));
    read.is_ok() && image_header::encoding_of(&start).is_some()
}
