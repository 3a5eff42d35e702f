//! Writes the folder of a report: tables, figures, pictures, and the page that shows them.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use ::report::{
    Page, Pictures, Results, figures, frames_file, read_frames, read_run_log, run_file, write_figures, write_report,
};
use pipeline::{GalleryOptions, Stop};

use super::gallery::gallery_into;
use crate::exit::Failure;
use crate::progress::Bars;

/// The files that a report is made from, and the limits of the work on it.
pub struct Source<'a> {
    /// The file of the results.
    pub out: &'a Path,
    /// The work folder of their run, whose recordings hold the pictures.
    pub work_dir: &'a Path,
    /// Number of pictures that are worked on at a time; none for the number of cores that this process may use.
    pub jobs: Option<NonZeroUsize>,
    /// Upper bound of the decoded pictures that are in memory at once, in bytes.
    pub image_memory_bytes: u64,
    pub stop: Stop,
}

/// A report that was written.
pub struct Written {
    pub page: PathBuf,
    /// Whether pictures are missing that should be there. Messages have said which.
    pub lost: bool,
}

/// Writes the report of `results` into `dir`, which need not exist. Fails where a file cannot be read or written, or a signal
/// came.
pub fn write(results: &Results, source: Source<'_>, dir: &Path, bars: &Bars) -> Result<Written, Failure> {
    let log = read_run_log(&run_file(source.out), &results.metadata);
    // Without a ledger that belongs to the results there are no figures of images.
    let frames = if results.flow.is_some() { read_frames(&frames_file(source.out))? } else { Vec::new() };
    let figures = figures(results, &frames)?;
    write_figures(&figures, dir)?;
    let mut pictures = Pictures::new(dir);
    let progress = bars.for_run();
    let options = GalleryOptions {
        work_dir: source.work_dir,
        sessions: &results.metadata.sessions,
        jobs: source.jobs,
        image_memory_bytes: source.image_memory_bytes,
        stop: source.stop,
    };
    let lost = gallery_into(&options, &progress, &mut pictures)?;
    drop(progress);
    let page = Page { results, log: log.as_ref(), figures: &figures, pictures: &pictures };
    Ok(Written { page: write_report(&page, dir)?, lost })
}
