//! Marks and sizes over the picture, as foxglove.ImageAnnotations.

use std::collections::{BTreeMap, BTreeSet};

use foxglove::messages::points_annotation::Type;
use foxglove::messages::{Color, ImageAnnotations, KeyValuePair, Point2, PointsAnnotation, TextAnnotation};
use model::UtcNs;

use super::{Annotating, ImageNotes, MarkNote, colour, label};
use crate::mcap_file::timestamp;

/// A line is this share of the picture's width thick; text this share of it high.
const THICKNESS: f64 = 1.0 / 800.0;
const FONT: f64 = 1.0 / 55.0;
/// From one line of text to the next, in its height.
const LINE: f64 = 1.4;

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
    let font_px = (width_px * FONT).max(8.0);
    let text = |(line, object, rater, [x, y]): (usize, &str, &str, [f64; 2])| TextAnnotation {
        timestamp: timestamp(time),
        position: Some(corner([x, y + LINE * font_px * line as f64])),
        text: label(notes, object, rater),
        font_size: font_px,
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

/// Line, object, rater and place of each text: at the right end of the object, where it seldom hides it, one rater below the other.
fn places(marks: &[MarkNote]) -> Vec<(usize, &str, &str, [f64; 2])> {
    let mut objects: BTreeMap<&str, ([f64; 2], BTreeSet<&str>)> = BTreeMap::new();
    for mark in marks {
        for point in &mark.points_px {
            let (place, raters) = objects.entry(&mark.object).or_insert((*point, BTreeSet::new()));
            raters.insert(&mark.rater);
            if point[0] > place[0] {
                *place = *point;
            }
        }
    }
    let lines = |(object, (place, raters)): (_, ([f64; 2], BTreeSet<_>))| {
        raters.into_iter().enumerate().map(move |(line, rater)| (line, object, rater, place))
    };
    objects.into_iter().flat_map(lines).collect()
}

/// Foxglove counts from the corner of the first pixel, this program from its centre.
fn corner([x, y]: [f64; 2]) -> Point2 {
    Point2 { x: x + 0.5, y: y + 0.5 }
}

fn pair(key: &str, value: &str) -> KeyValuePair {
    KeyValuePair { key: key.to_owned(), value: value.to_owned() }
}
