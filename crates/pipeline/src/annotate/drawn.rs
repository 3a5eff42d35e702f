//! Draws marks and sizes on a picture, for viewers that show pictures without overlays.

use std::collections::{BTreeMap, BTreeSet};

use ingest::{ImageNotes, MarkNote, Picture};
use model::{Mark, ObjectMarks, ResultRow, Shape, View, resampled_px};
use nalgebra::Point2;

use crate::overlay::{Drawn, draw};

/// The longer side of the drawn picture.
const SIDE_PX: u32 = 1296;
const QUALITY: u8 = 80;

/// The picture, reduced and drawn on, as a JPEG file.
pub(super) fn drawn(notes: &ImageNotes<'_>, jpeg: &[u8]) -> Result<Vec<u8>, String> {
    let mut picture = Picture::decode(jpeg).map_err(|error| error.to_string())?.reduced(SIDE_PX);
    if let Some(view) = &notes.view {
        let size_px = [picture.width_px, picture.height_px];
        let camera = view.camera().resampled(size_px).map_err(|error| error.to_string())?;
        let whole_px = view.camera().size_px();
        let place = |point| Point2::from(resampled_px(point, whole_px, size_px));
        draw(&mut picture, &View::new(camera, *view.pose()), &objects(notes, place));
    }
    picture.to_jpeg(QUALITY).map_err(|error| error.to_string())
}

/// The objects to be drawn, with the marks of all raters together: their sizes are written below each other.
fn objects(notes: &ImageNotes<'_>, place: impl Fn([f64; 2]) -> Point2<f64>) -> Vec<Drawn> {
    let mut by_object: BTreeMap<&str, Vec<&MarkNote>> = BTreeMap::new();
    for mark in &notes.marks {
        by_object.entry(&mark.object).or_default().push(mark);
    }
    let drawn = |(object, marks): (&str, Vec<&MarkNote>)| {
        let raters: BTreeSet<&str> = marks.iter().map(|mark| mark.rater.as_str()).collect();
        let of_object = notes.sizes.iter().filter(|row| row.object == object);
        let shape = of_object.clone().map(|row| row.shape).next();
        Drawn {
            shape: shape.unwrap_or(Shape::Circle),
            plane_z_mm: marks.iter().filter_map(|mark| mark.plane_z_mm).fold(0.0, f64::max),
            marks: ObjectMarks {
                object: object.to_owned(),
                marks: marks.into_iter().filter_map(|mark| resampled(mark, &place)).collect(),
            },
            text: std::iter::once(object.to_owned())
                .chain(of_object.filter_map(|row| line(row, raters.len() > 1)))
                .collect(),
        }
    };
    by_object.into_iter().map(drawn).collect()
}

/// The mark in the reduced picture. A line has two ends, a curve more.
fn resampled(mark: &MarkNote, place: impl Fn([f64; 2]) -> Point2<f64>) -> Option<Mark> {
    let points_px: Vec<Point2<f64>> = mark.points_px.iter().copied().map(place).collect();
    match points_px.as_slice() {
        [] => None,
        // Of a line only its ends are drawn, whatever they measure.
        &[a, b] if !mark.closed => Some(Mark::Line { quantity: model::Quantity::Diameter, ends_px: [a, b] }),
        _ => Some(Mark::Outline { feature: mark.feature, points_px }),
    }
}

/// The line of text for a size, in ASCII as the drawn letters are; with the rater where there are several.
fn line(row: &ResultRow, names_rater: bool) -> Option<String> {
    let rater = if names_rater { format!("{} ", row.rater) } else { String::new() };
    let sigma = row.sigma_mm.map(|mm| format!(" +- {mm:.1}")).unwrap_or_default();
    Some(format!("{rater}{} {:.1}{sigma} mm", row.quantity, row.predicted_mm?))
}
