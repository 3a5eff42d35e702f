//! A whole report into a folder: tables, and the page that shows them with figures and pictures.

use std::path::{Path, PathBuf};

use crate::atomic::{self, FileError};
use crate::page::{Page, PageError, PictureError};
use crate::write_dir::{WriteError, every_table, write_tables};

/// A report that could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// Its tables.
    #[error(transparent)]
    Tables(#[from] WriteError),
    /// Its page.
    #[error(transparent)]
    Page(#[from] PageError),
    /// Its pictures.
    #[error(transparent)]
    Pictures(#[from] PictureError),
    /// One of its files.
    #[error(transparent)]
    File(#[from] FileError),
}

/// Writes the tables as [`write_dir`](crate::write_dir()) does, and `index.html`. Returns the page's file. The page comes last:
/// whoever opens a new one finds what it links to. It links each figure to `figures/NAME.svg`, which is the caller's to write.
///
/// # Errors
/// [`ReportError`].
pub fn write_report(page: &Page<'_>, dir: &Path) -> Result<PathBuf, ReportError> {
    let tables = every_table(page.results);
    write_tables(page.results, &tables, dir)?;
    page.pictures.finish()?;
    let file = dir.join("index.html");
    atomic::write(&file, page.html(&tables)?.as_bytes())?;
    Ok(file)
}
