//! The JSON of a COCO file. An odd value spoils the annotation, image or category that holds it, not the file: values are kept as
//! they stand in the text until they are asked for.

use std::collections::BTreeMap;
use std::fmt;

use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::value::RawValue;

use crate::exchange::foreign::short;
use crate::json;

#[derive(Deserialize)]
pub(super) struct CocoFile<'a> {
    #[serde(borrow)]
    pub images: Option<Vec<&'a RawValue>>,
    #[serde(borrow)]
    pub annotations: Option<Vec<&'a RawValue>>,
    #[serde(borrow)]
    pub categories: Option<Vec<&'a RawValue>>,
    /// The key of a LabelMe file.
    pub shapes: Option<IgnoredAny>,
}

/// An id: a number or a text. `7`, `7.0` and `"7"` are one id, since tools and tables write whole numbers in all of these ways.
#[derive(Debug, Clone)]
pub(super) struct Id {
    /// The same text for all ways of writing the id.
    pub key: String,
    /// The JSON of the id.
    pub written: String,
}

impl Id {
    /// The id in the field `name`; none where it is missing.
    ///
    /// # Errors
    /// A text, where it is neither a number nor a text.
    pub fn read(name: &str, value: Option<&RawValue>) -> Result<Option<Self>, String> {
        let Some(value) = value else { return Ok(None) };
        let odd = || format!("{name}: expected a number or a text, got {}", short(value.get().trim_matches('"')));
        let text = json::text_of(Some(value)).ok_or_else(odd)?;
        let key = json::whole_number(&text).unwrap_or_else(|| text.trim().to_owned());
        Ok(Some(Self { key, written: value.get().to_owned() }))
    }
}

impl fmt::Display for Id {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        short(&self.key).fmt(f)
    }
}

/// Images or categories by their ids.
pub(super) struct ById<T> {
    /// The name of a field that refers to them, and their name in the file.
    names: [&'static str; 2],
    by_key: BTreeMap<String, Vec<(String, T)>>,
}

impl<T> ById<T> {
    pub fn new(field: &'static str, list: &'static str) -> Self {
        Self { names: [field, list], by_key: BTreeMap::new() }
    }

    pub fn insert(&mut self, id: Id, item: T) {
        self.by_key.entry(id.key).or_default().push((id.written, item));
    }

    /// The items that have this id, in any way of writing it.
    pub fn items(&self, id: &Id) -> impl Iterator<Item = &T> {
        self.by_key.get(&id.key).into_iter().flatten().map(|(_, item)| item)
    }

    /// The one item that an annotation refers to by `value`. Of several, it is the one whose id is written in the same way.
    ///
    /// # Errors
    /// A text, where there is none, or several.
    pub fn find(&self, value: Option<&RawValue>) -> Result<&T, String> {
        let [field, list] = self.names;
        let id = Id::read(field, value)?.ok_or_else(|| format!("{field} is missing"))?;
        let items = self.by_key.get(&id.key).map(Vec::as_slice).unwrap_or_default();
        let same: Vec<&T> = items.iter().filter(|(written, _)| *written == id.written).map(|(_, item)| item).collect();
        match (items, same.as_slice()) {
            ([], _) => Err(format!("{field} {id} is not among the {list}")),
            ([(_, item)], _) => Ok(item),
            (_, &[item]) => Ok(item),
            (several, _) => {
                Err(format!("{field} {id} stands for {} of the {list}, which cannot be told apart", several.len()))
            }
        }
    }
}

#[derive(Deserialize)]
pub(super) struct CocoImage<'a> {
    #[serde(borrow)]
    pub id: Option<&'a RawValue>,
    #[serde(borrow)]
    pub file_name: Option<&'a RawValue>,
    #[serde(borrow)]
    width: Option<&'a RawValue>,
    #[serde(borrow)]
    height: Option<&'a RawValue>,
}

