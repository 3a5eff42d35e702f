//! COCO's JSON: object detection and keypoints (<https://cocodataset.org/#format-data>).

mod file;

use std::path::Path;

use serde::Deserialize;
use serde_json::value::RawValue;

use super::ExchangeError;
use super::foreign::{Annotation, Drawn, Foreign, ForeignImage, Form, NamedPoint, Refused, Sight, short};
use crate::json;
use file::{ById, CocoAnnotation, CocoCategory, CocoFile, CocoImage, Id, Segmentation};

/// The content of a file. `path` is for messages.
///
/// # Errors
/// [`ExchangeError::Coco`] where it is not COCO's JSON, [`ExchangeError::LabelMe`] where it is LabelMe's.
pub fn parse(text: &str, path: &Path) -> Result<Foreign, ExchangeError> {
    let bytes = json::with_null_for_nan(text.as_bytes());
    let file: CocoFile<'_> =
        serde_json::from_slice(&bytes).map_err(|source| ExchangeError::Coco { path: path.to_owned(), source })?;
    let (Some(images), Some(annotations), Some(categories)) = (file.images, file.annotations, file.categories) else {
        if file.shapes.is_some() {
            return Err(ExchangeError::LabelMe { path: path.to_owned() });
        }
        let source = serde::de::Error::custom("images, annotations or categories are missing");
        return Err(ExchangeError::Coco { path: path.to_owned(), source });
    };
    let mut foreign = Foreign::default();
    let images = images_by_id(&images, &mut foreign);
    let categories = categories_by_id(&categories, &mut foreign);
    for (number, value) in (1..).zip(annotations) {
        let refuse = |fact| Refused { place: format!("annotation {number} of the file"), fact };
        let annotation: CocoAnnotation<'_> = match entry(value) {
            Ok(annotation) => annotation,
            Err(fact) => {
                foreign.refused.push(refuse(fact));
                continue;
            }
        };
        let place = annotation.place(number);
        match images.find(annotation.image_id).map(|at| foreign.images.get_mut(*at)) {
            Ok(Some(image)) => image.annotations.push(annotation_of(&annotation, place, &categories)),
            Ok(None) => {}
            Err(fact) => foreign.refused.push(Refused { place, fact }),
        }
    }
    Ok(foreign)
}

/// An image, category or annotation, whose values may still be odd.
fn entry<'a, T: Deserialize<'a>>(value: &'a RawValue) -> Result<T, String> {
    serde_json::from_str(value.get()).map_err(|error| format!("cannot be read: {error}"))
}

/// The numbers of the images in `foreign`, to which they are added, by id. An image that stands there twice is one image.
fn images_by_id(images: &[&RawValue], foreign: &mut Foreign) -> ById<usize> {
    let mut by_id = ById::new("image_id", "images");
    for (number, value) in (1..).zip(images) {
        let read = || {
            let image: CocoImage<'_> = entry(value)?;
            let id = Id::read("id", image.id)?.ok_or("it has no id")?;
            let size_px = image.size_px();
            let read = ForeignImage {
                place: format!("image id {id}"),
                name: json::text_of(image.file_name).unwrap_or_default(),
                size_px: size_px.clone().unwrap_or_default(),
                fault: size_px.err(),
                annotations: Vec::new(),
            };
            Ok((id, read))
        };
        match read() {
            Ok((id, image)) => {
                if !by_id.items(&id).any(|at| foreign.images.get(*at) == Some(&image)) {
                    by_id.insert(id, foreign.images.len());
                    foreign.images.push(image);
                }
            }
            Err(fact) => foreign.refused.push(Refused { place: format!("image {number} of the file"), fact }),
        }
    }
    by_id
}

/// What a category says of its annotations.
#[derive(PartialEq)]
struct Category {
    name: String,
    /// The names of its keypoints, or why they cannot be read.
    keypoints: Result<Vec<String>, String>,
}

