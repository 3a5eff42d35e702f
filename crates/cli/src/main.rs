//! `aim-batch`: measures plates and bowls in recordings of a camera worn on eyeglasses.
//!
//! This crate holds arguments, progress, logs and exit codes, and nothing else. Results go to stdout, diagnostics to stderr.

mod args;
mod commands;
mod exit;
mod logging;
mod progress;
mod signals;
#[cfg(test)]
mod tests;

use std::process::ExitCode;

use clap::Parser;

use args::{Args, Command};

fn main() -> ExitCode {
    let args = Args::parse();
    let bars = progress::Bars::new(args.quiet);
    logging::start(args.verbose, args.log_format, &bars);
    let outcome = match &args.command {
        Command::Run(run) => commands::run::run(run, args.log_format, &bars),
        Command::Calibrate(calibrate) => commands::calibrate::run(calibrate, &bars),
        Command::Status(status) => commands::status::run(status),
        Command::Check(check) => commands::check::run(check, &bars),
        Command::Inspect(inspect) => commands::inspect::run(inspect, &bars),
        Command::Marks(marks) => commands::marks::run(&marks.way),
        Command::Ingest(ingest) => commands::ingest::run(ingest, &bars),
        Command::Report(report) => commands::report::run(report, &bars),
        Command::Project(project) => commands::project::run(project),
        Command::Measure(measure) => commands::measure::run(measure),
        Command::Simulate(simulate) => commands::simulate::run(simulate, &bars),
    };
    exit::finish(outcome)
}
