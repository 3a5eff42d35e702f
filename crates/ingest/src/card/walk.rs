//! Which files are on a card.

use std::path::{Path, PathBuf};

use model::Problem;
use walkdir::{DirEntry, WalkDir};

use super::{Patterns, Place};

/// A file of a card.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CardFile {
    /// Path relative to the card, with `/`.
    pub name: String,
    /// Where it is.
    pub path: PathBuf,
    /// Its size.
    pub bytes: u64,
}

/// The files of a card, sorted by name.
#[derive(Debug, Clone)]
pub struct Card {
    /// All files, whatever they are.
    pub files: Vec<CardFile>,
    /// Links that leave the card, names that are not UTF-8, folders that cannot be read.
    pub problems: Vec<Problem>,
}

impl Card {
    /// Lists a card. Links are followed where they stay within the card.
    ///
    /// # Errors
    /// When the folder itself cannot be read.
    pub fn list(card_dir: &Path) -> std::io::Result<Self> {
        let root = card_dir.canonicalize()?;
        std::fs::read_dir(&root)?;
        let place = Place::of_card(card_dir);
        let mut card = Self { files: Vec::new(), problems: Vec::new() };
        let mut problems = Vec::new();
        let stays = |entry: &DirEntry, problems: &mut Vec<Problem>| {
            let leaves =
                entry.path_is_symlink() && entry.path().canonicalize().is_ok_and(|target| !target.starts_with(&root));
            if leaves {
                let fact = "a symbolic link that leaves the card; it is not followed";
                let name = entry.path().strip_prefix(&root).unwrap_or(entry.path()).display().to_string();
                problems.push(place.problem(
                    "link_leaves_card",
                    &name,
                    fact,
                    "copy the file itself onto the card's folder",
                ));
            }
            !leaves
        };
        let walk = WalkDir::new(&root).follow_links(true).sort_by_file_name().into_iter();
        for entry in walk.filter_entry(|entry| stays(entry, &mut problems)) {
            match entry {
                Ok(entry) if entry.file_type().is_file() => card.add(&entry, &root, &place),
                Ok(_) => {}
                Err(error) => card.problems.push(unreadable(&error, &root, &place)),
            }
        }
        card.problems.append(&mut problems);
        // Sorted by the name with '/', which is not the order of a walk: 'A.BIN' stands before 'A/1.BIN' here.
        card.files.sort_by(|a, b| a.name.cmp(&b.name));
        Ok(card)
    }

    /// The files whose names fit.
    #[must_use]
    pub fn fitting(&self, patterns: &Patterns) -> Vec<CardFile> {
        self.files.iter().filter(|file| patterns.fits(&file.name)).cloned().collect()
    }

    fn add(&mut self, entry: &DirEntry, root: &Path, place: &Place) {
        let relative = entry.path().strip_prefix(root).unwrap_or(entry.path());
        let parts: Option<Vec<&str>> = relative.iter().map(|part| part.to_str()).collect();
        let bytes = entry.metadata().map(|metadata| metadata.len());
        match (parts, bytes) {
            (Some(parts), Ok(bytes)) => {
                self.files.push(CardFile { name: parts.join("/"), path: entry.path().to_owned(), bytes });
            }
            (None, _) => {
                let name = relative.display().to_string();
                let fact = "the file's name is not UTF-8; the file is not read";
                self.problems.push(place.problem("name_not_utf8", &name, fact, "rename the file"));
            }
            (_, Err(error)) => self.problems.push(unreadable(&error, root, place)),
        }
    }
}

fn unreadable(error: &walkdir::Error, root: &Path, place: &Place) -> Problem {
    let name = error.path().map(|path| path.strip_prefix(root).unwrap_or(path).display().to_string());
    let fact = match (error.loop_ancestor(), error.io_error()) {
        (Some(_), _) => "a symbolic link to a folder that contains it; it is not followed".to_owned(),
        (None, Some(io)) => format!("cannot be read: {io}"),
        (None, None) => "cannot be read".to_owned(),
    };
    let remedy = "copy it from the card again; check its permissions; remove links that lead nowhere";
    place.problem("unreadable_file", &name.unwrap_or_default(), fact, remedy)
}
