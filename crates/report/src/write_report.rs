//! A whole report into a folder: tables, figures, and the page that shows them.

use std::path::{Path, PathBuf};

use crate::atomic::{self, FileError};
use crate::figure::Figure;
use crate::page::{Page, PageError, PictureError};
use crate::write_dir::{WriteError, every_table, write_tables};

/// A report that could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// Its tables.
    #[error(transparent)]
    Tables(#[from] WriteError),
    /// The folder of its figures cannot be made.
    #[error("cannot make the folder for the figures: {}", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
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

/// Writes the tables as [`write_dir`](crate::write_dir()) does, each figure as `figures/NAME.svg`, and `index.html`. Returns
/// the page's file. The page comes last: whoever opens a new one finds what it links to.
///
/// # Errors
/// [`ReportError`].
pub fn write_report(page: &Page<'_>, dir: &Path) -> Result<PathBuf, ReportError> {
    let tables = every_table(page.results);
    write_tables(page.results, &tables, dir)?;
    write_figures(page.figures, &dir.join("figures"))?;
    page.pictures.finish()?;
    let file = dir.join("index.html");
    atomic::write(&file, page.html(&tables)?.as_bytes())?;
    Ok(file)
}

fn write_figures(figures: &[Figure], folder: &Path) -> Result<(), ReportError> {
    if figures.is_empty() {
        return Ok(());
    }
    std::fs::create_dir_all(folder).map_err(|source| ReportError::Folder { path: folder.to_owned(), source })?;
    for figure in figures {
        atomic::write(&folder.join(format!("{}.svg", figure.name)), figure.svg.as_bytes())?;
    }
    Ok(())
}
