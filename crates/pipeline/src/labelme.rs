//! Reads marks from LabelMe files (<https://github.com/wkentaro/labelme>), and writes such files.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use ingest::nfc;
use model::{Feature, Mark, ObjectMarks, Quantity};
use nalgebra::Point2;
use serde::Deserialize;

use crate::json::with_null_for_nan;
pub use error::MarksError;
use rims::Found;
pub(crate) use write::{AutoRim, Shape as OutShape, text_of, text_of_shapes};

mod error;
mod write;

/// A file of marks is never larger than this (LabelMe may embed the picture itself).
const LARGEST_FILE_BYTES: u64 = 256 * 1024 * 1024;

/// The labels that are read, for messages.
const EXPECTED: &str =
    "OBJECT/diameter, OBJECT/width, OBJECT/length or OBJECT/height as a line, OBJECT/rim or OBJECT/base as a polygon";

/// The content of one file.
#[derive(Debug, Default)]
pub struct Marks {
    /// The marks by object, in the order of their names.
    pub objects: Vec<ObjectMarks>,
    /// The found rims behind the marks that the program made, by object.
    pub found: BTreeMap<String, Found>,
    /// The shapes that are no marks: [`MarksError::Shape`], in the order of the file.
    pub refused: Vec<MarksError>,
}

#[derive(Deserialize)]
struct LabelMeFile {
    shapes: Vec<Shape>,
    #[serde(rename = "imageWidth", default)]
    width_px: Option<u32>,
    #[serde(rename = "imageHeight", default)]
    height_px: Option<u32>,
}

#[derive(Deserialize)]
struct Shape {
    label: String,
    points: Vec<[f64; 2]>,
    #[serde(default)]
    shape_type: Option<String>,
    /// A key of this program's own, with the found rim; LabelMe keeps keys that it does not know.
    #[serde(rename = "aim_batch", default)]
    found: Option<serde_json::Value>,
}

/// The bytes of a file of marks, for [`parse`].
///
/// # Errors
/// [`MarksError::Unreadable`] and [`MarksError::TooLarge`].
pub fn read_bytes(path: &Path) -> Result<Vec<u8>, MarksError> {
    let unreadable = |source| MarksError::Unreadable { path: path.to_owned(), source };
    if !std::fs::metadata(path).map_err(unreadable)?.is_file() {
        return Err(unreadable(io::Error::other("not a regular file")));
    }
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(unreadable)?;
    file.take(LARGEST_FILE_BYTES + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > LARGEST_FILE_BYTES {
        return Err(MarksError::TooLarge { path: path.to_owned() });
    }
    Ok(bytes)
}

/// Whether a file can be read as JSON with the list of shapes that LabelMe's files have.
pub(crate) fn is_labelme(path: &Path) -> bool {
    #[derive(Deserialize)]
    struct Shapes {
        #[serde(rename = "shapes")]
        _shapes: Vec<serde::de::IgnoredAny>,
    }
    read_bytes(path).is_ok_and(|bytes| {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes);
        serde_json::from_slice::<Shapes>(&with_null_for_nan(bytes)).is_ok()
    })
}

