//! `measure --overlay`: draws the measured outlines and sizes on the picture.

use anyhow::Context;
use ingest::Picture;
use model::{Container, Kind, Method, ObjectMarks, View};
use pipeline::overlay::{Drawn, draw};
use rims::Rim;

use super::args::MeasureArgs;
use super::size::Size;
use crate::exit::Failure;

/// Writes the picture with people's marks and their sizes, where an overlay is asked for.
pub fn write_marked(
    args: &MeasureArgs,
    view: &View,
    bytes: &[u8],
    container: &Container,
    objects: &[ObjectMarks],
    sizes: &[Size],
) -> Result<(), Failure> {
    if args.overlay.is_none() {
        return Ok(());
    }
    let picture = Picture::decode(bytes).with_context(|| format!("picture {}", args.image.display()))?;
    let drawn: Vec<Drawn> = objects
        .iter()
        .map(|marks| {
            let of_object: Vec<&Size> = sizes.iter().filter(|size| size.object == marks.object).collect();
            let known = container.rim_height_mm.or((container.kind == Kind::Plate).then_some(0.0));
            let on_rim = of_object.iter().filter(|size| size.method == Method::Ray).filter_map(|size| size.plane_z_mm);
            Drawn {
                marks: marks.clone(),
                shape: container.shape,
                plane_z_mm: known.unwrap_or_else(|| on_rim.fold(0.0, f64::max)),
                text: lines(&marks.object, None, of_object),
            }
        })
        .collect();
    write(args, view, picture, &drawn)
}

/// The outline and the lines of text that are drawn for a found rim.
pub fn found_rim(rim: &Rim, container: &Container, object: &str, sizes: &[Size]) -> Drawn {
    Drawn {
        marks: rim.marks(object),
        shape: container.shape,
        plane_z_mm: rim.height_as(container).mm,
        text: lines(object, Some(rim.confidence), sizes),
    }
}

fn lines<'a>(object: &str, confidence: Option<f64>, sizes: impl IntoIterator<Item = &'a Size>) -> Vec<String> {
    let head = confidence.map_or(object.to_owned(), |confidence| format!("{object} {confidence:.2}"));
    let by_ray = sizes.into_iter().filter(|size| size.method == Method::Ray);
    let sizes = by_ray.filter_map(|size| {
        let sigma = size.sigma_mm.map_or(String::new(), |mm| format!(" +- {mm:.1}"));
        Some(format!("{} {:.1}{sigma} mm", size.quantity, size.predicted_mm?))
    });
    std::iter::once(head).chain(sizes).collect()
}

/// Writes the picture with everything drawn on it as PNG, where an overlay is asked for.
pub fn write(args: &MeasureArgs, view: &View, mut picture: Picture, drawn: &[Drawn]) -> Result<(), Failure> {
    let Some(file) = &args.overlay else { return Ok(()) };
    draw(&mut picture, view, drawn);
    let png = picture.to_png().context("overlay")?;
    ::report::write_file(file, &png)?;
    Ok(())
}
