//! The command line.

mod marks;
mod picture;
mod simulate;

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Parser, Subcommand};
use model::Method;
use rims::RimShape;
use pipeline::study::MarksSource;

use crate::logging::LogFormat;
pub use marks::{MarksArgs, MarksExportArgs, MarksFormat, MarksImportArgs, MarksWay};
pub use picture::{MeasureArgs, PoseArgs, ProjectArgs};
pub use simulate::{LargeArgs, Made, Preset, SimulateArgs};

/// Measures plates and bowls in recordings of a camera worn on eyeglasses.
///
/// Exit codes: 0 all well, 1 failed, 2 usage or configuration, 3 finished but some data was lost (the messages say which
/// and why), 130 and 143 stopped by SIGINT and SIGTERM.
#[derive(Debug, Parser)]
#[command(name = "aim-batch", version, propagate_version = true)]
pub struct Args {
    /// What to do
    #[command(subcommand)]
    pub command: Command,
    /// Say more: -v every problem and what each session does, -vv debugging
    #[arg(short, long, action = clap::ArgAction::Count, global = true, help_heading = "Messages")]
    pub verbose: u8,
    /// Form of the log on stderr
    #[arg(long, value_enum, default_value_t = LogFormat::Text, global = true, env = "AIM_BATCH_LOG_FORMAT", help_heading = "Messages")]
    pub log_format: LogFormat,
    /// No progress: no bars on a terminal, no lines elsewhere
    #[arg(short, long, global = true, help_heading = "Messages")]
    pub quiet: bool,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// The main job: ingest what is new, select, measure, write results, print tables
    #[command(allow_negative_numbers = true)]
    Run(RunArgs),
    /// What a run has done, and what it would do
    #[command(allow_negative_numbers = true)]
    Status(StatusArgs),
    /// Before a run: everything that would fail or be dropped, with remedies
    #[command(allow_negative_numbers = true)]
    Check(CheckArgs),
    /// What is in a recording: channels, rates, gaps, clocks, pitch, range, images
    Inspect(InspectArgs),
    /// What a bench with known sizes tells of a device: calibration.toml, for run --calibration
    Calibrate(CalibrateArgs),
    /// Marks from and to other annotation tools: CVAT, COCO
    Marks(MarksArgs),
    /// One SD card to one MCAP file
    Ingest(IngestArgs),
    /// Tables again, from the files that run wrote
    Report(ReportArgs),
    /// Pixels to points on a level plane (CSV on stdin and stdout), or back
    #[command(allow_negative_numbers = true)]
    Project(ProjectArgs),
    /// Sizes of what is marked in one picture, without a study
    #[command(allow_negative_numbers = true)]
    Measure(MeasureArgs),
    /// A study with known truth
    Simulate(SimulateArgs),
}

/// `run`.
#[derive(Debug, clap::Args)]
pub struct RunArgs {
    /// Folder of the study (docs/study.md)
    pub study: PathBuf,
    /// Where results go, and what is kept between runs
    #[command(flatten)]
    pub place: PlaceArgs,
    /// Sessions at a time; default: the cores that this process may use (affinity, control group, SLURM_CPUS_PER_TASK)
    #[arg(short, long, env = "AIM_BATCH_JOBS")]
    pub jobs: Option<NonZeroUsize>,
    /// Bound of all pictures in memory at once, such as 512M or 2G; one is always let through
    #[arg(long, env = "AIM_BATCH_MEMORY", value_name = "SIZE", default_value = "256M", value_parser = bytes)]
    pub memory: u64,
    /// Do everything again, changed or not
    #[arg(long)]
    pub force: bool,
    /// Stop at the first session that fails; what was done is kept, and no results are written
    #[arg(long)]
    pub fail_fast: bool,
    /// Delete from the work folder what belongs to sessions that the study no longer has
    #[arg(long)]
    pub prune: bool,
    /// Also write the rims that were found as LabelMe files, DIR/auto/SESSION/IMAGE.json, to check and correct; files that are
    /// there stay as they are
    #[arg(long, value_name = "DIR")]
    pub write_marks: Option<PathBuf>,
    /// Also write recordings with marks, sizes and signals for Foxglove and Rerun (docs/viewers.md):
    /// WORK/annotated/SESSION.annotated.mcap
    #[arg(long)]
    pub annotate: bool,
    /// Also write the report to this folder: index.html, and the tables as CSV, Markdown and LaTeX
    #[arg(long, env = "AIM_BATCH_REPORT")]
    pub report: Option<PathBuf>,
    /// Settings in place of study.toml's
    #[command(flatten)]
    pub settings: SettingsArgs,
    /// Compare the tables with those in this folder, and fail where they differ
    #[arg(long, value_name = "DIR")]
    pub expect: Option<PathBuf>,
    /// Largest difference allowed by --expect: percentage points of an error, per cent of a size
    #[arg(long, value_name = "PCT", default_value_t = 0.15, requires = "expect")]
    pub tolerance: f64,
}

