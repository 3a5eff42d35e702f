//! Reads marks from LabelMe files (<https://github.com/wkentaro/labelme>), and writes such files.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use ingest::nfc;
use model::{Feature, Mark, ObjectMarks, Quantity};
use nalgebra::Point2;
use serde::Deserialize;
use serde::de::Error;
use serde_json::value::RawValue;

use crate::json;
use corners::FourCorners;
pub use error::MarksError;
pub use frame::{FrameFault, MarkedPicture, MarksFrame};
use rims::Found;
pub use seal::MarksAuthor;
pub(crate) use seal::{author_of, seal_in};
pub(crate) use write::{AutoRim, Shape as OutShape, text_of, text_of_shapes};

mod corners;
mod error;
mod frame;
mod seal;
mod write;

/// A file of marks is never larger than this (LabelMe may embed the picture itself).
const LARGEST_FILE_BYTES: u64 = 256 * 1024 * 1024;

/// The labels that are read, for messages.
const EXPECTED: &str = "OBJECT/diameter, OBJECT/width, OBJECT/length or OBJECT/height as a line, OBJECT/rim or OBJECT/base as a polygon, OBJECT/rim of a square or rectangle as an oriented rectangle";

/// The content of one file.
#[derive(Debug)]
pub struct Marks {
    /// Who made them.
    pub author: MarksAuthor,
    /// The marks by object, in the order of their names.
    pub objects: Vec<ObjectMarks>,
    /// The found rims behind the marks that the program made, by object.
    pub found: BTreeMap<String, Found>,
    /// The shapes that are no marks: [`MarksError::Shape`], in the order of the file.
    pub refused: Vec<MarksError>,
    /// The marks whose shape has four corners.
    four_corners: Vec<FourCorners>,
}

/// The values are kept as they stand in the text until they are asked for, so that an odd one spoils its shape, and not the file.
#[derive(Deserialize)]
struct LabelMeFile<'a> {
    #[serde(borrow)]
    version: Option<&'a RawValue>,
    /// X-AnyLabeling writes this key, and LabelMe does not.
    #[serde(borrow)]
    checked: Option<&'a RawValue>,
    /// A key of this program's own, with the seal of its marks; LabelMe keeps keys that it does not know.
    #[serde(rename = "aim_batch", borrow)]
    key: Option<&'a RawValue>,
    #[serde(borrow)]
    shapes: Vec<&'a RawValue>,
    #[serde(rename = "imageWidth", borrow)]
    width_px: Option<&'a RawValue>,
    #[serde(rename = "imageHeight", borrow)]
    height_px: Option<&'a RawValue>,
}

impl LabelMeFile<'_> {
    /// The width and height of the picture that was marked, each where the file says it.
    fn size_px(&self) -> Result<[Option<u32>; 2], serde_json::Error> {
        let side = |name: &str, value: Option<&RawValue>| {
            let Some(value) = value else { return Ok(None) };
            let whole = json::text_of(Some(value)).and_then(|text| json::whole_number(&text)?.parse().ok());
            let odd = || Error::custom(format!("{name}: expected a whole number of pixels, got {}", value.get()));
            whole.map(Some).ok_or_else(odd)
        };
        Ok([side("imageWidth", self.width_px)?, side("imageHeight", self.height_px)?])
    }

    /// The frame in which the program marks that wrote the file, where its version tells: LabelMe shows pictures turned since 4.0 at
    /// the latest. Other programs that write such files have versions below 4, and do or do not; X-AnyLabeling counts from 4 as well, shows
    /// the stored picture or a turned one by its version, and is known by its key `checked`.
    fn frame_of_tool(&self) -> Option<MarksFrame> {
        if self.checked.is_some() {
            return None;
        }
        let version = json::text_of(self.version)?;
        let major: u32 = version.split('.').next()?.trim().parse().ok()?;
        (major >= 4).then_some(MarksFrame::Shown)
    }
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

impl Shape {
    /// The shape, with its points carried over from a frame of the picture to the stored one.
    fn into_stored(mut self, picture: &MarkedPicture, frame: MarksFrame) -> Self {
        self.points.iter_mut().for_each(|point_px| *point_px = picture.to_stored(frame, *point_px));
        self
    }
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
        serde_json::from_slice::<Shapes>(&json::with_null_for_nan(bytes)).is_ok()
    })
}

