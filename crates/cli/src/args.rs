//! The command line as a whole. The arguments of a command stand beside the command, in `commands`.

use clap::{Parser, Subcommand};

use crate::commands::calibrate::CalibrateArgs;
use crate::commands::check::CheckArgs;
use crate::commands::ingest::IngestArgs;
use crate::commands::inspect::InspectArgs;
use crate::commands::marks::MarksArgs;
use crate::commands::measure::MeasureArgs;
use crate::commands::project::ProjectArgs;
use crate::commands::report::ReportArgs;
use crate::commands::run::RunArgs;
use crate::commands::simulate::SimulateArgs;
use crate::commands::status::StatusArgs;
use crate::logging::LogFormat;

/// Measures plates and bowls in recordings of a camera worn on eyeglasses.
///
/// Exit codes: 0 all well, 1 failed, 2 usage or configuration, 3 finished but some data was lost (the messages say which
/// and why), 130 and 143 stopped by SIGINT and SIGTERM.
#[derive(Debug, Parser)]
#[command(name = "aim-batch", version, propagate_version = true)]
pub struct Args {
    /// The command to carry out
    #[command(subcommand)]
    pub command: Command,
    /// Say more: -v every problem and what each session does, -vv debugging
    #[arg(short, long, action = clap::ArgAction::Count, global = true, help_heading = "Messages")]
    pub verbose: u8,
    /// Form of the log on stderr
    #[arg(long, value_enum, default_value_t = LogFormat::Text, global = true, env = "AIM_BATCH_LOG_FORMAT", help_heading = "Messages")]
    pub log_format: LogFormat,
    /// Show no progress: no bars on a terminal, no lines elsewhere
    #[arg(short, long, global = true, help_heading = "Messages")]
    pub quiet: bool,
}

/// The commands. `aim-batch --help` shows the line above each.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// The main job: ingest what is new, select, measure, write results, print tables
    #[command(allow_negative_numbers = true)]
    Run(RunArgs),
    /// Show what a run has done, and what another would do
    #[command(allow_negative_numbers = true)]
    Status(StatusArgs),
    /// Before a run: show everything that would fail or be dropped, with remedies
    #[command(allow_negative_numbers = true)]
    Check(CheckArgs),
    /// Show what is in a recording: channels, rates, gaps, clocks, pitch, range, images
    Inspect(InspectArgs),
    /// Learn the corrections of a device from a bench with known sizes: calibration.toml, for run --calibration
    Calibrate(CalibrateArgs),
    /// Take marks from other annotation tools, or give them to those: CVAT, COCO
    Marks(MarksArgs),
    /// Make one MCAP file from one SD card
    Ingest(IngestArgs),
    /// Print the tables again, from the files that run wrote
    Report(ReportArgs),
    /// Turn pixels into points on a level plane (CSV on stdin and stdout), or back
    #[command(allow_negative_numbers = true)]
    Project(ProjectArgs),
    /// Measure what is marked, or found, in one picture, without a study
    #[command(allow_negative_numbers = true)]
    Measure(MeasureArgs),
    /// Make a study with known truth
    Simulate(SimulateArgs),
}