/// Where results go.
#[derive(Debug, clap::Args)]
pub struct PlaceArgs {
    /// File for the sizes, X.parquet; beside it are written the ledger of images, X.frames.parquet, and where all came from,
    /// X.run.json (frames.parquet and run.json for results.parquet)
    #[arg(short, long, env = "AIM_BATCH_OUT", default_value = "results.parquet")]
    pub out: PathBuf,
    /// Folder for what can be made anew (recordings as MCAP files, and the state of every session), and may be deleted;
    /// default: X.work beside the output
    #[arg(long, env = "AIM_BATCH_WORK")]
    pub work: Option<PathBuf>,
}

impl PlaceArgs {
    /// The work folder.
    pub fn work_dir(&self) -> PathBuf {
        self.work.clone().unwrap_or_else(|| self.out.with_extension("work"))
    }
}

/// A size in bytes, with K, M, G or T for powers of 1024.
fn bytes(text: &str) -> Result<u64, String> {
    let text = text.trim();
    let digits = text.trim_end_matches(|c: char| !c.is_ascii_digit());
    let power = match text[digits.len()..].trim().to_ascii_uppercase().as_str() {
        "" | "B" => 0,
        "K" | "KB" | "KIB" => 1,
        "M" | "MB" | "MIB" => 2,
        "G" | "GB" | "GIB" => 3,
        "T" | "TB" | "TIB" => 4,
        _ => return Err("expected a number of bytes, or one with K, M, G or T, such as 512M".to_owned()),
    };
    let number: u64 = digits.parse().map_err(|_| "expected a whole number, such as 512M".to_owned())?;
    let bytes = number.checked_mul(1024_u64.pow(power)).filter(|bytes| *bytes > 0);
    bytes.ok_or_else(|| "expected between 1 and 16 million T".to_owned())
}

/// `status`.
#[derive(Debug, clap::Args)]
pub struct StatusArgs {
    /// Folder of the study (docs/study.md)
    pub study: PathBuf,
    /// Where results go, and what is kept between runs
    #[command(flatten)]
    pub place: PlaceArgs,
    /// List every session, also those of which nothing is to be done and nothing was lost
    #[arg(long)]
    pub all: bool,
    /// JSON on stdout (docs/runs.md)
    #[arg(long)]
    pub json: bool,
    /// Settings in place of study.toml's
    #[command(flatten)]
    pub settings: SettingsArgs,
}

/// Settings that win over study.toml.
#[derive(Debug, clap::Args)]
pub struct SettingsArgs {
    /// Methods (paper, ray, coaxial, joint, best), separated by commas; default: those of study.toml
    #[arg(long, env = "AIM_BATCH_METHOD", value_delimiter = ',')]
    pub method: Vec<Method>,
    /// Who marks: manual (the study's files), auto (rims found in the selected images) or both; default: study.toml's
    #[arg(long, env = "AIM_BATCH_MARKS", value_name = "manual|auto|both")]
    pub marks: Option<MarksSource>,
    /// Shapes of rims that are looked for (circle, rectangle), separated by commas; default: those of study.toml
    #[arg(long, env = "AIM_BATCH_SHAPES", value_delimiter = ',')]
    pub shapes: Vec<RimShape>,
    /// Pitch near which frames are selected, in degrees; default: study.toml's
    #[arg(long, env = "AIM_BATCH_TARGET_PITCH")]
    pub target_pitch: Option<f64>,
    /// Half width of the window around it, in degrees; default: study.toml's
    #[arg(long, env = "AIM_BATCH_PITCH_TOLERANCE")]
    pub pitch_tolerance: Option<f64>,
    /// Corrections that aim-batch calibrate has learned for the device (docs/calibration.md)
    #[arg(long, value_name = "FILE.toml", env = "AIM_BATCH_CALIBRATION")]
    pub calibration: Option<PathBuf>,
}

