//! Rims found in one picture, and how long that takes: a look at the detector without the whole program.
//!
//! ```text
//! cargo run -p aim-batch-rims --example rims -- PICTURE CAMERA.toml PITCH_DEG ROLL_DEG RANGE_MM [SHAPES]
//! ```
//!
//! SHAPES: circle (default), rectangle, or both with a comma between.

use std::error::Error;
use std::path::Path;
use std::time::{Duration, Instant};

use aim_batch_rims::{RimShape, find_rims_of};
use ingest::{Picture, camera};
use model::{Pose, View};

/// How often it is timed.
const REPEATS: u32 = 7;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [picture, camera_file, pitch_deg, roll_deg, range_mm, more @ ..] = arguments.as_slice() else {
        return Err("usage: rims PICTURE CAMERA.toml PITCH_DEG ROLL_DEG RANGE_MM [SHAPES]".into());
    };
    let shapes = more.first().map_or("circle", String::as_str).split(',');
    let shapes = shapes.map(str::parse).collect::<Result<Vec<RimShape>, _>>()?;
    let number = |text: &String| text.parse::<f64>();
    let pose = Pose::new(number(pitch_deg)?.to_radians(), number(roll_deg)?.to_radians(), number(range_mm)?)?;
    let view = View::new(camera::read_file(Path::new(camera_file))?.camera()?, pose);
    let bytes = std::fs::read(picture)?;
    let (mut decoding, mut finding) = (Duration::MAX, Duration::MAX);
    let mut rims = Vec::new();
    for _ in 0..REPEATS {
        let start = Instant::now();
        let picture = Picture::decode(&bytes)?;
        decoding = decoding.min(start.elapsed());
        let start = Instant::now();
        rims = find_rims_of(&picture, &view, &shapes)?;
        finding = finding.min(start.elapsed());
    }
    #[expect(clippy::print_stdout, reason = "an example prints what it found")]
    {
        println!("decoded in {decoding:.1?}, {} rims found in {finding:.1?} (least of {REPEATS})", rims.len());
    }
    for rim in rims {
        let ([x, y], radius) = rim.on_table_mm;
        let (confidence, coverage, points) = (rim.confidence, rim.evidence.coverage, rim.points_px.len());
        let (height, kind) = (rim.height, rim.kind);
        #[expect(clippy::print_stdout, reason = "an example prints what it found")]
        {
            println!(
                "confidence {confidence:.2}  coverage {coverage:.2}  points {points}  on Z = 0: ({x:.0}, {y:.0}) radius \
                 {radius:.1} mm  {kind}  height {:.0} +- {:.0} mm ({:?})",
                height.mm, height.sigma_mm, height.source
            );
        }
    }
    Ok(())
}
