//! `report`: makes tables and page again, from the files that `run` wrote.

use std::io;
use std::path::PathBuf;

use ::report::{ReadError, Results, frames_file};

use super::{outcome, page, print, print_message, stop_on_signals, tables_text};
use crate::exit::{Failure, Outcome};
use crate::progress::Bars;

/// The arguments of `report`.
#[derive(Debug, clap::Args)]
pub struct ReportArgs {
    /// results.parquet of a run; the ledger of images, frames.parquet, is looked for beside it
    pub results: PathBuf,
    /// Folder for the report: index.html, and the tables as CSV, Markdown and LaTeX; without it they are only printed
    #[arg(short, long)]
    pub out: Option<PathBuf>,
    /// Work folder of the run, whose recordings hold the pictures; default: the name of the results with .work
    #[arg(long, value_name = "DIR", env = "AIM_BATCH_WORK")]
    pub work: Option<PathBuf>,
}

/// Upper bound of the decoded pictures that are in memory at once: the default of `run --memory`.
const PICTURE_MEMORY_BYTES: u64 = 256 << 20;

/// Prints the tables, and writes the report where a folder is given.
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
        print_message(&format!("wrote {}\n", written.page.display()));
    }
    Ok(outcome(lost))
}

/// Adds the flow of images to the results, and returns whether it is lost: the ledger is there but cannot be used. The other
/// tables do not need it.
fn read_flow(results: &mut Results, args: &ReportArgs) -> io::Result<bool> {
    let frames = frames_file(&args.results);
    match results.read_flow(&frames) {
        Ok(()) => Ok(false),
        Err(ReadError::Open { source, .. }) if source.kind() == io::ErrorKind::NotFound => {
            print_message(&format!(
                "no flow of images: expected the ledger beside the results, {}\n",
                frames.display()
            ));
            Ok(false)
        }
        Err(error) => {
            print_message(&format!("no flow of images: {error}\n"));
            Ok(true)
        }
    }
}