/// `check`.
#[derive(Debug, clap::Args)]
pub struct CheckArgs {
    /// Folder of the study (docs/study.md); nothing is written into it
    pub study: PathBuf,
    /// Sessions at a time; default: the cores that this process may use
    #[arg(short, long, env = "AIM_BATCH_JOBS")]
    pub jobs: Option<NonZeroUsize>,
    /// Also show what is worth knowing and costs nothing
    #[arg(long)]
    pub notes: bool,
    /// JSON on stdout (docs/inspect.md)
    #[arg(long)]
    pub json: bool,
    /// Settings in place of study.toml's
    #[command(flatten)]
    pub settings: SettingsArgs,
}

/// `calibrate`.
#[derive(Debug, clap::Args)]
pub struct CalibrateArgs {
    /// Folder of the study (docs/study.md), with true sizes in objects.csv; nothing is written into it
    pub study: PathBuf,
    /// The file to write
    #[arg(short, long, default_value = "calibration.toml")]
    pub out: PathBuf,
    /// Sessions at a time; default: the cores that this process may use
    #[arg(short, long, env = "AIM_BATCH_JOBS")]
    pub jobs: Option<NonZeroUsize>,
}

/// `inspect`.
#[derive(Debug, clap::Args)]
pub struct InspectArgs {
    /// MCAP file that ingest or run wrote, or folder of a study; nothing is written there
    #[arg(value_name = "FILE|STUDY")]
    pub path: PathBuf,
    /// Sessions of a study at a time; default: the cores that this process may use
    #[arg(short, long, env = "AIM_BATCH_JOBS")]
    pub jobs: Option<NonZeroUsize>,
    /// JSON on stdout (docs/inspect.md)
    #[arg(long)]
    pub json: bool,
}

/// `ingest`.
#[derive(Debug, clap::Args)]
pub struct IngestArgs {
    /// Folder of the card as it was copied
    pub card: PathBuf,
    /// The MCAP file to write
    #[arg(short, long)]
    pub out: PathBuf,
    /// Device profile: built in (aim2-packets, csv, pupil-neon, axivity-cwa), or a name in --devices
    #[arg(long, default_value = "aim2-packets")]
    pub profile: String,
    /// Camera: built in (aim2-raw, aim2-corrected), or a name in --devices
    #[arg(long, default_value = "aim2-raw")]
    pub camera: String,
    /// Folder with device profiles and cameras
    #[arg(long, default_value = "devices")]
    pub devices: PathBuf,
    /// Time zone of times that name none (IANA)
    #[arg(long, default_value = "UTC")]
    pub time_zone: String,
    /// When a clock that counts from the device's start was zero, such as 2026-03-01T09:00:00Z
    #[arg(long, value_name = "UTC")]
    pub clock_zero: Option<jiff::Timestamp>,
}

/// `report`.
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

#[cfg(test)]
mod tests {
    use super::bytes;

    #[test]
    fn sizes_with_and_without_a_unit() {
        assert_eq!(bytes("1"), Ok(1));
        assert_eq!(bytes("512M"), Ok(512 << 20));
        assert_eq!(bytes("2 gib"), Ok(2 << 30));
        for wrong in ["", "M", "0", "-1", "1.5G", "2X", "99999999999T"] {
            assert!(bytes(wrong).is_err(), "{wrong}");
        }
    }
}