fn categories_by_id(categories: &[&RawValue], foreign: &mut Foreign) -> ById<Category> {
    let mut by_id = ById::new("category_id", "categories");
    for (number, value) in (1..).zip(categories) {
        let read = || {
            let category: CocoCategory<'_> = entry(value)?;
            let id = Id::read("id", category.id)?.ok_or("it has no id")?;
            let name = json::text_of(category.name).ok_or_else(|| format!("category id {id}: it has no name"))?;
            let names = |value: &RawValue| serde_json::from_str(value.get());
            let keypoints = category.keypoints.map_or(Ok(Vec::new()), names);
            let keypoints =
                keypoints.map_err(|error| format!("keypoints of category id {id}: expected names: {error}"));
            Ok::<_, String>((id, Category { name, keypoints }))
        };
        match read() {
            Ok((id, category)) => {
                if !by_id.items(&id).any(|known| *known == category) {
                    by_id.insert(id, category);
                }
            }
            Err(fact) => foreign.refused.push(Refused { place: format!("category {number} of the file"), fact }),
        }
    }
    by_id
}

fn annotation_of(annotation: &CocoAnnotation<'_>, place: String, categories: &ById<Category>) -> Annotation {
    let category = categories.find(annotation.category_id);
    let label = category.as_ref().map(|category| category.name.clone()).unwrap_or_default();
    let drawn = category.and_then(|category| drawing(annotation, category)).unwrap_or_else(Drawn::Unusable);
    Annotation { place, label, attributes: annotation.attributes(), drawn }
}

/// The drawing of an annotation. Keypoints come first: a segmentation beside them is the object's outline, and no mark.
fn drawing(annotation: &CocoAnnotation<'_>, category: &Category) -> Result<Drawn, String> {
    let segmentation = annotation.segmentation();
    if let Some(keypoints) = annotation.keypoints()? {
        let points = named(&keypoints, category)?;
        let is_there = points.iter().any(|point| point.sight != Sight::Absent);
        if is_there || matches!(segmentation, Ok(Segmentation::None)) {
            return Ok(Drawn::Named(points));
        }
    }
    if annotation.is_crowd()? {
        return Err("iscrowd: several objects in one annotation; mark one at a time".to_owned());
    }
    match segmentation? {
        Segmentation::Polygons(parts) => polygons(&parts),
        Segmentation::None => Err("a box says nothing of a rim: mark it by a polygon or keypoints".to_owned()),
        Segmentation::Mask => {
            Err("a mask (RLE) says which pixels, not where the rim is: mark it by a polygon or keypoints".to_owned())
        }
    }
}

/// The outline of several polygons: parts of what something hides in places belong to one outline.
fn polygons(parts: &[Vec<f64>]) -> Result<Drawn, String> {
    if let Some(part) = parts.iter().find(|part| part.len() < 6 || part.len() % 2 != 0) {
        let fact = "expected polygons of 3 points and more, as x,y,x,y,x,y; got a part with";
        return Err(format!("{fact} {} numbers; lines are marked by keypoints", part.len()));
    }
    let form = if parts.len() == 1 { Form::Polygon } else { Form::Loose };
    let points_px = parts.iter().flat_map(|part| part.as_chunks::<2>().0).copied().collect();
    Ok(Drawn::Points { form, points_px })
}

fn named(numbers: &[f64], category: &Category) -> Result<Vec<NamedPoint>, String> {
    let names = category.keypoints.as_ref().map_err(String::clone)?;
    if numbers.len() != 3 * names.len() {
        let (got, expected) = (numbers.len(), 3 * names.len());
        return Err(format!("expected {expected} numbers, 3 for each of the category's keypoints, got {got}"));
    }
    let point = |(name, &[x, y, visibility]): (&String, &[f64; 3])| {
        let sight = [Sight::Absent, Sight::Hidden, Sight::Seen].into_iter().zip([0.0, 1.0, 2.0]);
        let sight = sight.into_iter().find(|(_, value): &(Sight, f64)| (value - visibility).abs() < 1e-9);
        let (sight, _) =
            sight.ok_or_else(|| format!("'{}': expected a visibility of 0, 1 or 2, got {visibility}", short(name)))?;
        Ok(NamedPoint { name: name.clone(), point_px: [x, y], sight })
    };
    names.iter().zip(numbers.as_chunks::<3>().0).map(point).collect()
}

#[cfg(test)]
mod tests;
