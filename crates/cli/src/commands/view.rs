//! A camera at a pose, as the command line gives it.

use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use model::{Pose, View};

use crate::exit::Failure;

/// The camera and its pose, for `project` and `measure`.
#[derive(Debug, clap::Args)]
pub struct PoseArgs {
    /// Camera file (docs/devices.md), or a built-in camera (aim2-raw, aim2-corrected)
    #[arg(long, value_name = "CAM.toml")]
    pub camera: PathBuf,
    /// Depression of the optical axis below the horizontal, in degrees
    #[arg(long, value_name = "DEG")]
    pub pitch: f64,
    /// Roll, positive clockwise as the wearer sees it, in degrees
    #[arg(long, value_name = "DEG", default_value_t = 0.0)]
    pub roll: f64,
    /// Distance to the table along the optical axis, in mm
    #[arg(long, value_name = "MM")]
    pub range: f64,
}

/// The view of the camera at its pose. Fails where the camera file cannot be used, or the pose is out of range.
pub fn from_args(args: &PoseArgs) -> Result<View, Failure> {
    let name = args.camera.to_str().filter(|name| !name.contains(['.', '/', '\\']));
    let spec = match name {
        Some(built_in) if !args.camera.exists() => ::ingest::camera::load(built_in, Path::new("devices")),
        _ => ::ingest::camera::read_file(&args.camera),
    };
    let spec = spec.map_err(Failure::usage)?;
    let camera =
        spec.camera().with_context(|| format!("camera file {}", args.camera.display())).map_err(Failure::Usage)?;
    let pose = Pose::new(args.pitch.to_radians(), args.roll.to_radians(), args.range)
        .map_err(|error| Failure::Usage(anyhow!("{error} (--pitch, --roll, --range)")))?;
    Ok(View::new(camera, pose))
}
