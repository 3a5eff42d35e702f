//! Writes LabelMe files that a person can open, check and correct, from found rims and from marks of other tools.

use std::borrow::Cow;

use model::{Feature, Mark, ObjectMarks};
use nalgebra::Point2;
use serde::{Deserialize, Serialize};

use rims::Found;

use super::frame::MarkedPicture;
use super::seal::{FileKey, Sealed, seal_of};

/// The version of LabelMe whose files these are like.
const LABELME_VERSION: &str = "5.4.1";

/// A found rim in an image of a session, under the name that it has in that session.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct AutoRim {
    pub object: String,
    /// The points along it, in pixels of the marks camera's pictures.
    pub points_px: Vec<[f64; 2]>,
    pub found: Found,
}

impl AutoRim {
    /// The marks that a person would have made.
    pub fn marks(&self) -> ObjectMarks {
        let points_px = self.points_px.iter().copied().map(Point2::from).collect();
        ObjectMarks { object: self.object.clone(), marks: vec![Mark::Outline { feature: Feature::Rim, points_px }] }
    }
}

#[derive(Serialize)]
struct File<'a> {
    version: &'a str,
    flags: NoFlags,
    shapes: Vec<Shape<'a>>,
    #[serde(rename = "imagePath")]
    image_path: &'a str,
    #[serde(rename = "imageData")]
    image_data: Option<()>,
    #[serde(rename = "imageHeight")]
    image_height: u32,
    #[serde(rename = "imageWidth")]
    image_width: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    aim_batch: Option<FileKey>,
}

#[derive(Serialize)]
struct NoFlags {}

/// A shape of a file.
#[derive(Serialize)]
pub(crate) struct Shape<'a> {
    label: String,
    points: Cow<'a, [[f64; 2]]>,
    group_id: Option<()>,
    shape_type: &'static str,
    flags: NoFlags,
    #[serde(skip_serializing_if = "Option::is_none")]
    aim_batch: Option<Found>,
}

impl<'a> Shape<'a> {
    fn from_rim(rim: &'a AutoRim) -> Self {
        let label = format!("{}/{}", rim.object, Feature::Rim);
        Self { aim_batch: Some(rim.found), ..Self::new(label, "polygon", &rim.points_px) }
    }

    /// A shape; `shape_type` is LabelMe's word, and `points` count pixels as LabelMe does.
    pub fn new(label: String, shape_type: &'static str, points: &'a [[f64; 2]]) -> Self {
        let points = Cow::Borrowed(points);
        Self { label, points, group_id: None, shape_type, flags: NoFlags {}, aim_batch: None }
    }
}

/// The text of a file with these rims, sealed as the program's own work. `image_path` is the way to the picture from where the file will
/// be. The rims are in the frame of the stored picture, and the text is in the one that LabelMe shows.
pub(crate) fn text_of(
    rims: &[AutoRim],
    image_path: &str,
    picture: impl Into<MarkedPicture>,
) -> serde_json::Result<String> {
    let mut file = file_of(rims.iter().map(Shape::from_rim).collect(), image_path, picture.into());
    let sealed = file
        .shapes
        .iter()
        .map(|shape| Sealed::new(&shape.label, shape.shape_type, &shape.points, shape.aim_batch.as_ref()));
    file.aim_batch = Some(FileKey { marks_sha256: seal_of(sealed.collect())? });
    text(&file)
}

/// The text of a file with these shapes, which are a person's; see [`text_of`].
pub(crate) fn text_of_shapes(
    shapes: Vec<Shape<'_>>,
    image_path: &str,
    picture: impl Into<MarkedPicture>,
) -> serde_json::Result<String> {
    text(&file_of(shapes, image_path, picture.into()))
}

fn text(file: &File<'_>) -> serde_json::Result<String> {
    serde_json::to_string_pretty(file).map(|text| text + "\n")
}

/// The file with these shapes, carried over to the frame that LabelMe shows.
fn file_of<'a>(mut shapes: Vec<Shape<'a>>, image_path: &'a str, picture: MarkedPicture) -> File<'a> {
    let frame = picture.written_frame();
    let [image_width, image_height] = picture.size_in(frame);
    for point_px in shapes.iter_mut().flat_map(|shape| shape.points.to_mut()) {
        *point_px = picture.from_stored(frame, *point_px);
    }
    let (version, flags, image_data) = (LABELME_VERSION, NoFlags {}, None);
    File { version, flags, shapes, image_path, image_data, image_height, image_width, aim_batch: None }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use std::path::Path;

    use model::{Kind, Shape};

    use super::*;
    use crate::labelme::parse;
    use rims::{HeightSource, RimHeight};

    fn rim() -> AutoRim {
        let height = RimHeight { mm: 61.234_567_890_123_4, sigma_mm: 0.1 + 0.2, source: HeightSource::Foot };
        let points_px = (0..40).map(|i| [300.123 + f64::from(i).sin() / 3.0, 0.1 * f64::from(i)]).collect();
        let plate_height = Some(RimHeight { mm: 12.3, ..height });
        let found = Found {
            kind: Kind::Bowl,
            shape: Shape::Circle,
            confidence: 1.0 / 3.0,
            perimeter_px: 512.7,
            height,
            plate_height,
        };
        AutoRim { object: "auto-2".to_owned(), points_px, found }
    }

    #[test]
    fn what_is_written_is_read_to_the_bit() {
        let text = text_of(&[rim()], "../a.jpg", [640, 480]).unwrap();
        let marks = parse(text.as_bytes(), Path::new("a.json"), [640, 480]).unwrap();
        assert!(marks.refused.is_empty(), "{:?}", marks.refused);
        assert_eq!(marks.objects, [rim().marks()]);
        assert_eq!(marks.found.into_iter().collect::<Vec<_>>(), [("auto-2".to_owned(), rim().found)]);
    }

    #[test]
    fn only_rectangles_say_their_shape() {
        let round = text_of(&[rim()], "../a.jpg", [640, 480]).unwrap();
        assert!(!round.contains("\"shape\""));
        let found = Found { shape: Shape::Rectangle, kind: Kind::Plate, ..rim().found };
        let square = AutoRim { points_px: vec![[1.0, 2.0], [9.0, 2.0], [9.0, 7.0], [1.0, 7.0]], found, ..rim() };
        let text = text_of(std::slice::from_ref(&square), "../a.jpg", [640, 480]).unwrap();
        let marks = parse(text.as_bytes(), Path::new("a.json"), [640, 480]).unwrap();
        assert_eq!(marks.objects, [square.marks()]);
        assert_eq!(marks.found["auto-2"].shape, Shape::Rectangle);
    }

    #[test]
    fn numbers_that_nothing_could_have_found_are_refused() {
        let text = text_of(&[rim()], "../a.jpg", [640, 480]).unwrap();
        for (from, to) in [
            ("\"perimeter_px\": 512.7", "\"perimeter_px\": 0"),
            ("\"sigma_mm\": 0.3", "\"sigma_mm\": -0.3"),
            ("\"confidence\": 0.3", "\"confidence\": 1.3"),
            ("\"bowl\"", "\"spoon\""),
        ] {
            let changed = text.replace(from, to);
            assert_ne!(changed, text);
            let marks = parse(changed.as_bytes(), Path::new("a.json"), [640, 480]).unwrap();
            assert_eq!((marks.objects.len(), marks.refused.len()), (0, 1), "{to}");
            assert!(marks.refused[0].to_string().contains("remove the key"), "{}", marks.refused[0]);
        }
    }
}