/// The marks in the bytes of a LabelMe file. `path` is for messages; `picture_px` is the width and height of the pictures
/// that were marked.
///
/// # Errors
/// [`MarksError`] where nothing of the file can be used. A shape that is no mark is in [`Marks::refused`]; the others are
/// kept.
pub fn parse(bytes: &[u8], path: &Path, picture_px: [u32; 2]) -> Result<Marks, MarksError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes); // a byte order mark, as some editors write
    let file: LabelMeFile =
        serde_json::from_slice(bytes).map_err(|source| MarksError::Malformed { path: path.to_owned(), source })?;
    let [width, height] = picture_px;
    let (got_width, got_height) = (file.width_px.unwrap_or(width), file.height_px.unwrap_or(height));
    if [got_width, got_height] != picture_px {
        return Err(MarksError::OtherPicture { path: path.to_owned(), got_width, got_height, width, height });
    }
    let mut objects: BTreeMap<String, Vec<Mark>> = BTreeMap::new();
    let (mut refused, mut found) = (Vec::new(), BTreeMap::new());
    for (number, shape) in (1..).zip(&file.shapes) {
        let within = |(object, mark): (String, Mark)| {
            let of_object: &[Mark] = objects.get(&object).map_or(&[], Vec::as_slice);
            let points = of_object.iter().chain([&mark]).map(|mark| mark.points_px().len()).sum::<usize>();
            if of_object.len() < MOST_MARKS && points <= MOST_POINTS { Ok((object, mark)) } else { Err(too_many()) }
        };
        match mark(shape).and_then(within).and_then(|marked| Ok((marked, found_of(shape)?))) {
            Ok(((object, mark), of_shape)) => {
                found.extend(of_shape.map(|of_shape| (object.clone(), of_shape)));
                objects.entry(object).or_default().push(mark);
            }
            Err(fact) => {
                refused.push(MarksError::Shape { path: path.to_owned(), number, label: shape.label.clone(), fact });
            }
        }
    }
    let objects = objects.into_iter().map(|(object, marks)| ObjectMarks { object, marks }).collect();
    Ok(Marks { objects, found, refused })
}

/// Nobody marks one object in one picture more often, or with more points; uncertainties take memory by marks times points.
const MOST_MARKS: usize = 100;
const MOST_POINTS: usize = 20_000;

fn too_many() -> String {
    format!("expected at most {MOST_MARKS} marks and {MOST_POINTS} points of one object in one picture")
}

/// The found rim of a shape, where the program made it.
fn found_of(shape: &Shape) -> Result<Option<Found>, String> {
    let refuse = |fact: String| format!("its key aim_batch is not as this program wrote it ({fact}): remove the key");
    let Some(value) = &shape.found else { return Ok(None) };
    let found = Found::deserialize(value).map_err(|error| refuse(error.to_string()))?;
    found.fault().map_or(Ok(Some(found)), |fault| Err(refuse(fault.to_owned())))
}

