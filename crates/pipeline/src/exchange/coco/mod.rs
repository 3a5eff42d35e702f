//! COCO's JSON: object detection and keypoints (<https://cocodataset.org/#format-data>).

mod file;

use std::collections::BTreeMap;
use std::path::Path;

use super::ExchangeError;
use super::foreign::{Annotation, Drawn, Foreign, ForeignImage, Form, NamedPoint, Refused, Sight, short};
use file::{Category, CocoAnnotation, CocoFile, Id, Numbers, Segmentation};

/// The content of a file. `path` is for messages.
///
/// # Errors
/// [`ExchangeError::Coco`] where it is not COCO's JSON, [`ExchangeError::LabelMe`] where it is LabelMe's.
pub fn parse(text: &str, path: &Path) -> Result<Foreign, ExchangeError> {
    let file: CocoFile =
        serde_json::from_str(text).map_err(|source| ExchangeError::Coco { path: path.to_owned(), source })?;
    let (Some(images), Some(annotations), Some(categories)) = (file.images, file.annotations, file.categories) else {
        if file.shapes.is_some() {
            return Err(ExchangeError::LabelMe { path: path.to_owned() });
        }
        let source = serde::de::Error::custom("images, annotations or categories are missing");
        return Err(ExchangeError::Coco { path: path.to_owned(), source });
    };
    let mut foreign = Foreign::default();
    let mut image_of = BTreeMap::new();
    for image in images {
        if image_of.insert(image.id.clone(), foreign.images.len()).is_some() {
            return Err(twice("image", &image.id, path));
        }
        foreign.images.push(ForeignImage {
            place: format!("image id {}", image.id),
            name: image.file_name.unwrap_or_default(),
            size_px: image.width.zip(image.height).map(|(width, height)| [width, height]),
            annotations: Vec::new(),
        });
    }
    let categories = by_id(categories, path)?;
    for annotation in annotations {
        let place = annotation.place();
        match image_of.get(&annotation.image_id).and_then(|at| foreign.images.get_mut(*at)) {
            Some(image) => image.annotations.push(annotation_of(annotation, place, &categories)),
            None => {
                let fact = format!("image_id {} is not among the images", annotation.image_id);
                foreign.refused.push(Refused { place, fact });
            }
        }
    }
    Ok(foreign)
}

fn by_id(categories: Vec<Category>, path: &Path) -> Result<BTreeMap<Id, Category>, ExchangeError> {
    let mut by_id = BTreeMap::new();
    for category in categories {
        if let Some(first) = by_id.insert(category.id.clone(), category) {
            return Err(twice("category", &first.id, path));
        }
    }
    Ok(by_id)
}

/// The error of an id that stands there twice: what refers to it cannot be told apart.
fn twice(what: &str, id: &Id, path: &Path) -> ExchangeError {
    let source = serde::de::Error::custom(format!("{what} id {id} stands there twice"));
    ExchangeError::Coco { path: path.to_owned(), source }
}

fn annotation_of(annotation: CocoAnnotation, place: String, categories: &BTreeMap<Id, Category>) -> Annotation {
    let category = categories.get(&annotation.category_id);
    let drawn = match category {
        Some(category) => drawing(&annotation, category).unwrap_or_else(Drawn::Unusable),
        None => Drawn::Unusable(format!("category_id {} is not among the categories", annotation.category_id)),
    };
    let attributes = annotation.attributes.map(file::Attributes::into_text).unwrap_or_default();
    Annotation { place, label: category.map(|category| category.name.clone()).unwrap_or_default(), attributes, drawn }
}

/// The drawing of an annotation. Keypoints come first: a segmentation beside them is the object's outline, and no mark.
fn drawing(annotation: &CocoAnnotation, category: &Category) -> Result<Drawn, String> {
    if let Some(keypoints) = annotation.keypoints.as_ref().filter(|keypoints| !keypoints.is_empty()) {
        let points = named(keypoints, category)?;
        if points.iter().any(|point| point.sight != Sight::Absent) || annotation.segmentation.is_empty() {
            return Ok(Drawn::Named(points));
        }
    }
    match &annotation.segmentation {
        _ if annotation.is_crowd() => Err("iscrowd: several objects in one annotation; mark one at a time".to_owned()),
        Segmentation::Polygons(parts) if !parts.is_empty() => polygons(parts),
        Segmentation::Polygons(_) | Segmentation::None => {
            Err("a box says nothing of a rim: mark it by a polygon or keypoints".to_owned())
        }
        Segmentation::Object(keys) if keys.contains_key("counts") => {
            Err("a mask (RLE) says which pixels, not where the rim is: mark it by a polygon or keypoints".to_owned())
        }
        Segmentation::Object(_) | Segmentation::Other(_) => {
            Err("segmentation: expected polygons, [[x1,y1,x2,y2,x3,y3,...]]".to_owned())
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

fn named(keypoints: &Numbers, category: &Category) -> Result<Vec<NamedPoint>, String> {
    let Numbers::List(numbers) = keypoints else {
        return Err("keypoints: expected numbers, x,y,visibility,...".to_owned());
    };
    let names = category.keypoints.as_deref().unwrap_or_default();
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
