//! Marks and sizes over the picture, as foxglove.ImageAnnotations.

use std::collections::BTreeMap;

use foxglove::messages::points_annotation::Type;
use foxglove::messages::{Color, ImageAnnotations, KeyValuePair, Point2, PointsAnnotation, TextAnnotation};
use model::UtcNs;

use super::{Annotating, ImageNotes, MarkNote, colour, label};
use crate::mcap_file::timestamp;

/// A line is this share of the picture's width thick; text this share of it high.
const THICKNESS: f64 = 1.0 / 800.0;
const FONT: f64 = 1.0 / 55.0;

/// A message for every image, also for those without marks: viewers show the last one until another comes.
pub(super) fn annotations(notes: &ImageNotes<'_>, what: &Annotating<'_>, time: UtcNs) -> ImageAnnotations {
    let width_px = f64::from(what.camera.size_px()[0]);
    let curve = |mark: &MarkNote| PointsAnnotation {
        timestamp: timestamp(time),
        r#type: if mark.closed { Type::LineLoop } else { Type::LineStrip }.into(),
        points: mark.points_px.iter().copied().map(corner).collect(),
        outline_color: Some(colour(what.raters, &mark.rater)),
        thickness: (width_px * THICKNESS).max(1.0),
        metadata: vec![pair("object", &mark.object), pair("rater", &mark.rater), pair("feature", mark.feature.code())],
        ..PointsAnnotation::default()
    };
    let text = |((object, rater), at): ((&str, &str), [f64; 2])| TextAnnotation {
        timestamp: timestamp(time),
        position: Some(corner(at)),
        text: label(notes, object, rater),
        font_size: (width_px * FONT).max(8.0),
        text_color: Some(Color { r: 1.0, g: 1.0, b: 1.0, a: 1.0 }),
        background_color: Some(Color { r: 0.0, g: 0.0, b: 0.0, a: 0.6 }),
        ..TextAnnotation::default()
    };
    ImageAnnotations {
        timestamp: timestamp(time),
        points: notes.marks.iter().map(curve).collect(),
        texts: places(&notes.marks).into_iter().map(text).collect(),
        ..ImageAnnotations::default()
    }
}

/// Where the text of each object and rater belongs: at the right end, where it seldom hides the object.
fn places(marks: &[MarkNote]) -> BTreeMap<(&str, &str), [f64; 2]> {
    let mut places: BTreeMap<(&str, &str), [f64; 2]> = BTreeMap::new();
    for mark in marks {
        for point in &mark.points_px {
            let place = places.entry((&mark.object, &mark.rater)).or_insert(*point);
            if point[0] > place[0] {
                *place = *point;
            }
        }
    }
    places
}

/// Foxglove counts from the corner of the first pixel, this program from its centre.
fn corner([x, y]: [f64; 2]) -> Point2 {
    Point2 { x: x + 0.5, y: y + 0.5 }
}

fn pair(key: &str, value: &str) -> KeyValuePair {
    KeyValuePair { key: key.to_owned(), value: value.to_owned() }
}
