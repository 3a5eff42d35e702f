//! `measure`: measures the objects that are marked, or found, in one picture.

mod args;
mod auto;
mod marked;
mod overlay;
mod size;

use std::fs::File;
use std::io::Read;

use anyhow::{Context, anyhow};
use model::View;

pub use args::MeasureArgs;

use super::view;
use crate::exit::{Failure, Outcome};

/// Number of bytes that are read of a picture at most.
const LARGEST_PICTURE_BYTES: u64 = 64 << 20;

/// Measures the picture by marks where they are given, and else by the rims that are found in it, and prints the sizes.
pub fn run(args: &MeasureArgs) -> Result<Outcome, Failure> {
    let view = view::from_args(&args.pose)?;
    if args.rim_height.is_some_and(|mm| !(mm.is_finite() && mm >= 0.0)) {
        return Err(Failure::Usage(anyhow!("--rim-height: expected zero or a positive number of mm")));
    }
    let picture = read_picture(args, &view)?;
    match (&args.marks, args.kind) {
        (Some(marks), Some(kind)) => marked::run(args, &view, &picture, marks, kind),
        _ => auto::run(args, &view, &picture),
    }
}

/// The bytes of the picture. Fails where its size is not that of the camera's pictures, since a scaled copy would be measured
/// wrongly without a warning.
fn read_picture(args: &MeasureArgs, view: &View) -> Result<Vec<u8>, Failure> {
    let [width, height] = view.camera().size_px();
    let mut bytes = Vec::new();
    File::open(&args.image)
        .and_then(|file| file.take(LARGEST_PICTURE_BYTES).read_to_end(&mut bytes))
        .with_context(|| format!("cannot read the picture {}", args.image.display()))?;
    let header =
        ::ingest::parse::image_header::read(&bytes).with_context(|| format!("picture {}", args.image.display()))?;
    if [header.width_px, header.height_px] == [width, height] {
        return Ok(bytes);
    }
    Err(Failure::Usage(anyhow!(
        "the picture is {} x {} px, but the camera file says {width} x {height}: give the camera file of this picture: {}",
        header.width_px,
        header.height_px,
        args.image.display()
    )))
}
