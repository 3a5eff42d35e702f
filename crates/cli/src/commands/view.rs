//! A camera at a pose, from the command line.

use std::path::Path;

use anyhow::{Context, anyhow};
use model::{Pose, View};

use crate::args::PoseArgs;
use crate::exit::Failure;

/// The view, or what is wrong with the arguments.
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
