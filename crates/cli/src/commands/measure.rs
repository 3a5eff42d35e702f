//! `measure`: sizes of what is marked in one picture.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::fs::File;
use std::io::Read;

use anyhow::{Context, anyhow};
use model::{Container, Doubt, Estimate, InputSigma, Kind, MeasureError, Method, Quantity, Shape, estimate};
use pipeline::labelme;
use pipeline::study::UncertaintySpec;
use serde::Serialize;

use super::{outcome, print, tell, view};
use crate::args::MeasureArgs;
use crate::exit::{Failure, Outcome};

/// One size, as JSON.
#[derive(Serialize)]
struct Size {
    object: String,
    kind: Kind,
    shape: Shape,
    quantity: Quantity,
    method: Method,
    predicted_mm: Option<f64>,
    sigma_mm: Option<f64>,
    sigma_pitch_mm: Option<f64>,
    sigma_roll_mm: Option<f64>,
    sigma_range_mm: Option<f64>,
    sigma_marks_mm: Option<f64>,
    sigma_camera_mm: Option<f64>,
    sigma_mount_mm: Option<f64>,
    plane_z_mm: Option<f64>,
    wall_slope: Option<f64>,
    doubts: Vec<Doubt>,
    marks: usize,
    problem: Option<String>,
}

/// More of a picture is not read to find its size.
const LARGEST_PICTURE_BYTES: u64 = 64 << 20;

/// The methods, the one with fewer assumptions first.
const METHODS: [Method; 3] = [Method::Coaxial, Method::Ray, Method::Paper];

/// Measures and prints.
pub fn run(args: &MeasureArgs) -> Result<Outcome, Failure> {
    let view = view::from_args(&args.pose)?;
    if args.rim_height.is_some_and(|mm| !(mm.is_finite() && mm >= 0.0)) {
        return Err(Failure::Usage(anyhow!("--rim-height: expected zero or a positive number of mm")));
    }
    check_picture(args, view.camera().size_px())?;
    let bytes = labelme::read_bytes(&args.marks).map_err(Failure::usage)?;
    let marks = labelme::parse(&bytes, &args.marks, view.camera().size_px())?;
    if marks.objects.is_empty() && marks.refused.is_empty() {
        return Err(Failure::Failed(anyhow!("the file of marks has no shapes: {}", args.marks.display())));
    }
    let shape = args.shape.unwrap_or(if args.kind == Kind::Box { Shape::Rectangle } else { Shape::Circle });
    let container = Container { kind: args.kind, shape, rim_height_mm: args.rim_height, wall: args.wall };
    let inputs = UncertaintySpec::default().inputs();
    let sizes: Vec<Size> = marks
        .objects
        .iter()
        .flat_map(|object| METHODS.map(|method| (object, method)))
        .flat_map(|(object, method)| {
            let found = estimate(&view, method, &container, object, &inputs);
            found.into_iter().map(move |(quantity, size)| describe(&object.object, &container, quantity, method, &size))
        })
        .collect();
    let sizes = without_open_ends(sizes);
    print(&if args.json { format!("{}\n", serde_json::to_string_pretty(&sizes)?) } else { text(&sizes, &inputs) })?;
    for object in marks.objects.iter().filter(|object| !object.inside_picture(view.camera().size_px())) {
        tell(&format!("warning: marks of '{}' lie outside the picture\n", object.object));
    }
    let mut lost = !marks.refused.is_empty();
    for refused in &marks.refused {
        tracing::error!("{refused}");
    }
    for object in marks.objects.iter().filter(|object| sizes.iter().all(|size| size.object != object.object)) {
        lost = true;
        tracing::error!("the marks of '{}' give no size of a {shape}", object.object);
    }
    let mut told = BTreeSet::new();
    for size in &sizes {
        if let Some(problem) = &size.problem
            && told.insert((&size.object, size.quantity, problem))
        {
            tracing::error!("{} of '{}' by {}: {problem}", size.quantity, size.object, size.method);
        }
    }
    if sizes.iter().all(|size| size.predicted_mm.is_none()) {
        return Err(Failure::Failed(anyhow!("nothing could be measured from the marks in {}", args.marks.display())));
    }
    Ok(outcome(lost || sizes.iter().any(|size| size.predicted_mm.is_none())))
}

