//! `report`: tables again, from the results alone.

use super::{print, tables_text};
use crate::args::ReportArgs;
use crate::exit::{Failure, Outcome};

/// Prints the tables, and writes them when a folder is given.
pub fn run(args: &ReportArgs) -> Result<Outcome, Failure> {
    let results = ::report::Results::read(&args.results)?;
    print(&tables_text(&results))?;
    if let Some(dir) = &args.out {
        ::report::write_dir(&results, dir)?;
    }
    Ok(Outcome::Well)
}
