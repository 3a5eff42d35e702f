//! Settings of a study that the command line gives.

use std::path::{Path, PathBuf};

use model::Method;
use pipeline::Study;
use pipeline::calibration::CalibrationFile;
use pipeline::study::{MarksSource, StudySpec};
use rims::RimShape;

use crate::exit::Failure;

/// Settings that win over those of study.toml.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "What is measured")]
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
    /// Half width of the window around the target pitch, in degrees; default: study.toml's
    #[arg(long, env = "AIM_BATCH_PITCH_TOLERANCE")]
    pub pitch_tolerance: Option<f64>,
    /// Corrections that aim-batch calibrate has learned for the device (docs/calibration.md)
    #[arg(long, value_name = "FILE.toml", env = "AIM_BATCH_CALIBRATION")]
    pub calibration: Option<PathBuf>,
}

/// The study in the folder `study`, with these settings and this calibration. Fails where a file of either cannot be used.
pub fn load(study: &Path, args: &SettingsArgs) -> Result<Study, Failure> {
    let study = Study::load(study, |spec| apply(args, spec)).map_err(Failure::usage)?;
    match &args.calibration {
        Some(path) => Ok(study.calibrated(CalibrationFile::read(path).map_err(Failure::usage)?)),
        None => Ok(study),
    }
}

/// Puts the settings that were given (by flag or environment) in place of those of study.toml.
fn apply(args: &SettingsArgs, spec: &mut StudySpec) {
    if !args.method.is_empty() {
        spec.measure.methods.clone_from(&args.method);
    }
    if let Some(source) = args.marks {
        spec.marks.source = source;
    }
    if !args.shapes.is_empty() {
        spec.marks.shapes.clone_from(&args.shapes);
    }
    if let Some(pitch_deg) = args.target_pitch {
        spec.select.target_pitch_deg = pitch_deg;
    }
    if let Some(tolerance_deg) = args.pitch_tolerance {
        spec.select.pitch_tolerance_deg = tolerance_deg;
    }
}
