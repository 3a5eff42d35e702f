//! The arguments of `measure`.

use std::path::PathBuf;

use model::{Kind, Shape, Wall};
use pipeline::labelme::MarksFrame;
use rims::RimShape;

use crate::commands::view::PoseArgs;

/// The arguments of `measure`.
#[derive(Debug, clap::Args)]
pub struct MeasureArgs {
    /// The picture
    pub image: PathBuf,
    /// Where the camera is
    #[command(flatten)]
    pub pose: PoseArgs,
    /// Kind of container: plate (on the table; with --auto at the height that its rim seems to have), bowl or box (with a
    /// height); with --auto, default: as it looks
    #[arg(long, required_unless_present = "auto")]
    pub kind: Option<Kind>,
    /// Outline of the container; default: circle for plates and bowls, rectangle for boxes
    #[arg(long)]
    pub shape: Option<Shape>,
    /// Marks, as a LabelMe file (docs/study.md)
    #[arg(long, value_name = "FILE.json", required_unless_present = "auto", conflicts_with = "auto")]
    pub marks: Option<PathBuf>,
    /// Frame of the marks on a picture that EXIF tells viewers to turn, where the file does not show it: stored or shown
    #[arg(long, value_name = "FRAME", requires = "marks")]
    pub frame: Option<MarksFrame>,
    /// Find rims without marks (docs/rims.md)
    #[arg(long)]
    pub auto: bool,
    /// Shapes of rims that --auto looks for (circle, rectangle), separated by commas
    #[arg(long, value_delimiter = ',', default_value = "circle", requires = "auto")]
    pub shapes: Vec<RimShape>,
    /// Least confidence of a rim that is shown, 0 to 1
    #[arg(long, value_name = "SHARE", default_value_t = 0.5, requires = "auto")]
    pub min_confidence: f64,
    /// Height of the rim above the table in mm, where it is known and not to be measured
    #[arg(long, value_name = "MM")]
    pub rim_height: Option<f64>,
    /// How the wall stands, where it is known: vertical or sloped (a box's is vertical)
    #[arg(long)]
    pub wall: Option<Wall>,
    /// Also write the picture with rims, axes and sizes drawn on it, as PNG
    #[arg(long, value_name = "OUT.png")]
    pub overlay: Option<PathBuf>,
    /// JSON on stdout
    #[arg(long)]
    pub json: bool,
}
