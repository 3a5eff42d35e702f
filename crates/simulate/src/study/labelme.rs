//! Marks in the format of LabelMe.

use model::Quantity;
use nalgebra::Point2;
use serde::Serialize;

use crate::error::SimulateError;

/// The version of LabelMe whose layout is written.
const LABELME_VERSION: &str = "5.5.0";

/// A marked line with the label `OBJECT/QUANTITY`.
#[derive(Debug, Clone, PartialEq)]
pub struct LabeledLine {
    /// The object.
    pub object: String,
    /// The quantity that the line's length stands for.
    pub quantity: Quantity,
    /// Its two ends.
    pub ends_px: [Point2<f64>; 2],
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct LabelMe<'a> {
    version: &'static str,
    flags: Flags,
    shapes: Vec<Shape>,
    image_path: &'a str,
    image_data: Option<&'static str>,
    image_height: u32,
    image_width: u32,
}

#[derive(Serialize)]
struct Flags {}

#[derive(Serialize)]
struct Shape {
    label: String,
    points: [[f64; 2]; 2],
    group_id: Option<u32>,
    shape_type: &'static str,
    flags: Flags,
}

/// A LabelMe file as UTF-8, with a line feed at the end. `image_path` is relative to the file's own folder, and `size_px` is
/// width and height. Coordinates are rounded to 1e-9 px, so that they do not depend on the last bit of a sine.
///
/// # Errors
/// [`SimulateError::Json`].
pub fn labelme_json(image_path: &str, size_px: [u32; 2], lines: &[LabeledLine]) -> Result<Vec<u8>, SimulateError> {
    let file = LabelMe {
        version: LABELME_VERSION,
        flags: Flags {},
        shapes: lines.iter().map(shape).collect(),
        image_path,
        image_data: None,
        image_height: size_px[1],
        image_width: size_px[0],
    };
    let mut bytes = serde_json::to_vec_pretty(&file)
        .map_err(|source| SimulateError::Json { place: image_path.to_owned(), source })?;
    bytes.push(b'\n');
    Ok(bytes)
}

fn shape(line: &LabeledLine) -> Shape {
    Shape {
        label: format!("{}/{}", line.object, line.quantity),
        points: line.ends_px.map(|end| [end.x, end.y].map(|c| (c * 1e9).round() / 1e9)),
        group_id: None,
        shape_type: "line",
        flags: Flags {},
    }
}
