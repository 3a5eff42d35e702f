//! Which files are on a card.

use std::path::{Path, PathBuf};

use model::{Problem, ProblemCode};
use walkdir::{DirEntry, WalkDir};

use super::names::{card_name, normalise, odd_names};
use super::{Patterns, Place};
use crate::fingerprint::FileStamp;

/// Folders that operating systems lay beside the data: what is in them is deleted, or theirs.
const SYSTEM_FOLDERS: [&str; 6] =
    ["system volume information", "$recycle.bin", ".trashes", ".trash-1000", ".spotlight-v100", ".fseventsd"];

/// A file of a card.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CardFile {
    /// Path relative to the card, with `/`; unique, and in Unicode's form C unless two would then be the same. Bytes that are not UTF-8, and control characters, are written `\xff`,
    /// a backslash in a name as `\\`.
    pub name: String,
    /// The place where it is.
    pub path: PathBuf,
    /// Its size.
    pub bytes: u64,
    /// The message of the operating system.
    pub stamp: FileStamp,
}

/// The files of a card, sorted by name.
#[derive(Debug, Clone)]
pub struct Card {
    /// All files, whatever they are.
    pub files: Vec<CardFile>,
    /// Names of what is neither a file nor a folder: sockets, pipes, devices. They are not opened.
    pub special: Vec<String>,
    /// Links that leave the card, odd names, folders that cannot be read.
    pub problems: Vec<Problem>,
}

impl Card {
    /// Lists a card. Links are followed where they stay within the card; the system's own folders are left out.
    ///
    /// # Errors
    /// When the folder itself cannot be read.
    pub fn list(card_dir: &Path) -> std::io::Result<Self> {
        let root = card_dir.canonicalize()?;
        std::fs::read_dir(&root)?;
        let place = Place::of_card(card_dir);
        let mut card = Self { files: Vec::new(), special: Vec::new(), problems: Vec::new() };
        let mut links = Vec::new();
        let stays = |entry: &DirEntry, links: &mut Vec<Problem>| {
            let leaves = leaves_card(entry, &root);
            if leaves {
                let fact = "a symbolic link that leaves the card; it is not followed";
                let remedy = "copy the file itself onto the card's folder";
                links.push(place.problem(ProblemCode::LinkLeavesCard, &name_of(entry.path(), &root), fact, remedy));
            }
            !leaves && !is_system_folder(entry)
        };
        let walk = WalkDir::new(&root).follow_links(true).sort_by_file_name().into_iter();
        for entry in walk.filter_entry(|entry| stays(entry, &mut links)) {
            match entry {
                Ok(entry) if entry.file_type().is_dir() => {}
                Ok(entry) => card.add(&entry, &root, &place),
                Err(error) => card.problems.push(unreadable(&error, &root, &place)),
            }
        }
        card.problems.append(&mut links);
        card.problems.extend(normalise(&mut card.files, &place));
        card.problems.extend(odd_names(&card.files, &place));
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
        let name = name_of(entry.path(), root);
        if !entry.file_type().is_file() {
            self.special.push(name);
            return;
        }
        match entry.metadata() {
            Ok(metadata) => {
                let (path, stamp) = (entry.path().to_owned(), FileStamp::from(&metadata));
                self.files.push(CardFile { name, path, bytes: stamp.bytes(), stamp });
            }
            Err(error) => self.problems.push(unreadable(&error, root, place)),
        }
    }
}

fn name_of(path: &Path, root: &Path) -> String {
    card_name(path.strip_prefix(root).unwrap_or(path))
}

fn leaves_card(entry: &DirEntry, root: &Path) -> bool {
    entry.path_is_symlink() && entry.path().canonicalize().is_ok_and(|target| !target.starts_with(root))
}

fn is_system_folder(entry: &DirEntry) -> bool {
    let name = entry.file_name().to_string_lossy().to_lowercase();
    entry.depth() == 1 && entry.file_type().is_dir() && SYSTEM_FOLDERS.contains(&name.as_str())
}

fn unreadable(error: &walkdir::Error, root: &Path, place: &Place) -> Problem {
    let name = error.path().map(|path| name_of(path, root));
    let fact = match (error.loop_ancestor(), error.io_error()) {
        (Some(_), _) => "a symbolic link to a folder that contains it; it is not followed".to_owned(),
        (None, Some(io)) => format!("cannot be read: {io}"),
        (None, None) => "cannot be read".to_owned(),
    };
    let remedy = "copy it from the card again; check its permissions; remove links that lead nowhere";
    place.problem(ProblemCode::UnreadableFile, &name.unwrap_or_default(), fact, remedy)
}
