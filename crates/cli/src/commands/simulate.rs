//! `simulate`: a study with known truth.

use ::simulate::laid::{self, LaidOptions, LaidPreset};
use ::simulate::{LargeOptions, Options, SimulateError, Summary, large, published_bench};
use anyhow::anyhow;

use super::tell;
use crate::args::{LargeArgs, Preset, SimulateArgs};
use crate::exit::{Failure, Outcome};
use crate::progress::Bars;

/// Makes the study.
pub fn run(args: &SimulateArgs, bars: &Bars) -> Result<Outcome, Failure> {
    let summary = match args.preset {
        Preset::PublishedBench => make_published_bench(args, bars)?,
        Preset::Large => make_large(args, bars)?,
        Preset::Bench => make_bench(args, bars)?,
        Preset::Worn => make_worn(args, bars)?,
    };
    tell(&format!(
        "wrote {}: {} sessions, {} images, {} files of marks\n",
        args.out.display(),
        summary.sessions,
        summary.images,
        summary.mark_files,
    ));
    Ok(Outcome::Well)
}

fn make_published_bench(args: &SimulateArgs, bars: &Bars) -> Result<Summary, Failure> {
    if args.large != LargeArgs::default() {
        let fact =
            "--sessions, --images, --image-size and --damage belong to other presets: published-bench is as it is";
        return Err(Failure::Usage(anyhow!(fact)));
    }
    let options = Options { seed: args.seed, render: !args.no_pictures };
    Ok(published_bench(&args.out, &options, &bars.counter("pictures"))?)
}

fn make_large(args: &SimulateArgs, bars: &Bars) -> Result<Summary, Failure> {
    refuse_no_pictures(args)?;
    let (given, default) = (&args.large, LargeOptions::default());
    let options = LargeOptions {
        seed: args.seed,
        sessions: given.sessions.unwrap_or(default.sessions),
        images: given.images.unwrap_or(default.images),
        size_px: given.image_size.unwrap_or(default.size_px),
        damage_pct: given.damage.unwrap_or(default.damage_pct),
    };
    large(&args.out, &options, &bars.counter("sessions")).map_err(failure)
}

fn make_bench(args: &SimulateArgs, bars: &Bars) -> Result<Summary, Failure> {
    let given = &args.large;
    if given.sessions.is_some() || given.images.is_some() || given.damage.is_some() {
        let fact =
            "--sessions, --images and --damage do not fit the preset bench: it has nine sessions of eight images";
        return Err(Failure::Usage(anyhow!(fact)));
    }
    make_laid(args, LaidPreset::Bench, bars)
}

fn make_worn(args: &SimulateArgs, bars: &Bars) -> Result<Summary, Failure> {
    let given = &args.large;
    if given.damage.is_some() {
        return Err(Failure::Usage(anyhow!("--damage belongs to the preset large")));
    }
    let preset = LaidPreset::Worn { sessions: given.sessions.unwrap_or(4), images: given.images.unwrap_or(24) };
    make_laid(args, preset, bars)
}

fn make_laid(args: &SimulateArgs, preset: LaidPreset, bars: &Bars) -> Result<Summary, Failure> {
    refuse_no_pictures(args)?;
    let size_px = args.large.image_size.unwrap_or(LaidOptions::SIZE_PX);
    let options = LaidOptions { preset, seed: args.seed, size_px };
    laid::write(&args.out, &options, &bars.counter("pictures")).map_err(failure)
}

fn refuse_no_pictures(args: &SimulateArgs) -> Result<(), Failure> {
    if args.no_pictures {
        return Err(Failure::Usage(anyhow!("--no-pictures belongs to the preset published-bench")));
    }
    Ok(())
}

fn failure(error: SimulateError) -> Failure {
    match error {
        SimulateError::Option { .. } => Failure::usage(error),
        other => other.into(),
    }
}
