//! `measure --auto`: finds rims in the picture, and measures them.

use anyhow::{Context, anyhow};
use ingest::Picture;
use model::{Container, Kind, Method, Shape, View};
use pipeline::study::UncertaintySpec;
use rims::{HeightSource, Rim, find_rims_of};

use super::super::{outcome, print, print_message};
use super::args::MeasureArgs;
use super::overlay;
use super::size::{Found, Size, describe, text};
use crate::exit::{Failure, Outcome};

/// The methods for a rim alone, the one with fewer assumptions first.
const METHODS: [Method; 2] = [Method::Ray, Method::Paper];

/// Finds the rims in the picture, and prints their sizes. A rim without a size is a loss.
pub fn run(args: &MeasureArgs, view: &View, bytes: &[u8]) -> Result<Outcome, Failure> {
    if args.kind == Some(Kind::Box) {
        return Err(Failure::Usage(anyhow!("--auto finds no boxes: mark them, and give --marks")));
    }
    if args.shape.is_some_and(|shape| shape != Shape::Circle) {
        return Err(Failure::Usage(anyhow!(
            "--shape is for marks; with --auto give --shapes circle, --shapes rectangle, or both"
        )));
    }
    if !(0.0..=1.0).contains(&args.min_confidence) {
        return Err(Failure::Usage(anyhow!("--min-confidence: expected 0 to 1")));
    }
    let picture = Picture::decode(bytes).with_context(|| format!("picture {}", args.image.display()))?;
    let mut rims = find_rims_of(&picture, view, &args.shapes).context("rims")?;
    rims.retain(|rim| rim.confidence >= args.min_confidence);
    let inputs = UncertaintySpec::default().inputs();
    let mut sizes: Vec<Size> = Vec::new();
    let mut drawn = Vec::new();
    for (rim, number) in rims.iter().zip(1..) {
        let object = format!("auto-{number}");
        let kind = args.kind.unwrap_or(rim.kind);
        let container = Container { kind, shape: rim.shape(), rim_height_mm: args.rim_height, wall: args.wall };
        let found = describe_rim(rim, &container);
        let of_rim = METHODS.into_iter().flat_map(|method| {
            let measured = rim.sizes(view, method, &container, &inputs);
            measured.into_iter().map(move |(quantity, size)| (quantity, method, size))
        });
        let first = sizes.len();
        sizes.extend(of_rim.map(|(quantity, method, size)| Size {
            found: Some(found.clone()),
            ..describe(&object, &container, quantity, method, &size)
        }));
        drawn.push(overlay::found_rim(rim, &container, &object, &sizes[first..]));
    }
    overlay::write(args, view, picture, &drawn)?;
    print(&if args.json { format!("{}\n", serde_json::to_string_pretty(&sizes)?) } else { text(&sizes, &inputs) })?;
    if rims.is_empty() {
        print_message("no rim was found\n");
    }
    Ok(outcome(sizes.iter().any(|size| size.predicted_mm.is_none())))
}

fn describe_rim(rim: &Rim, container: &Container) -> Found {
    Found {
        confidence: rim.confidence,
        center_px: [rim.center_px.x, rim.center_px.y],
        rim_px: rim.points_px.iter().map(|p| [p.x, p.y]).collect(),
        rim_height_from: match rim.height_as(container).source {
            HeightSource::Given => "given",
            HeightSource::Foot => "foot",
            HeightSource::Floor => "floor",
            HeightSource::Session => "session",
            HeightSource::Common => "common",
        },
    }
}
