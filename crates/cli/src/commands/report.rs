//! `report`: tables again, from the files that `run` wrote.

use std::io;

use ::report::{ReadError, Results, frames_file};

use super::{outcome, print, tables_text, tell};
use crate::args::ReportArgs;
use crate::exit::{Failure, Outcome};

/// Prints the tables, and writes them and the figures when a folder is given.
pub fn run(args: &ReportArgs) -> Result<Outcome, Failure> {
    let mut results = Results::read(&args.results)?;
    let lost = read_flow(&mut results, args)?;
    print(&tables_text(&results))?;
    if let Some(dir) = &args.out {
        ::report::write_dir(&results, dir)?;
        // Without a ledger that belongs to the results there are no figures of images.
        let frames =
            if results.flow.is_some() { ::report::read_frames(&frames_file(&args.results))? } else { Vec::new() };
        ::report::write_figures(&::report::figures(&results, &frames), dir)?;
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
