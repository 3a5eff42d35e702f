//! The folder of a report: tables, figures, pictures, and the page that shows them.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use ::report::{
    Page, Pictures, Results, figures, frames_file, read_frames, read_run_log, run_file, write_figures, write_report,
};
use pipeline::{GalleryOptions, Stop};

use super::gallery::gallery_into;
use crate::exit::Failure;
use crate::progress::Bars;

/// Where a report comes from.
pub struct Source<'a> {
    /// The file of the results.
    pub out: &'a Path,
    /// The work folder of their run, whose recordings hold the pictures.
    pub work_dir: &'a Path,
    /// Pictures at a time; none for the cores that this process may use.
    pub jobs: Option<NonZeroUsize>,
    /// Bound of the decoded pictures in memory at once.
    pub image_memory_bytes: u64,
    pub stop: Stop,
}

/// What was written.
pub struct Written {
    pub page: PathBuf,
    /// Whether pictures are missing that should be there; which, has been told.
    pub lost: bool,
}

/// Writes the report of `results` into `dir`.
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
