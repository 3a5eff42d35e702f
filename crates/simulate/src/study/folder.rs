//! The folder that a study is written into.

use std::fs;
use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::error::SimulateError;

/// The folder of a new study.
#[derive(Debug, Clone)]
pub struct StudyFolder {
    root: PathBuf,
}

impl StudyFolder {
    /// The folder `root`, which does not exist yet (and is then made) or is empty.
    ///
    /// # Errors
    /// [`SimulateError::NotEmpty`], or [`SimulateError::Io`] when the folder cannot be made or listed.
    pub fn create(root: &Path) -> Result<Self, SimulateError> {
        fs::create_dir_all(root).map_err(|source| io_error("create the folder", root, source))?;
        let mut entries = fs::read_dir(root).map_err(|source| io_error("list the folder", root, source))?;
        if entries.next().is_some() {
            return Err(SimulateError::NotEmpty { path: root.to_owned() });
        }
        Ok(Self { root: root.to_owned() })
    }

    /// Makes a folder, and those above it. `relative` has forward slashes.
    ///
    /// # Errors
    /// [`SimulateError::Io`].
    pub fn make_folder(&self, relative: &str) -> Result<(), SimulateError> {
        let path = self.root.join(relative);
        fs::create_dir_all(&path).map_err(|source| io_error("create the folder", &path, source))
    }

    /// Writes a file, and makes the folders above it. `relative` has forward slashes.
    ///
    /// # Errors
    /// [`SimulateError::Io`].
    pub fn write(&self, relative: &str, bytes: &[u8]) -> Result<(), SimulateError> {
        let path = self.root.join(relative);
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).map_err(|source| io_error("create the folder", parent, source))?;
        }
        fs::write(&path, bytes).map_err(|source| io_error("write", &path, source))
    }

    /// Writes rows as a CSV file with a header.
    ///
    /// # Errors
    /// [`SimulateError::Csv`] and [`SimulateError::Io`].
    pub fn write_csv<T: Serialize>(&self, relative: &str, rows: &[T]) -> Result<(), SimulateError> {
        let bytes = csv_bytes(rows).map_err(|source| SimulateError::Csv { name: relative.to_owned(), source })?;
        self.write(relative, &bytes)
    }
}

fn io_error(action: &'static str, path: &Path, source: std::io::Error) -> SimulateError {
    SimulateError::Io { action, path: path.to_owned(), source }
}

/// The rows as CSV, with a header of the names of their fields, and lines that end in a line feed.
fn csv_bytes<T: Serialize>(rows: &[T]) -> Result<Vec<u8>, csv::Error> {
    let mut bytes = Vec::new();
    {
        let mut writer = csv::Writer::from_writer(&mut bytes);
        for row in rows {
            writer.serialize(row)?;
        }
        writer.flush()?;
    }
    Ok(bytes)
}
