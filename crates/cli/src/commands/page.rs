//! The folder of a report: tables, figures, pictures, and the page that shows them.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use ::report::{
    Page, Pictures, Results, figures, frames_file, read_frames, read_run_log, run_file, write_figures, write_report,
};
use pipeline::{GalleryError, GalleryHalted, GalleryOptions, Stop};

use super::tell;
use crate::exit::Failure;
use crate::progress::Bars;

/// Where a report comes from, and what making its pictures may take.
pub struct Source<'a> {
    /// The file of the results.
    pub out: &'a Path,
    /// The work folder of their run.
    pub work_dir: &'a Path,
    pub jobs: Option<NonZeroUsize>,
    pub image_memory_bytes: u64,
    pub stop: Stop,
}

/// Writes the report of `results` into `dir`, and returns its page.
pub fn write(results: &Results, source: &Source<'_>, dir: &Path, bars: &Bars) -> Result<PathBuf, Failure> {
    let log = read_run_log(&run_file(source.out), &results.metadata);
    // Without a ledger that belongs to the results there are no figures of images.
    let frames = if results.flow.is_some() { read_frames(&frames_file(source.out))? } else { Vec::new() };
    let figures = figures(results, &frames);
    write_figures(&figures, dir)?;
    let pictures = pictures(results, source, dir, bars)?;
    let page = Page { results, log: log.as_ref(), figures: &figures, pictures: &pictures };
    Ok(write_report(&page, dir)?)
}

/// Pictures with marks, from the recordings of the run. Without them the page has all but the pictures.
fn pictures(results: &Results, source: &Source<'_>, dir: &Path, bars: &Bars) -> Result<Pictures, Failure> {
    let options = GalleryOptions {
        work_dir: source.work_dir,
        sessions: &results.metadata.sessions,
        jobs: source.jobs,
        image_memory_bytes: source.image_memory_bytes,
        stop: source.stop.clone(),
    };
    let mut pictures = Pictures::new(dir);
    let progress = bars.for_run();
    let made = pipeline::gallery(&options, &progress, &mut pictures);
    drop(progress);
    match made {
        Ok(made) if made.not_shown.is_empty() => {}
        Ok(made) => tell(&format!("no picture in the report for {} images or sessions: -v says why\n", made.not_shown.len())),
        Err(GalleryError::Halted(GalleryHalted::NoWork(work_dir))) => {
            let work_dir = work_dir.display();
            tell(&format!("no pictures in the report: expected the work folder of the run, {work_dir} (--work DIR)\n"));
        }
        Err(GalleryError::Halted(error @ GalleryHalted::Stopped { signal })) => {
            return Err(Failure::Stopped(signal, error.into()));
        }
        Err(error) => return Err(error.into()),
    }
    Ok(pictures)
}
