//! The folder of a report: tables, figures, and the page that shows them.

use std::path::{Path, PathBuf};

use ::report::{Figure, Page, Pictures, Results, read_run_log, run_file, write_report};

use crate::exit::Failure;

/// Writes the report of the results in the file `out`, and returns its page.
pub fn write(results: &Results, out: &Path, pictures: &Pictures, dir: &Path) -> Result<PathBuf, Failure> {
    let log = read_run_log(&run_file(out), &results.metadata);
    let figures: Vec<Figure> = Vec::new();
    let page = Page { results, log: log.as_ref(), figures: &figures, pictures };
    Ok(write_report(&page, dir)?)
}
