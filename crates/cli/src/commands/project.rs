//! `project`: reads a CSV of points from stdin, and writes one with the projected points to stdout.

use std::io;

use anyhow::{Context, anyhow};
use model::{View, ViewError};
use nalgebra::{Point2, Point3};

use super::view::PoseArgs;
use super::{outcome, print_message, view};
use crate::exit::{Failure, Outcome};

/// The arguments of `project`.
#[derive(Debug, clap::Args)]
pub struct ProjectArgs {
    /// Where the camera is
    #[command(flatten)]
    pub pose: PoseArgs,
    /// Height of the plane above the table, in mm
    #[arg(long, value_name = "MM", default_value_t = 0.0)]
    pub plane_z: f64,
    /// From the plane to pixels: reads world_x_mm,world_y_mm
    #[arg(long)]
    pub inverse: bool,
}

const PIXEL_COLUMNS: [&str; 2] = ["x", "y"];
const WORLD_COLUMNS: [&str; 2] = ["world_x_mm", "world_y_mm"];

/// Number of points without an answer that have a message of their own. More are only counted.
const WARNINGS_SHOWN: usize = 20;

/// Projects every row of stdin. A row without an answer keeps its place, with empty cells, and is a loss.
pub fn run(args: &ProjectArgs) -> Result<Outcome, Failure> {
    let view = view::from_args(&args.pose)?;
    let (from, to) = if args.inverse { (WORLD_COLUMNS, PIXEL_COLUMNS) } else { (PIXEL_COLUMNS, WORLD_COLUMNS) };
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).flexible(true).from_reader(io::stdin().lock());
    let columns = columns_of(reader.headers().map_err(Failure::usage)?, from)?;
    let mut writer = csv::Writer::from_writer(io::stdout().lock());
    writer.write_record(from.iter().chain(&to))?;
    let mut lost = 0_usize;
    for (row, record) in (1..).zip(reader.byte_records()) {
        let record: csv::ByteRecord = record.map_err(Failure::usage)?;
        let cells = columns.map(|column| String::from_utf8_lossy(record.get(column).unwrap_or_default()));
        let texts = [&*cells[0], &*cells[1]];
        match project(args, &view, texts) {
            Ok([a, b]) => writer.write_record([texts[0], texts[1], &a.to_string(), &b.to_string()])?,
            Err(why) => {
                lost += 1;
                if lost <= WARNINGS_SHOWN {
                    print_message(&format!("warning: row {row}: no answer for ({}, {}): {why}\n", texts[0], texts[1]));
                }
                writer.write_record([texts[0], texts[1], "", ""])?;
            }
        }
    }
    writer.flush().context("cannot write to standard output")?;
    if lost > WARNINGS_SHOWN {
        print_message(&format!("warning: {} more points have no answer\n", lost - WARNINGS_SHOWN));
    }
    Ok(outcome(lost > 0))
}

fn columns_of(headers: &csv::StringRecord, wanted: [&str; 2]) -> Result<[usize; 2], Failure> {
    let find = |name: &str| headers.iter().position(|header| header == name);
    match wanted.map(find) {
        [Some(a), Some(b)] => Ok([a, b]),
        _ => {
            let got: Vec<_> = headers.iter().collect();
            Err(Failure::Usage(anyhow!(
                "stdin: expected CSV with a header and the columns {}, got {}",
                wanted.join(","),
                if got.is_empty() { "nothing".to_owned() } else { got.join(",") }
            )))
        }
    }
}

fn project(args: &ProjectArgs, view: &View, texts: [&str; 2]) -> Result<[f64; 2], String> {
    let [a, b] = texts.map(|text| text.parse::<f64>().map_err(|_| format!("'{text}' is not a number")));
    let (a, b) = (a?, b?);
    let say = |error: ViewError| error.to_string();
    let point = if args.inverse {
        view.pixel_of(Point3::new(a, b, args.plane_z)).map_err(say)?
    } else {
        view.on_plane(Point2::new(a, b), args.plane_z).map_err(say)?
    };
    Ok([point.x, point.y])
}
