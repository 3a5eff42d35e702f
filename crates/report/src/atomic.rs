//! Files that are whole or not there: written aside in the same folder, synced, then renamed.

use std::fs::File;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

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
        /// What the system said.
        source: io::Error,
    },
    /// The temporary file could not be written or synced.
    #[error("cannot write; is the disk full? The earlier file, if any, is as it was: {}", path.display())]
    Write {
        /// The target.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The temporary file could not take the target's name.
    #[error("cannot put the finished file in place; the earlier file, if any, is as it was: {}", path.display())]
    Rename {
        /// The target.
        path: PathBuf,
        /// What the system said.
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

/// A temporary file in the folder of `path`, removed if it is dropped.
pub(crate) fn temporary_beside(path: &Path) -> Result<NamedTempFile, FileError> {
    if path.is_dir() {
        return Err(FileError::Folder { path: path.to_owned() });
    }
    let mut builder = tempfile::Builder::new();
    builder.prefix(".aim-batch-").suffix(".tmp");
    #[cfg(unix)]
    {
        // tempfile's 0600 would keep results from the rest of the lab; the umask still applies to this.
        use std::os::unix::fs::PermissionsExt as _;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder(path)).map_err(|source| FileError::Create { path: path.to_owned(), source })
}

/// Makes the bytes of a temporary file durable.
pub(crate) fn sync(temporary: &NamedTempFile, path: &Path) -> Result<(), FileError> {
    temporary.as_file().sync_all().map_err(|source| FileError::Write { path: path.to_owned(), source })
}

/// Gives a synced temporary file its name.
pub(crate) fn put_in_place(temporary: NamedTempFile, path: &Path) -> Result<(), FileError> {
    let renamed = |source| FileError::Rename { path: path.to_owned(), source };
    temporary.persist(path).map_err(|error| renamed(error.error))?;
    // The name itself survives a power cut only once the folder is synced; only Unix opens folders.
    #[cfg(unix)]
    File::open(folder(path)).and_then(|folder| folder.sync_all()).map_err(renamed)?;
    Ok(())
}

/// Writes a whole file aside and renames it.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let mut temporary = temporary_beside(path)?;
    temporary.write_all(bytes).map_err(|source| FileError::Write { path: path.to_owned(), source })?;
    sync(&temporary, path)?;
    put_in_place(temporary, path)
}
