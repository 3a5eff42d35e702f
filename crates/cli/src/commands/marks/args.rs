//! The arguments of `marks`.

use std::path::PathBuf;

use clap::{Subcommand, ValueEnum};
use pipeline::labelme::MarksFrame;

/// The arguments of `marks`.
#[derive(Debug, clap::Args)]
pub struct MarksArgs {
    /// Direction: into the study or out of it
    #[command(subcommand)]
    pub way: MarksWay,
}

/// The directions in which marks are converted.
#[derive(Debug, Subcommand)]
pub enum MarksWay {
    /// Turn CVAT's XML or COCO's JSON into LabelMe files, marks/RATER/SESSION/IMAGE.json of the study (docs/marks.md)
    ///
    /// Labels are OBJECT/WHAT, with OBJECT of objects.csv and WHAT one of diameter, width, length, height (2 points) and rim,
    /// base (an outline). Whatever cannot be used is listed with what was expected; the rest is used, and the exit code is 3.
    Import(MarksImportArgs),
    /// Write the marks of one rater as one file for CVAT, or for programs that read COCO
    Export(MarksExportArgs),
}

/// The arguments of `marks import`.
#[derive(Debug, clap::Args)]
pub struct MarksImportArgs {
    /// Folder of the study (docs/study.md), for its objects and the pictures of its cards
    pub study: PathBuf,
    /// annotations.xml of 'CVAT for images 1.1', or a JSON file of COCO
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Who made the marks: the name of their folder
    #[arg(long, value_name = "NAME")]
    pub rater: String,
    /// Folder of marks of all raters; default: marks/ of the study
    #[arg(short, long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// The only session whose images are marked; default: the one that a folder in the image's path is named after, or that
    /// alone has an image of this name
    #[arg(long, value_name = "SESSION")]
    pub session: Option<String>,
    /// Meaning of a label of the file, such as --label 'Bowl rim=red bowl/rim'; may be given again
    #[arg(long, value_name = "LABEL=OBJECT/WHAT", value_parser = renamed)]
    pub label: Vec<(String, String)>,
    /// A label that is no mark, and is meant to be passed over; may be given again
    #[arg(long, value_name = "LABEL")]
    pub ignore: Vec<String>,
    /// Frame of the marks on pictures that EXIF tells viewers to turn, where neither the tool nor the size shows it: stored or
    /// shown; default: [marks] frame of study.toml
    #[arg(long, value_name = "FRAME")]
    pub frame: Option<MarksFrame>,
    /// Also take named points that are marked as hidden (COCO's visibility 1, occluded points of CVAT's skeletons)
    #[arg(long)]
    pub with_hidden: bool,
    /// Write over files that hold other marks
    #[arg(long)]
    pub force: bool,
    /// Write nothing, and show what would be written and what cannot be used
    #[arg(long)]
    pub dry_run: bool,
}

/// The arguments of `marks export`.
#[derive(Debug, clap::Args)]
pub struct MarksExportArgs {
    /// Folder of the study (docs/study.md)
    pub study: PathBuf,
    /// Whose marks are written
    #[arg(long, value_name = "NAME")]
    pub rater: String,
    /// Format of the file
    #[arg(long, value_enum)]
    pub format: MarksFormat,
    /// The file to write; one that is there is written over
    #[arg(short, long, value_name = "FILE")]
    pub out: PathBuf,
}

/// The formats of other tools that marks are written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum MarksFormat {
    /// JSON: outlines as polygons, lines as two keypoints
    Coco,
    /// XML of 'CVAT for images 1.1': outlines as polygons, lines as polylines
    Cvat,
}

fn renamed(text: &str) -> Result<(String, String), String> {
    let halves = text.rsplit_once('=').filter(|(from, to)| !from.is_empty() && !to.is_empty());
    let (from, to) = halves.ok_or_else(|| "expected LABEL=OBJECT/WHAT, such as 'Bowl rim=red bowl/rim'".to_owned())?;
    Ok((from.to_owned(), to.to_owned()))
}
