//! Writes files that are either whole or not there: a file is written aside in the same folder, synced, and then renamed.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

/// A file that could not be written.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// The target is a folder.
    #[error("expected the name of a file, got a folder; name a file inside it: {}", path.display())]
    Folder {
        /// The target.
        path: PathBuf,
    },
    /// No temporary file could be made beside it.
    #[error("cannot make a temporary file beside the target; its folder must exist and be writable: {}", path.display())]
    Create {
        /// The target.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
    /// Another process is writing the same file.
    #[error("another process is writing this file; wait for it to end, or name another: {}", path.display())]
    Busy {
        /// The target.
        path: PathBuf,
    },
    /// The temporary file could not be written or synced.
    #[error("cannot write; is the disk full? The earlier file, if any, is as it was: {}", path.display())]
    Write {
        /// The target.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
    /// The temporary file could not take the target's name.
    #[error("cannot put the finished file in place; the earlier file, if any, is as it was: {}", path.display())]
    Rename {
        /// The target.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
}

/// The folder that `path` lies in.
fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// Refuses a target that can never take a file's bytes, because it is a folder.
pub(crate) fn check(target: &Path) -> Result<(), FileError> {
    if target.is_dir() { Err(FileError::Folder { path: target.to_owned() }) } else { Ok(()) }
}

/// A file under construction beside its target, `.NAME.aim-batch-part`. It is removed when it is dropped before it was put in
/// place. One that a killed process left is used again, so that none pile up. It is locked, and the system drops the lock with
/// the process.
pub(crate) struct Aside {
    file: File,
    path: PathBuf,
    target: PathBuf,
    is_placed: bool,
}

impl Aside {
    /// Opens and locks an empty file beside the target. Fails where the target is a folder, its folder cannot be written, or
    /// another process is writing the same target.
    pub(crate) fn create(target: &Path) -> Result<Self, FileError> {
        check(target)?;
        let name = target.file_name().unwrap_or_default().to_string_lossy();
        let path = folder(target).join(format!(".{name}.aim-batch-part"));
        let refuse = |source| FileError::Create { path: target.to_owned(), source };
        let file = loop {
            let file = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(&path);
            let file = file.map_err(refuse)?;
            match file.try_lock() {
                Err(TryLockError::WouldBlock) => return Err(FileError::Busy { path: target.to_owned() }),
                Err(TryLockError::Error(error)) if error.kind() != io::ErrorKind::Unsupported => {
                    return Err(refuse(error));
                }
                _ => {}
            }
            if is_still_at(&file, &path) {
                break file;
            }
        };
        file.set_len(0).map_err(refuse)?;
        Ok(Self { file, path, target: target.to_owned(), is_placed: false })
    }

    pub(crate) fn file(&self) -> &File {
        &self.file
    }

    /// Makes the bytes durable (fsync).
    pub(crate) fn sync(&self) -> Result<(), FileError> {
        self.file.sync_all().map_err(|source| FileError::Write { path: self.target.clone(), source })
    }

    /// Gives a synced file the name of its target, in place of an earlier file of that name.
    pub(crate) fn put_in_place(mut self) -> Result<(), FileError> {
        let renamed = |source| FileError::Rename { path: self.target.clone(), source };
        std::fs::rename(&self.path, &self.target).map_err(renamed)?;
        self.is_placed = true;
        // The name itself survives a power cut only once the folder is synced, and only Unix can open folders.
        #[cfg(unix)]
        File::open(folder(&self.target)).and_then(|folder| folder.sync_all()).map_err(renamed)?;
        Ok(())
    }
}

impl Drop for Aside {
    fn drop(&mut self) {
        if !self.is_placed {
            let _ = std::fs::remove_file(&self.path); // nothing is left to be done where it stays
        }
    }
}

/// Whether the file that was locked still has that name: its last holder may have put it in place in between.
#[cfg(unix)]
fn is_still_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    let numbers = |metadata: std::fs::Metadata| (metadata.dev(), metadata.ino());
    let (locked, named) = (file.metadata().map(numbers).ok(), std::fs::metadata(path).map(numbers).ok());
    locked.is_some() && locked == named
}

#[cfg(not(unix))]
fn is_still_at(_file: &File, _path: &Path) -> bool {
    true // an open file cannot be renamed there
}

/// Writes a whole file aside, makes it durable, and renames it.
///
/// # Errors
/// [`FileError`]; an earlier file of that name is then unchanged.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let aside = Aside::create(path)?;
    aside.file().write_all(bytes).map_err(|source| FileError::Write { path: path.to_owned(), source })?;
    aside.sync()?;
    aside.put_in_place()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use super::*;

    #[test]
    fn what_a_killed_process_left_is_used_again_and_gone_in_the_end() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.csv");
        std::fs::write(dir.path().join(".a.csv.aim-batch-part"), b"half of something longer").unwrap();
        write(&path, b"whole").unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"whole");
        assert_eq!(std::fs::read_dir(dir.path()).unwrap().count(), 1);
    }

    #[test]
    fn two_at_a_time_are_refused_and_the_earlier_file_stays() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.csv");
        std::fs::write(&path, b"earlier").unwrap();
        let first = Aside::create(&path).unwrap();
        assert!(matches!(Aside::create(&path), Err(FileError::Busy { .. })));
        drop(first);
        assert_eq!(std::fs::read(&path).unwrap(), b"earlier");
        assert_eq!(std::fs::read_dir(dir.path()).unwrap().count(), 1);
    }
}
