//! The folder of a report: tables, figures, and the page that shows them.

use std::path::{Path, PathBuf};

use ::report::{
    Page, Pictures, Results, figures, frames_file, read_frames, read_run_log, run_file, write_figures, write_report,
};

use crate::exit::Failure;

/// Writes the report of the results in the file `out`, and returns its page.
pub fn write(results: &Results, out: &Path, pictures: &Pictures, dir: &Path) -> Result<PathBuf, Failure> {
    let log = read_run_log(&run_file(out), &results.metadata);
    // Without a ledger that belongs to the results there are no figures of images.
    let frames = if results.flow.is_some() { read_frames(&frames_file(out))? } else { Vec::new() };
    let figures = figures(results, &frames);
    write_figures(&figures, dir)?;
    let page = Page { results, log: log.as_ref(), figures: &figures, pictures };
    Ok(write_report(&page, dir)?)
}
