//! Errors of a work folder.

use std::path::PathBuf;

/// The error of a work folder that cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum WorkError {
    /// The folder cannot be made.
    #[error("cannot make the work folder: {source}; --work names another: {}", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// The error of the system.
        source: std::io::Error,
    },
    /// A file there cannot be removed or renamed.
    #[error("cannot remove or rename a file of the work folder: {source}; check permissions: {}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// The error of the system.
        source: std::io::Error,
    },
    /// Another run is at work there.
    #[error("another run is at work in this folder: {holder}; wait for it to end, or give --work another folder: {}", path.display())]
    Held {
        /// The lock.
        path: PathBuf,
        /// The holder, in its own words.
        holder: String,
    },
    /// The lock cannot be made.
    #[error("cannot lock the work folder: {source}; check permissions, or give --work another folder: {}", path.display())]
    Lock {
        /// The lock.
        path: PathBuf,
        /// The error of the system.
        source: std::io::Error,
    },
    /// The state is of a newer version of the program.
    #[error("the work folder is of a newer version of this program (state version {got}, expected {expected}); update, or give --work another folder: {}", path.display())]
    Newer {
        /// The state file.
        path: PathBuf,
        /// The version that this program writes.
        expected: i64,
        /// The version of the file.
        got: i64,
    },
    /// The state file is not a state, and a new one cannot be made either.
    #[error("{why}; remove it, or give --work another folder: {}", path.display())]
    Unusable {
        /// The state file.
        path: PathBuf,
        /// The fault of the file.
        why: String,
    },
    /// The state file cannot be read or written.
    #[error("cannot use the state of the work folder: {source}; check free space and permissions, or give --work another folder: {}", path.display())]
    State {
        /// The state file.
        path: PathBuf,
        /// The error of SQLite.
        source: rusqlite::Error,
    },
    /// The output of a stage cannot be written as JSON: a defect of the program.
    #[error("cannot keep what a stage gave: {0}; please report this as a bug")]
    Text(#[from] serde_json::Error),
}
