//! Writes a whole report into a folder: the tables, and the page that shows them with figures and pictures.

use std::path::{Path, PathBuf};

use crate::atomic::{self, FileError};
use crate::page::{Page, PageError, PictureError};
use crate::write_dir::{WriteError, every_table, write_tables};

/// Why a report could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// Its tables could not be written.
    #[error(transparent)]
    Tables(#[from] WriteError),
    /// Its page could not be made.
    #[error(transparent)]
    Page(#[from] PageError),
    /// Its pictures could not be written.
    #[error(transparent)]
    Pictures(#[from] PictureError),
    /// Its page could not be written.
    #[error(transparent)]
    File(#[from] FileError),
}

/// Writes the tables as [`write_dir`](crate::write_dir()) does, and then `index.html`. Returns the path of the page. The page is
/// written last, so that all that a new page links to is there. It links each figure to `figures/NAME.svg`, which the caller
/// writes.
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