impl CocoImage<'_> {
    /// The width and height; none where one of them is missing.
    ///
    /// # Errors
    /// A text, where one is no whole number of pixels.
    pub fn size_px(&self) -> Result<Option<[u32; 2]>, String> {
        let side = |name: &str, value: Option<&RawValue>| {
            let Some(value) = value else { return Ok(None) };
            let whole = json::text_of(Some(value)).and_then(|text| json::whole_number(&text)?.parse::<u32>().ok());
            let odd =
                || format!("{name}: expected a whole number of pixels, got '{}'", short(value.get().trim_matches('"')));
            whole.ok_or_else(odd).map(Some)
        };
        let (width, height) = (side("width", self.width)?, side("height", self.height)?);
        Ok(width.zip(height).map(|(width, height)| [width, height]))
    }
}

#[derive(Deserialize)]
pub(super) struct CocoCategory<'a> {
    #[serde(borrow)]
    pub id: Option<&'a RawValue>,
    #[serde(borrow)]
    pub name: Option<&'a RawValue>,
    #[serde(borrow)]
    pub keypoints: Option<&'a RawValue>,
}

#[derive(Deserialize)]
pub(super) struct CocoAnnotation<'a> {
    #[serde(borrow)]
    id: Option<&'a RawValue>,
    #[serde(borrow)]
    pub image_id: Option<&'a RawValue>,
    #[serde(borrow)]
    pub category_id: Option<&'a RawValue>,
    #[serde(borrow)]
    segmentation: Option<&'a RawValue>,
    #[serde(borrow)]
    keypoints: Option<&'a RawValue>,
    #[serde(borrow)]
    attributes: Option<&'a RawValue>,
    #[serde(borrow)]
    iscrowd: Option<&'a RawValue>,
}

pub(super) enum Segmentation {
    None,
    Polygons(Vec<Vec<f64>>),
    /// RLE.
    Mask,
}

impl CocoAnnotation<'_> {
    /// The place of the annotation, which is the `number`-th of the file.
    pub fn place(&self, number: usize) -> String {
        match Id::read("id", self.id) {
            Ok(Some(id)) => format!("annotation id {id}"),
            Ok(None) | Err(_) => format!("annotation {number} of the file, without an id"),
        }
    }

    /// Whether there are several objects in one annotation.
    ///
    /// # Errors
    /// A text, where `iscrowd` is neither 0 nor 1.
    pub fn is_crowd(&self) -> Result<bool, String> {
        let Some(value) = self.iscrowd else { return Ok(false) };
        let number = json::text_of(Some(value)).and_then(|text| json::whole_number(&text));
        match (value.get(), number.as_deref()) {
            ("false", _) | (_, Some("0")) => Ok(false),
            ("true", _) | (_, Some("1")) => Ok(true),
            (odd, _) => Err(format!("iscrowd: expected 0 or 1, got {}", short(odd))),
        }
    }

    pub fn segmentation(&self) -> Result<Segmentation, String> {
        let Some(value) = self.segmentation else { return Ok(Segmentation::None) };
        let has_counts = || serde_json::from_str::<BTreeMap<String, IgnoredAny>>(value.get()).ok()?.remove("counts");
        match serde_json::from_str::<Vec<Vec<f64>>>(value.get()) {
            Ok(parts) if parts.is_empty() => Ok(Segmentation::None),
            Ok(parts) => Ok(Segmentation::Polygons(parts)),
            Err(_) if has_counts().is_some() => Ok(Segmentation::Mask),
            Err(error) => Err(format!("segmentation: expected polygons, [[x1,y1,x2,y2,x3,y3,...]]: {error}")),
        }
    }

    /// The numbers of the keypoints, x,y,visibility for each; none where there are none.
    ///
    /// # Errors
    /// A text, where they are no list of numbers.
    pub fn keypoints(&self) -> Result<Option<Vec<f64>>, String> {
        let Some(value) = self.keypoints else { return Ok(None) };
        let numbers: Vec<f64> = serde_json::from_str(value.get())
            .map_err(|error| format!("keypoints: expected numbers, x,y,visibility,...: {error}"))?;
        Ok(Some(numbers).filter(|numbers| !numbers.is_empty()))
    }

    /// The attributes, which CVAT and Datumaro write, that are texts or numbers.
    pub fn attributes(&self) -> BTreeMap<String, String> {
        let Some(value) = self.attributes else { return BTreeMap::new() };
        let map: BTreeMap<String, &RawValue> = serde_json::from_str(value.get()).unwrap_or_default();
        map.into_iter().filter_map(|(key, value)| Some((key, json::text_of(Some(value))?))).collect()
    }
}
