//! `report`: tables and page again, from the files that `run` wrote.

use std::io;

use ::report::{ReadError, Results, frames_file};

use super::{outcome, page, print, stop_on_signals, tables_text, tell};
use crate::args::ReportArgs;
use crate::exit::{Failure, Outcome};
use crate::progress::Bars;

/// Decoded pictures in memory at once: what `run --memory` is by default.
const PICTURE_MEMORY_BYTES: u64 = 256 << 20;

/// Prints the tables, and writes the report when a folder is given.
pub fn run(args: &ReportArgs, bars: &Bars) -> Result<Outcome, Failure> {
    let mut results = Results::read(&args.results)?;
    let mut lost = read_flow(&mut results, args)?;
    print(&tables_text(&results))?;
    if let Some(dir) = &args.out {
        let work_dir = args.work.clone().unwrap_or_else(|| args.results.with_extension("work"));
        let stop = stop_on_signals()?;
        let source = page::Source {
            out: &args.results,
            work_dir: &work_dir,
            jobs: None,
            image_memory_bytes: PICTURE_MEMORY_BYTES,
            stop,
        };
        let written = page::write(&results, source, dir, bars)?;
        lost |= written.lost;
        tell(&format!("wrote {}\n", written.page.display()));
    }
    Ok(outcome(lost))
}

/// Whether the images could not be counted although their ledger is there. The other tables do not need it.
fn read_flow(results: &mut Results, args: &ReportArgs) -> io::Result<bool> {
    let frames = frames_file(&args.results);
    match results.read_flow(&frames) {
        Ok(()) => Ok(false),
        Err(ReadError::Open { source, .. }) if source.kind() == io::ErrorKind::NotFound => {
            tell(&format!("no flow of images: expected the ledger beside the results, {}\n", frames.display()));
            Ok(false)
        }
        Err(error) => {
            tell(&format!("no flow of images: {error}\n"));
            Ok(true)
        }
    }
}
