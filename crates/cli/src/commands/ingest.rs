//! `ingest`: makes one MCAP file from one card.

use ::ingest::{Profile, SessionSource, camera, ingest_session};
use anyhow::{Context, anyhow};
use model::Severity;
use std::path::PathBuf;

use super::{PROGRAM, outcome, print, print_message};
use crate::exit::{Failure, Outcome};
use crate::progress::Bars;

/// The arguments of `ingest`.
#[derive(Debug, clap::Args)]
pub struct IngestArgs {
    /// Folder of the card as it was copied
    pub card: PathBuf,
    /// The MCAP file to write
    #[arg(short, long)]
    pub out: PathBuf,
    /// Device profile: built in (aim2-packets, csv, pupil-neon, pupil-invisible, axivity-cwa), or a name in --devices
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

/// Ingests the card, prints the numbers of images and samples, and writes to stderr what was lost.
pub fn run(args: &IngestArgs, bars: &Bars) -> Result<Outcome, Failure> {
    let session =
        args.card.canonicalize().ok().and_then(|path| Some(::ingest::nfc(path.file_name()?.to_string_lossy())));
    let source = SessionSource {
        session: session.unwrap_or_else(|| "session".to_owned()),
        card_dir: args.card.clone(),
        profile: Profile::load(&args.profile, &args.devices).map_err(Failure::usage)?,
        camera_spec: camera::load(&args.camera, &args.devices).map_err(Failure::usage)?,
        time_zone: jiff::tz::TimeZone::get(&args.time_zone)
            .with_context(|| format!("--time-zone {}: expected an IANA name such as America/Chicago", args.time_zone))
            .map_err(Failure::Usage)?,
        clock_zero_utc: args.clock_zero,
        program: PROGRAM.to_owned(),
    };
    let summary =
        ingest_session(&source, &args.out, &bars.for_card()).map_err(|error| anyhow!("{error}; {}", error.remedy()))?;
    print(&format!(
        "{}: {} images, {} acceleration samples, {} range samples from {} files (profile {}, camera {})\n",
        args.out.display(),
        summary.counts.images,
        summary.counts.acceleration,
        summary.counts.range,
        summary.files,
        source.profile.name,
        source.camera_spec.name,
    ))?;
    for image in &summary.dropped_images {
        print_message(&format!("dropped {}: {} ({})\n", image.file, image.reason.meaning(), image.reason));
    }
    for problem in &summary.problems {
        print_message(&format!("{} in {}: {}; {}\n", problem.code, problem.place, problem.fact, problem.remedy));
    }
    Ok(outcome(
        !summary.dropped_images.is_empty() || summary.problems.iter().any(|problem| problem.severity == Severity::Loss),
    ))
}
