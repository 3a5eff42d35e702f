//! The files of pictures below the folder of a report, and the list of them.

use std::collections::BTreeSet;
use std::io;
use std::path::{Component, Path, PathBuf};

use super::PictureError;

/// The list of the files that a report has written, one per line. The next report in the same folder removes those that it does
/// not have.
const LIST: &str = "pictures/files.txt";

/// A report's folder, into which pictures are written.
#[derive(Debug)]
pub(super) struct Store {
    report: PathBuf,
}

impl Store {
    pub(super) fn new(report: &Path) -> Self {
        Self { report: report.to_owned() }
    }

    /// Writes a file. It is not synced, as results are, because it can be made again, and the page that shows it is written after
    /// it.
    pub(super) fn write(&self, file: &str, bytes: &[u8]) -> Result<(), PictureError> {
        let path = self.report.join(file);
        let wrap = |source| PictureError::Write { path: path.clone(), source };
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).map_err(wrap)?;
        }
        std::fs::write(&path, bytes).map_err(wrap)
    }

    /// Removes the files that an earlier report wrote and this one did not, and lists those of this one.
    pub(super) fn finish<'a>(&self, files: impl Iterator<Item = &'a str>) -> Result<(), PictureError> {
        let files: BTreeSet<&str> = files.collect();
        let list = self.report.join(LIST);
        let earlier = match std::fs::read_to_string(&list) {
            Ok(text) => text,
            Err(error) if error.kind() == io::ErrorKind::NotFound => String::new(),
            Err(source) => return Err(PictureError::Write { path: list, source }),
        };
        for file in earlier.lines().filter(|file| !files.contains(file) && is_ours(file)) {
            self.remove(file)?;
        }
        if files.is_empty() {
            return if earlier.is_empty() { Ok(()) } else { self.remove(LIST) };
        }
        let text: String = files.iter().map(|file| format!("{file}\n")).collect();
        self.write(LIST, text.as_bytes())
    }

    /// Removes a file, and its folder where the file was the last in it.
    fn remove(&self, file: &str) -> Result<(), PictureError> {
        let path = self.report.join(file);
        match std::fs::remove_file(&path) {
            Err(source) if source.kind() != io::ErrorKind::NotFound => Err(PictureError::Write { path, source }),
            _ => {
                if let Some(folder) = path.parent() {
                    let _ = std::fs::remove_dir(folder); // refused while something else lies there
                }
                Ok(())
            }
        }
    }
}

/// Whether a path of the list is a picture below `pictures/`. A list that somebody has changed must not cause other files to be
/// removed.
fn is_ours(file: &str) -> bool {
    let path = Path::new(file);
    let plain = path.components().all(|part| matches!(part, Component::Normal(_)));
    plain && path.starts_with("pictures") && path.extension().is_some_and(|extension| extension == "jpg")
}
