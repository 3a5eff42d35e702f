//! Settings of a study from the command line.

use pipeline::study::StudySpec;

use crate::args::SettingsArgs;

/// Flags and environment win over study.toml.
pub fn apply(args: &SettingsArgs, spec: &mut StudySpec) {
    if !args.method.is_empty() {
        spec.measure.methods.clone_from(&args.method);
    }
    if let Some(pitch_deg) = args.target_pitch {
        spec.select.target_pitch_deg = pitch_deg;
    }
    if let Some(tolerance_deg) = args.pitch_tolerance {
        spec.select.pitch_tolerance_deg = tolerance_deg;
    }
}
