//! The content of a file of another annotation tool, before it is known what it means for a study.

use std::collections::BTreeMap;

/// The content of a file.
#[derive(Debug, Default, PartialEq)]
pub struct Foreign {
    /// The pictures in the order of the file, with what is drawn on them.
    pub images: Vec<ForeignImage>,
    /// Annotations that belong to no picture, or could not be read.
    pub refused: Vec<Refused>,
}

/// Something that was left out, with the reason.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refused {
    /// The place where it stands: a line, an id, an image.
    pub place: String,
    /// The fault (what was expected, and what was there), and what to do about it.
    pub fact: String,
}

/// A picture that somebody marked.
#[derive(Debug, PartialEq)]
pub struct ForeignImage {
    /// The place where it stands in the file.
    pub place: String,
    /// The name, often with folders.
    pub name: String,
    /// The width and height as the tool saw them.
    pub size_px: Option<[u32; 2]>,
    /// The reason why nothing on it can be used: its size is given, but cannot be read.
    pub fault: Option<String>,
    /// The annotations on it, in the order of the file.
    pub annotations: Vec<Annotation>,
}

/// One thing drawn on a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Annotation {
    /// The place where it stands in the file.
    pub place: String,
    /// CVAT's label, or COCO's category.
    pub label: String,
    /// The attributes.
    pub attributes: BTreeMap<String, String>,
    /// The drawing.
    pub drawn: Drawn,
}

/// A drawing. Pixels are the tool's own: x to the right, y down, (0, 0) at the corner of the first pixel.
#[derive(Debug, Clone, PartialEq)]
pub enum Drawn {
    /// Points in order.
    Points {
        /// The way they are joined.
        form: Form,
        /// The points.
        points_px: Vec<[f64; 2]>,
    },
    /// Points with names: a skeleton of CVAT, or keypoints of COCO.
    Named(Vec<NamedPoint>),
    /// An ellipse.
    Ellipse(Ellipse),
    /// Something that gives no marks, and why.
    Unusable(String),
}

/// The way the points of a drawing are joined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// A closed line.
    Polygon,
    /// An open line.
    Polyline,
    /// Points that are not joined.
    Loose,
}

/// A point with a name.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedPoint {
    /// The name in the skeleton.
    pub name: String,
    /// The place, in pixels of the tool.
    pub point_px: [f64; 2],
    /// Whether it was seen.
    pub sight: Sight,
}

/// Whether a named point was seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sight {
    /// It was seen: COCO's visibility 2.
    Seen,
    /// It was placed where something hides it: COCO's 1, CVAT's `occluded`.
    Hidden,
    /// It is not there: COCO's 0, CVAT's `outside`.
    Absent,
}

/// An ellipse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ellipse {
    /// The centre.
    pub centre_px: [f64; 2],
    /// The half axes along x and y, before it is turned.
    pub half_axes_px: [f64; 2],
    /// The angle by which it is turned clockwise about its centre, as one sees it.
    pub rotation_rad: f64,
}

impl Ellipse {
    /// Points at even steps of its parameter, beginning at the end of the first half axis.
    #[must_use]
    pub fn points_px(&self, count: u32) -> Vec<[f64; 2]> {
        let ([cx, cy], [rx, ry]) = (self.centre_px, self.half_axes_px);
        let (sin, cos) = self.rotation_rad.sin_cos();
        let point = |i: u32| {
            let (s, c) = (std::f64::consts::TAU * f64::from(i) / f64::from(count)).sin_cos();
            [cx + rx * c * cos - ry * s * sin, cy + rx * c * sin + ry * s * cos]
        };
        (0..count).map(point).collect()
    }
}

/// The part of a text from outside that a message can hold, on one line.
pub(super) fn short(text: &str) -> String {
    const MOST: usize = 60;
    let start: String = text.chars().take(MOST).collect();
    let more = if start.len() < text.len() { "..." } else { "" };
    format!("{}{more}", start.escape_debug())
}
