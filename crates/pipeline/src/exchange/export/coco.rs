//! Writes COCO's JSON.

use std::collections::BTreeMap;
use std::io;

use model::Quantity;
use serde::Serialize;

use super::{Labelled, MarkedImage, labels};
use crate::exchange::label::What;

#[derive(Serialize)]
struct File<'a> {
    info: Info<'a>,
    licenses: [(); 0],
    images: Vec<Image<'a>>,
    annotations: Vec<Annotation>,
    categories: Vec<Category<'a>>,
}

#[derive(Serialize)]
struct Info<'a> {
    description: &'a str,
    contributor: &'a str,
}

#[derive(Serialize)]
struct Image<'a> {
    id: usize,
    width: u32,
    height: u32,
    file_name: &'a str,
}

#[derive(Serialize)]
struct Category<'a> {
    id: usize,
    name: &'a str,
    supercategory: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    keypoints: Option<[&'static str; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    skeleton: Option<[[u8; 2]; 1]>,
}

#[derive(Serialize)]
struct Annotation {
    id: usize,
    image_id: usize,
    category_id: usize,
    segmentation: Vec<Vec<f64>>,
    area: f64,
    bbox: [f64; 4],
    iscrowd: u8,
    #[serde(skip_serializing_if = "Option::is_none")]
    keypoints: Option<Vec<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    num_keypoints: Option<usize>,
}

/// The text of the file.
pub(super) fn text(images: &[MarkedImage], study: &str, program: &str) -> io::Result<String> {
    let labels = labels(images);
    let categories = (1..).zip(&labels).map(|(id, (name, what))| category(id, name, *what)).collect();
    let id_of: BTreeMap<&str, usize> = labels.keys().map(String::as_str).zip(1..).collect();
    let mut annotations = Vec::new();
    for (image_id, image) in (1..).zip(images) {
        for mark in &image.marks {
            let category_id = id_of.get(mark.label().as_str()).copied().unwrap_or_default();
            annotations.push(annotation(annotations.len() + 1, image_id, category_id, mark));
        }
    }
    let image = |(id, image): (usize, &'_ MarkedImage)| (id, image.size_px, image.name.clone());
    let named: Vec<_> = (1..).zip(images).map(image).collect();
    let images = named.iter().map(|(id, [width, height], file_name)| Image {
        id: *id,
        width: *width,
        height: *height,
        file_name,
    });
    let info = Info { description: study, contributor: program };
    let file = File { info, licenses: [], images: images.collect(), annotations, categories };
    Ok(serde_json::to_string(&file)? + "\n")
}

fn category(id: usize, name: &str, what: What) -> Category<'_> {
    let keypoints = match what {
        What::Line(Quantity::Height) => Some(["foot", "rim"]),
        What::Line(_) => Some(["1", "2"]),
        What::Outline(_) => None,
    };
    let supercategory = name.rsplit_once('/').map_or(name, |(object, _)| object);
    Category { id, name, supercategory, keypoints, skeleton: keypoints.map(|_| [[1, 2]]) }
}

fn annotation(id: usize, image_id: usize, category_id: usize, mark: &Labelled) -> Annotation {
    let flat = || mark.points_px.iter().flatten().copied().collect::<Vec<f64>>();
    let (segmentation, keypoints) = match mark.what {
        What::Outline(_) => (vec![flat()], None),
        What::Line(_) => (Vec::new(), Some(mark.points_px.iter().flat_map(|[x, y]| [*x, *y, 2.0]).collect::<Vec<_>>())),
    };
    Annotation {
        id,
        image_id,
        category_id,
        segmentation,
        area: if keypoints.is_some() { 0.0 } else { area_px2(&mark.points_px) },
        bbox: bounding_box(&mark.points_px),
        iscrowd: 0,
        num_keypoints: keypoints.as_ref().map(|keypoints| keypoints.len() / 3),
        keypoints,
    }
}

/// The area of a polygon, by the shoelace formula.
fn area_px2(points: &[[f64; 2]]) -> f64 {
    let next = points.iter().cycle().skip(1);
    0.5 * points.iter().zip(next).map(|([ax, ay], [bx, by])| ax * by - bx * ay).sum::<f64>().abs()
}

/// The bounding box: x, y, width, height.
fn bounding_box(points: &[[f64; 2]]) -> [f64; 4] {
    let over =
        |axis: fn(&[f64; 2]) -> f64, fold: fn(f64, f64) -> f64| points.iter().map(axis).reduce(fold).unwrap_or(0.0);
    let ([left, top], [right, bottom]) =
        ([over(|p| p[0], f64::min), over(|p| p[1], f64::min)], [over(|p| p[0], f64::max), over(|p| p[1], f64::max)]);
    [left, top, right - left, bottom - top]
}
