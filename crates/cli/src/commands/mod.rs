//! The commands: one module for each, with its arguments, and the parts that several of them share.

pub mod calibrate;
pub mod check;
mod gallery;
pub mod ingest;
pub mod inspect;
pub mod marks;
pub mod measure;
mod page;
mod place;
mod problems;
pub mod project;
pub mod report;
pub mod run;
mod settings;
pub mod simulate;
pub mod status;
mod summary;
mod view;

use std::io::{self, Write};

use anyhow::Context as _;
use pipeline::{Stop, SurveyError};

use crate::exit::{Failure, Outcome};
use crate::signals;

/// Name and version of the program, for the provenance of results.
pub const PROGRAM: &str = concat!("aim-batch ", env!("CARGO_PKG_VERSION"));
/// The commit that the program was built from, where git knew it.
pub const COMMIT: Option<&str> = option_env!("AIM_BATCH_COMMIT");

/// Writes results to stdout. A reader that has gone (`aim-batch ... | head`) does not stop the work that is left.
fn print(text: &str) -> io::Result<()> {
    match io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        written => written,
    }
}

/// Writes a message for the user to stderr. A stderr that is closed or full changes neither the work nor the exit code, since
/// there is nowhere to complain.
fn print_message(text: &str) {
    let _ = io::stderr().write_all(text.as_bytes());
}

/// The tables of a run as text, as wide as the terminal where stdout is one: the tables that the study asks for (the sizes
/// where it asks for none), the errors by pitch and by height, and the flow of images, as tables and as bars.
fn tables_text(results: &::report::Results) -> String {
    let mut tables = ::report::tables(results);
    if tables.is_empty() {
        tables.push(::report::sizes(results));
    }
    let by_band = [::report::error_by_pitch(results), ::report::error_by_height(results)];
    tables.extend(by_band.into_iter().filter(|table| !table.rows.is_empty()));
    tables.extend(flow_tables(results));
    let bars = ::report::flow_bars(results, terminal_width()).map(|bars| format!("\n{bars}"));
    as_wide_as_the_terminal(&tables) + &bars.unwrap_or_default()
}

/// The tables of the flow of images: the steps, and the reasons for which images are left out.
fn flow_tables(results: &::report::Results) -> impl Iterator<Item = ::report::Table> {
    [::report::flow_in_short(results), ::report::left_out(results)].into_iter().flatten()
}

fn as_wide_as_the_terminal(tables: &[::report::Table]) -> String {
    ::report::terminal_set(tables, terminal_width())
}

/// Width of stdout in columns, where it is a terminal.
fn terminal_width() -> Option<usize> {
    terminal_size::terminal_size_of(io::stdout()).map(|(width, _)| usize::from(width.0))
}

/// A flag that SIGINT and SIGTERM set from now on. Fails where the system refuses the handlers.
fn stop_on_signals() -> Result<Stop, Failure> {
    let stop = Stop::default();
    signals::watch(&stop).context("cannot listen for signals")?;
    Ok(stop)
}

/// The failure that stands for a survey's error: a signal, or any other one.
fn survey_failure(error: SurveyError) -> Failure {
    match error {
        SurveyError::Stopped { signal } => Failure::Stopped(signal, error.into()),
        other => other.into(),
    }
}

/// The outcome of a command that finished and may have lost something.
fn outcome(lost: bool) -> Outcome {
    if lost { Outcome::WithLosses } else { Outcome::Well }
}
