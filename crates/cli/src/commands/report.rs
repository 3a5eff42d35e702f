//! `report`: tables and page again, from the files that `run` wrote.

use std::io;

use ::report::{Pictures, ReadError, Results, frames_file};

use super::{outcome, page, print, tables_text, tell};
use crate::args::ReportArgs;
use crate::exit::{Failure, Outcome};

/// Prints the tables, and writes the report when a folder is given.
pub fn run(args: &ReportArgs) -> Result<Outcome, Failure> {
    let mut results = Results::read(&args.results)?;
    let lost = read_flow(&mut results, args)?;
    print(&tables_text(&results))?;
    if let Some(dir) = &args.out {
        let page = page::write(&results, &args.results, &Pictures::new(dir), dir)?;
        tell(&format!("wrote {}\n", page.display()));
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