/// A height that nobody marked is missing in methods that need a line; where another one does without, that is no problem.
fn without_open_ends(sizes: Vec<Size>) -> Vec<Size> {
    let measured: BTreeSet<(String, Quantity)> =
        sizes.iter().filter(|s| s.predicted_mm.is_some()).map(|s| (s.object.clone(), s.quantity)).collect();
    let no_height = MeasureError::NoHeight.to_string();
    let open = |size: &Size| {
        size.problem.as_ref() == Some(&no_height) && measured.contains(&(size.object.clone(), size.quantity))
    };
    sizes.into_iter().filter(|size| !open(size)).collect()
}

/// The picture must be the camera's: a scaled copy would be measured wrongly without a word.
fn check_picture(args: &MeasureArgs, [width, height]: [u32; 2]) -> Result<(), Failure> {
    let mut bytes = Vec::new();
    File::open(&args.image)
        .and_then(|file| file.take(LARGEST_PICTURE_BYTES).read_to_end(&mut bytes))
        .with_context(|| format!("cannot read the picture {}", args.image.display()))?;
    let header =
        ::ingest::parse::image_header::read(&bytes).with_context(|| format!("picture {}", args.image.display()))?;
    if [header.width_px, header.height_px] == [width, height] {
        return Ok(());
    }
    Err(Failure::Usage(anyhow!(
        "the picture is {} x {} px, but the camera file says {width} x {height}: give the camera file of this picture: {}",
        header.width_px,
        header.height_px,
        args.image.display()
    )))
}

fn describe(
    object: &str,
    container: &Container,
    quantity: Quantity,
    method: Method,
    size: &Result<Estimate, MeasureError>,
) -> Size {
    let measured = size.as_ref().ok().map(|estimate| estimate.measured);
    let sigma = size.as_ref().ok().map(|estimate| estimate.sigma);
    Size {
        object: object.to_owned(),
        kind: container.kind,
        shape: container.shape,
        quantity,
        method,
        predicted_mm: measured.map(|m| m.predicted_mm),
        sigma_mm: sigma.map(|s| s.total_mm),
        sigma_pitch_mm: sigma.map(|s| s.pitch_mm),
        sigma_roll_mm: sigma.map(|s| s.roll_mm),
        sigma_range_mm: sigma.map(|s| s.range_mm),
        sigma_marks_mm: sigma.map(|s| s.marks_mm),
        sigma_camera_mm: sigma.map(|s| s.camera_mm),
        sigma_mount_mm: sigma.map(|s| s.mount_mm),
        plane_z_mm: measured.map(|m| m.plane_z_mm),
        wall_slope: size.as_ref().ok().and_then(|estimate| estimate.wall_slope),
        doubts: size.as_ref().map(|estimate| estimate.doubts.clone()).unwrap_or_default(),
        marks: measured.map_or(0, |m| m.marks),
        problem: size.as_ref().err().map(ToString::to_string),
    }
}

fn text(sizes: &[Size], inputs: &InputSigma) -> String {
    let mut text = String::new();
    let width = sizes.iter().map(|size| size.object.chars().count()).max().unwrap_or(0).max("object".len());
    let _ = writeln!(text, "{:width$}  quantity  method     size, mm   sigma, mm  on plane Z, mm  doubts", "object");
    for size in sizes {
        let number = |value: Option<f64>, digits| value.map_or("-".to_owned(), |v| format!("{v:.digits$}"));
        let line = format!(
            "{:width$}  {:8}  {:7}  {:>10}  {:>10}  {:>14}  {}",
            size.object,
            size.quantity,
            size.method,
            number(size.predicted_mm, 2),
            number(size.sigma_mm, 2),
            number(size.plane_z_mm, 1),
            size.doubts.iter().map(|doubt| doubt.code()).collect::<Vec<_>>().join(","),
        );
        let _ = writeln!(text, "{}", line.trim_end());
    }
    let _ = writeln!(
        text,
        "sigma: k = 1, for {:.1} degrees of pitch and sideways tilt, {:.1} of the mount, {:.1} % and {:.0} mm of range, {:.1} px of\n       marks, {:.1} % of focal length, {:.0} px of principal point (docs/uncertainty.md)",
        inputs.pitch_rad.to_degrees(),
        inputs.mount_rad.to_degrees(),
        100.0 * inputs.range_relative,
        inputs.range_offset_mm,
        inputs.mark_px,
        100.0 * inputs.focal_relative,
        inputs.principal_px,
    );
    text
}