/// The marks in the bytes of a LabelMe file, in the frame of the stored picture. `path` is for messages; `picture` is the one
/// that was marked, or its width and height where it is upright.
///
/// # Errors
/// [`MarksError`] where nothing of the file can be used. A shape that is no mark is in [`Marks::refused`]; the others are
/// kept.
pub fn parse(bytes: &[u8], path: &Path, picture: impl Into<MarkedPicture>) -> Result<Marks, MarksError> {
    let picture = picture.into();
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes); // a byte order mark, as some editors write
    let malformed = |source| MarksError::Malformed { path: path.to_owned(), source };
    let bytes = json::with_null_for_nan(bytes);
    let file: LabelMeFile<'_> = serde_json::from_slice(&bytes).map_err(malformed)?;
    let stated_px = file.size_px().map_err(malformed)?;
    let frame = frame_of_file(stated_px, file.frame_of_tool(), &picture, path)?;
    let mut objects: BTreeMap<String, Vec<Mark>> = BTreeMap::new();
    let (mut refused, mut found, mut four_corners) = (Vec::new(), BTreeMap::new(), Vec::new());
    for (number, value) in (1..).zip(&file.shapes) {
        let refuse =
            |label: &str, fact| MarksError::Shape { path: path.to_owned(), number, label: label.to_owned(), fact };
        let shape: Shape = match serde_json::from_str::<Shape>(value.get()) {
            Ok(shape) => shape.into_stored(&picture, frame),
            Err(error) => {
                refused.push(refuse("", format!("cannot be read: {error}")));
                continue;
            }
        };
        let within = |(object, mark): (String, Mark)| {
            let of_object: &[Mark] = objects.get(&object).map_or(&[], Vec::as_slice);
            let points = of_object.iter().chain([&mark]).map(|mark| mark.points_px().len()).sum::<usize>();
            if of_object.len() < MOST_MARKS && points <= MOST_POINTS { Ok((object, mark)) } else { Err(too_many()) }
        };
        match mark(&shape).and_then(within).and_then(|marked| Ok((marked, found_of(&shape)?))) {
            Ok(((object, mark), of_shape)) => {
                let earlier = objects.get(&object).map_or(0, Vec::len);
                four_corners.extend(FourCorners::new(&shape, &object, earlier, |fact| refuse(&shape.label, fact)));
                found.extend(of_shape.map(|of_shape| (object.clone(), of_shape)));
                objects.entry(object).or_default().push(mark);
            }
            Err(fact) => refused.push(refuse(&shape.label, fact)),
        }
    }
    let objects = objects.into_iter().map(|(object, marks)| ObjectMarks { object, marks }).collect();
    Ok(Marks { author: file.author(), objects, found, refused, four_corners })
}

/// The frame of the marks of a file that states these sides of its picture.
fn frame_of_file(
    stated_px: [Option<u32>; 2],
    tool: Option<MarksFrame>,
    picture: &MarkedPicture,
    path: &Path,
) -> Result<MarksFrame, MarksError> {
    let [width, height] = picture.size_px;
    let sides = match stated_px {
        [None, None] => None,
        // One side alone decides nothing where the picture is turned, and is compared with the stored one.
        [stated_width, stated_height] => Some([stated_width.unwrap_or(width), stated_height.unwrap_or(height)]),
    };
    picture.frame_of(sides, tool).map_err(|fault| match (fault, sides) {
        (FrameFault::OtherSize, Some([got_width, got_height])) => {
            MarksError::OtherPicture { path: path.to_owned(), got_width, got_height, width, height }
        }
        _ => MarksError::UnknownFrame { path: path.to_owned(), fact: picture.unknown_frame_text() },
    })
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
    let mut points_px: Vec<Point2<f64>> = shape.points.iter().map(|[x, y]| Point2::new(*x, *y)).collect();
    let shape_type = shape.shape_type.as_deref().unwrap_or("polygon");
    let mark = if let Ok(quantity) = what.parse::<Quantity>() {
        let (true, &[a, b]) = (matches!(shape_type, "line" | "linestrip"), points_px.as_slice()) else {
            return Err(format!("expected a line with 2 points, got a {shape_type} with {}", points_px.len()));
        };
        Mark::Line { quantity, ends_px: [a, b] }
    } else if let Ok(feature) = what.parse::<Feature>() {
        if feature == Feature::Rim && corners::is_four_cornered(shape_type) {
            points_px = corners::in_order(&points_px)?.to_vec();
        } else if !matches!(shape_type, "polygon" | "linestrip" | "points") {
            return Err(format!("expected a polygon, linestrip or points along the {feature}, got a {shape_type}"));
        }
        Mark::Outline { feature, points_px }
    } else {
        return Err(format!("'{what}' is nothing that can be marked; expected {EXPECTED}"));
    };
    Ok((object.to_owned(), mark))
}

#[cfg(test)]
mod tests;
