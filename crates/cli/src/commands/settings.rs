//! Settings of a study from the command line.

use std::path::Path;

use pipeline::Study;
use pipeline::calibration::CalibrationFile;
use pipeline::study::StudySpec;

use crate::args::SettingsArgs;
use crate::exit::Failure;

/// The study with these settings, and its calibration.
pub fn load(study: &Path, args: &SettingsArgs) -> Result<Study, Failure> {
    let study = Study::load(study, |spec| apply(args, spec)).map_err(Failure::usage)?;
    match &args.calibration {
        Some(path) => Ok(study.calibrated(CalibrationFile::read(path).map_err(Failure::usage)?)),
        None => Ok(study),
    }
}

/// Flags and environment win over study.toml.
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
