//! `simulate`: makes a study with known truth.

mod args;

use std::path::Path;

use ::simulate::laid::{self, LaidOptions, LaidPreset, SceneCamera, SceneSpec};
use ::simulate::{LargeOptions, Options, SimulateError, Simulated, large, published_bench};
use anyhow::anyhow;
use clap::ValueEnum as _;
use ingest::{camera, config};
use serde_json::json;

pub use args::SimulateArgs;
use args::{LargeArgs, Preset, StudyToMake};

use super::{PROGRAM, print_message};
use crate::exit::{Failure, Outcome};
use crate::progress::Bars;

/// Makes the study, writes its truth beside it, and reports how large it is.
pub fn run(args: &SimulateArgs, bars: &Bars) -> Result<Outcome, Failure> {
    let seed = args.seed.unwrap_or(1);
    let (Simulated { summary, truth }, made_from) = match &args.study {
        StudyToMake::Preset(preset) => {
            let made = match preset {
                Preset::PublishedBench => make_published_bench(args, seed, bars)?,
                Preset::Large => make_large(args, seed, bars)?,
                Preset::Bench => make_bench(args, seed, bars)?,
                Preset::Worn => make_worn(args, seed, bars)?,
            };
            let name = preset.to_possible_value().map(|value| value.get_name().to_owned());
            (made, json!({"program": PROGRAM, "preset": name, "seed": seed}))
        }
        StudyToMake::Scene(file) => {
            let (made, seed) = make_scene(file, args, bars)?;
            (made, json!({"program": PROGRAM, "scene": "scene.toml", "seed": seed}))
        }
    };
    if !truth.is_empty() {
        ::report::write_truth(&args.out.join("truth.parquet"), truth, &made_from.to_string())?;
    }
    print_message(&format!(
        "wrote {}: {} sessions, {} images, {} files of marks\n",
        args.out.display(),
        summary.sessions,
        summary.images,
        summary.mark_files,
    ));
    Ok(Outcome::Well)
}

/// Makes the paper's bench. Its truth is in its objects.csv, as it was published; it has no truth.parquet.
fn make_published_bench(args: &SimulateArgs, seed: u64, bars: &Bars) -> Result<Simulated, Failure> {
    if args.large != LargeArgs::default() {
        let fact =
            "--sessions, --images, --image-size and --damage belong to other presets: published-bench is as it is";
        return Err(Failure::Usage(anyhow!(fact)));
    }
    let options = Options { seed, render: !args.no_pictures };
    let summary = published_bench(&args.out, &options, &bars.counter("pictures"))?;
    Ok(Simulated { summary, truth: Vec::new() })
}

fn make_large(args: &SimulateArgs, seed: u64, bars: &Bars) -> Result<Simulated, Failure> {
    refuse_no_pictures(args)?;
    let (given, default) = (&args.large, LargeOptions::default());
    let options = LargeOptions {
        seed,
        sessions: given.sessions.unwrap_or(default.sessions),
        images: given.images.unwrap_or(default.images),
        size_px: given.image_size.unwrap_or(default.size_px),
        damage_pct: given.damage.unwrap_or(default.damage_pct),
    };
    large(&args.out, &options, &bars.counter("sessions")).map_err(failure)
}

fn make_bench(args: &SimulateArgs, seed: u64, bars: &Bars) -> Result<Simulated, Failure> {
    let given = &args.large;
    if given.sessions.is_some() || given.images.is_some() || given.damage.is_some() {
        let fact =
            "--sessions, --images and --damage do not fit the preset bench: it has nine sessions of eight images";
        return Err(Failure::Usage(anyhow!(fact)));
    }
    make_laid(args, seed, LaidPreset::Bench, bars)
}

fn make_worn(args: &SimulateArgs, seed: u64, bars: &Bars) -> Result<Simulated, Failure> {
    let given = &args.large;
    if given.damage.is_some() {
        return Err(Failure::Usage(anyhow!("--damage belongs to the preset large")));
    }
    let preset = LaidPreset::Worn { sessions: given.sessions.unwrap_or(4), images: given.images.unwrap_or(24) };
    make_laid(args, seed, preset, bars)
}

fn make_laid(args: &SimulateArgs, seed: u64, preset: LaidPreset, bars: &Bars) -> Result<Simulated, Failure> {
    refuse_no_pictures(args)?;
    let size_px = args.large.image_size.unwrap_or(LaidOptions::SIZE_PX);
    let options = LaidOptions { preset, seed, size_px };
    laid::write(&args.out, &options, &bars.counter("pictures")).map_err(failure)
}

/// Makes the study of a scene file, and returns it with the seed that it was made with.
fn make_scene(file: &Path, args: &SimulateArgs, bars: &Bars) -> Result<(Simulated, u64), Failure> {
    refuse_no_pictures(args)?;
    if args.large != LargeArgs::default() {
        let fact = "--sessions, --images, --image-size and --damage belong to presets: a scene file says them itself";
        return Err(Failure::Usage(anyhow!(fact)));
    }
    let text = config::read_text(file).map_err(Failure::usage)?;
    let scene: SceneSpec = config::parse_toml(&text, file).map_err(Failure::usage)?;
    let camera = match scene.camera() {
        SceneCamera::Own(spec) => spec.as_ref().clone(),
        SceneCamera::Named(name) => {
            let beside = file.parent().unwrap_or(Path::new(""));
            camera::load(name, beside).map_err(Failure::usage)?
        }
    };
    let seed = args.seed.unwrap_or(scene.seed());
    match scene.write(&args.out, &camera, seed, text.as_bytes(), &bars.counter("pictures")) {
        Ok(made) => Ok((made, seed)),
        Err(error @ (SimulateError::Scene { .. } | SimulateError::SceneCamera(_))) => {
            Err(Failure::Usage(anyhow!("{}: {error}", file.display())))
        }
        Err(other) => Err(other.into()),
    }
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