fn mark(shape: &Shape) -> Result<(String, Mark), String> {
    let label = nfc(&shape.label);
    let Some((object, what)) = label.rsplit_once('/').filter(|(object, _)| !object.is_empty()) else {
        return Err(format!("expected a label like {EXPECTED}"));
    };
    if !shape.points.iter().flatten().all(|c| c.is_finite()) {
        return Err("its coordinates are not all finite numbers".to_owned());
    }
    let points_px: Vec<Point2<f64>> = shape.points.iter().map(|[x, y]| Point2::new(*x, *y)).collect();
    let shape_type = shape.shape_type.as_deref().unwrap_or("polygon");
    let mark = if let Ok(quantity) = what.parse::<Quantity>() {
        let (true, &[a, b]) = (matches!(shape_type, "line" | "linestrip"), points_px.as_slice()) else {
            return Err(format!("expected a line with 2 points, got a {shape_type} with {}", points_px.len()));
        };
        Mark::Line { quantity, ends_px: [a, b] }
    } else if let Ok(feature) = what.parse::<Feature>() {
        if !matches!(shape_type, "polygon" | "linestrip" | "points") {
            return Err(format!("expected a polygon, linestrip or points along the {feature}, got a {shape_type}"));
        }
        Mark::Outline { feature, points_px }
    } else {
        return Err(format!("'{what}' is nothing that can be marked; expected {EXPECTED}"));
    };
    Ok((object.to_owned(), mark))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use super::*;

    fn parse_shapes(shapes: &str) -> Result<Marks, MarksError> {
        let text = format!(r#"{{"version": "5.4.1", "shapes": [{shapes}], "imageWidth": 640, "imageHeight": 480}}"#);
        parse(text.as_bytes(), Path::new("m.json"), [640, 480])
    }

    #[test]
    fn lines_and_outlines_are_read_by_object() {
        let marks = parse_shapes(
            r#"{"label": "red bowl/height", "points": [[1, 2], [3, 4]], "shape_type": "line"},
               {"label": "plate/rim", "points": [[1, 2], [3, 4], [5, 6.5]], "shape_type": "polygon", "flags": {}},
               {"label": "red bowl/diameter", "points": [[1, 2], [3, 4]], "shape_type": "line", "group_id": null}"#,
        )
        .unwrap();
        let names: Vec<_> = marks.objects.iter().map(|o| (o.object.as_str(), o.marks.len())).collect();
        assert_eq!(names, [("plate", 1), ("red bowl", 2)]);
        let Mark::Outline { feature: Feature::Rim, points_px } = &marks.objects[0].marks[0] else { panic!("a rim") };
        assert_eq!(points_px[2], Point2::new(5.0, 6.5));
    }

    #[test]
    fn a_byte_order_mark_is_no_fault() {
        assert!(parse(b"\xef\xbb\xbf{\"shapes\": []}", Path::new("m.json"), [640, 480]).is_ok());
    }

    #[test]
    fn the_label_is_cut_at_its_last_slash() {
        let marks =
            parse_shapes(r#"{"label": "a/b/width", "points": [[1, 2], [3, 4]], "shape_type": "line"}"#).unwrap();
        assert_eq!(marks.objects[0].object, "a/b");
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (shape, expected) in [
            (r#"{"label": "plate", "points": [], "shape_type": "line"}"#, "expected a label like OBJECT/diameter"),
            (
                r#"{"label": "plate/girth", "points": [], "shape_type": "line"}"#,
                "'girth' is nothing that can be marked",
            ),
            (r#"{"label": "/width", "points": [], "shape_type": "line"}"#, "expected a label like"),
            (r#"{"label": "p/width", "points": [[1,2]], "shape_type": "line"}"#, "got a line with 1"),
            (r#"{"label": "p/width", "points": [[1,2],[3,4]], "shape_type": "rectangle"}"#, "got a rectangle with 2"),
            (r#"{"label": "p/rim", "points": [[1,2],[3,4]], "shape_type": "circle"}"#, "got a circle"),
        ] {
            let good = r#"{"label": "p/width", "points": [[1,2],[3,4]], "shape_type": "line"}"#;
            let marks = parse_shapes(&format!("{shape}, {good}")).unwrap();
            assert_eq!(marks.objects.len(), 1, "the other shape is kept");
            let error = marks.refused[0].to_string();
            assert!(error.contains(expected) && error.contains("shape 1") && error.contains("m.json"), "{error}");
        }
        assert!(parse_shapes(r#"{"label": 7}"#).unwrap_err().to_string().contains("line 1 column"));
    }

    #[test]
    fn marks_without_end_are_refused() {
        let line = r#"{"label": "p/width", "points": [[1,2],[3,4]], "shape_type": "line"}"#;
        let marks = parse_shapes(&vec![line; MOST_MARKS + 3].join(",")).unwrap();
        assert_eq!((marks.objects[0].marks.len(), marks.refused.len()), (MOST_MARKS, 3));
        assert!(marks.refused[0].to_string().contains("at most 100 marks"));
        let points = vec!["[1,2]"; MOST_POINTS + 1].join(",");
        let marks = parse_shapes(&format!(r#"{{"label": "p/rim", "points": [{points}]}}"#)).unwrap();
        assert_eq!((marks.objects.len(), marks.refused.len()), (0, 1));
    }

    #[test]
    fn marks_of_another_picture_are_refused() {
        let text = br#"{"shapes": [], "imageWidth": 640, "imageHeight": 480}"#;
        let error = parse(text, Path::new("m.json"), [2592, 1944]).unwrap_err();
        assert_eq!(error.code().code(), "marks_of_other_picture");
        assert!(error.to_string().contains("640 x 480") && error.to_string().contains("2592 x 1944"));
        assert!(parse(br#"{"shapes": []}"#, Path::new("m.json"), [2592, 1944]).is_ok(), "the size may be left out");
    }
}
