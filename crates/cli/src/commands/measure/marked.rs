//! `measure --marks`: measures the objects that a person marked.

use std::collections::BTreeSet;
use std::path::Path;

use anyhow::anyhow;
use model::{Container, Kind, MeasureError, Method, Quantity, Shape, View, estimate};
use pipeline::labelme;
use pipeline::study::UncertaintySpec;

use super::super::{outcome, print, print_message};
use super::args::MeasureArgs;
use super::overlay;
use super::size::{Size, describe, text};
use crate::exit::{Failure, Outcome};

/// The methods, the one with fewer assumptions first.
const METHODS: [Method; 3] = [Method::Coaxial, Method::Ray, Method::Paper];

/// Measures the marked objects, and prints their sizes. A mark or an object that gives no size is a loss; the command fails
/// where nothing could be measured.
pub fn run(args: &MeasureArgs, view: &View, picture: &[u8], marks_file: &Path, kind: Kind) -> Result<Outcome, Failure> {
    let bytes = labelme::read_bytes(marks_file).map_err(Failure::usage)?;
    let mut marks = labelme::parse(&bytes, marks_file, view.camera().size_px())?;
    if marks.objects.is_empty() && marks.refused.is_empty() {
        return Err(Failure::Failed(anyhow!("the file of marks has no shapes: {}", marks_file.display())));
    }
    let shape = args.shape.unwrap_or(if kind == Kind::Box { Shape::Rectangle } else { Shape::Circle });
    marks.refuse_four_corners(|_| shape == Shape::Circle);
    let container = Container { kind, shape, rim_height_mm: args.rim_height, wall: args.wall };
    let inputs = UncertaintySpec::default().inputs();
    let sizes: Vec<Size> = marks
        .objects
        .iter()
        .flat_map(|object| METHODS.map(|method| (object, method)))
        .flat_map(|(object, method)| {
            let found = estimate(view, method, &container, object, &inputs);
            found.into_iter().map(move |(quantity, size)| describe(&object.object, &container, quantity, method, &size))
        })
        .collect();
    let sizes = without_missing_heights(sizes);
    overlay::write_marked(args, view, picture, &container, &marks.objects, &sizes)?;
    print(&if args.json { format!("{}\n", serde_json::to_string_pretty(&sizes)?) } else { text(&sizes, &inputs) })?;
    let lost = report_problems(&marks, &sizes, view.camera().size_px(), shape);
    if sizes.iter().all(|size| size.predicted_mm.is_none()) {
        return Err(Failure::Failed(anyhow!("nothing could be measured from the marks in {}", marks_file.display())));
    }
    Ok(outcome(lost || sizes.iter().any(|size| size.predicted_mm.is_none())))
}

/// Reports marks outside the picture, and everything that gives no size. Returns whether marks were refused, or an object has no
/// size at all.
fn report_problems(marks: &labelme::Marks, sizes: &[Size], size_px: [u32; 2], shape: Shape) -> bool {
    for object in marks.objects.iter().filter(|object| !object.inside_picture(size_px)) {
        print_message(&format!("warning: marks of '{}' lie outside the picture\n", object.object));
    }
    let mut lost = !marks.refused.is_empty();
    for refused in &marks.refused {
        tracing::error!("{refused}");
    }
    for object in marks.objects.iter().filter(|object| sizes.iter().all(|size| size.object != object.object)) {
        lost = true;
        tracing::error!("the marks of '{}' give no size of a {shape}", object.object);
    }
    let mut reported = BTreeSet::new();
    for size in sizes {
        if let Some(problem) = &size.problem
            && reported.insert((&size.object, size.quantity, problem))
        {
            tracing::error!("{} of '{}' by {}: {problem}", size.quantity, size.object, size.method);
        }
    }
    lost
}

/// The sizes, without the heights that a method lacks because nobody marked a line for it, where another method has measured
/// the height without such a line.
fn without_missing_heights(sizes: Vec<Size>) -> Vec<Size> {
    let measured: BTreeSet<(String, Quantity)> =
        sizes.iter().filter(|s| s.predicted_mm.is_some()).map(|s| (s.object.clone(), s.quantity)).collect();
    let no_height = MeasureError::NoHeight.to_string();
    let open = |size: &Size| {
        size.problem.as_ref() == Some(&no_height) && measured.contains(&(size.object.clone(), size.quantity))
    };
    sizes.into_iter().filter(|size| !open(size)).collect()
}
