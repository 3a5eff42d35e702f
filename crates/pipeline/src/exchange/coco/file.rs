//! The JSON of a COCO file. What one annotation has that nobody expects spoils that annotation, not the file.

use std::collections::BTreeMap;
use std::fmt;

use serde::Deserialize;
use serde::de::IgnoredAny;

use crate::exchange::foreign::short;

#[derive(Deserialize)]
pub(super) struct CocoFile {
    pub images: Option<Vec<CocoImage>>,
    pub annotations: Option<Vec<CocoAnnotation>>,
    pub categories: Option<Vec<Category>>,
    /// The key of a LabelMe file.
    pub shapes: Option<IgnoredAny>,
}

/// An id: a number, in some tools a text.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(untagged)]
pub(super) enum Id {
    Number(i64),
    Text(String),
}

impl Default for Id {
    fn default() -> Self {
        Self::Text("(none)".to_owned())
    }
}

impl fmt::Display for Id {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => number.fmt(f),
            Self::Text(text) => short(text).fmt(f),
        }
    }
}

#[derive(Deserialize)]
pub(super) struct CocoImage {
    pub id: Id,
    pub file_name: Option<String>,
    pub width: Option<u32>,
    pub height: Option<u32>,
}

#[derive(Deserialize)]
pub(super) struct Category {
    pub id: Id,
    pub name: String,
    pub keypoints: Option<Vec<String>>,
}

#[derive(Deserialize)]
pub(super) struct CocoAnnotation {
    #[serde(default)]
    id: Option<Id>,
    pub image_id: Id,
    #[serde(default)]
    pub category_id: Id,
    #[serde(default)]
    pub segmentation: Segmentation,
    pub keypoints: Option<Numbers>,
    pub attributes: Option<Attributes>,
    iscrowd: Option<Flag>,
}

impl CocoAnnotation {
    /// Several objects in one annotation.
    pub fn is_crowd(&self) -> bool {
        match &self.iscrowd {
            Some(Flag::Number(number)) => *number != 0,
            Some(Flag::Bool(flag)) => *flag,
            Some(Flag::Other(_)) | None => false,
        }
    }

    pub fn place(&self) -> String {
        self.id.as_ref().map_or_else(|| "annotation without id".to_owned(), |id| format!("annotation id {id}"))
    }
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Flag {
    Number(i64),
    Bool(bool),
    Other(IgnoredAny),
}

#[derive(Default, Deserialize)]
#[serde(untagged)]
pub(super) enum Segmentation {
    #[default]
    None,
    Polygons(Vec<Vec<f64>>),
    /// RLE has a key `counts`.
    Object(BTreeMap<String, IgnoredAny>),
    Other(IgnoredAny),
}

impl Segmentation {
    pub fn is_empty(&self) -> bool {
        matches!(self, Self::None) || matches!(self, Self::Polygons(parts) if parts.is_empty())
    }
}

#[derive(Deserialize)]
#[serde(untagged)]
pub(super) enum Numbers {
    List(Vec<f64>),
    Other(IgnoredAny),
}

impl Numbers {
    pub fn is_empty(&self) -> bool {
        matches!(self, Self::List(numbers) if numbers.is_empty())
    }
}

/// The attributes that CVAT and Datumaro write.
#[derive(Deserialize)]
#[serde(untagged)]
pub(super) enum Attributes {
    Map(BTreeMap<String, Value>),
    Other(IgnoredAny),
}

#[derive(Deserialize)]
#[serde(untagged)]
pub(super) enum Value {
    Text(String),
    Other(IgnoredAny),
}

impl Attributes {
    /// The attributes that are texts, or can be written as such.
    pub fn into_text(self) -> BTreeMap<String, String> {
        let Self::Map(map) = self else { return BTreeMap::new() };
        let text = |(key, value): (String, Value)| match value {
            Value::Text(text) => Some((key, text)),
            Value::Other(_) => None,
        };
        map.into_iter().filter_map(text).collect()
    }
}
