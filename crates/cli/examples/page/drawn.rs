//! A drawn picture of a table with a plate, and marks on it.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::io::Cursor;

use image::{ImageFormat, Rgb, RgbImage};
use model::{Feature, GalleryMark, GalleryPicture, PictureView, ResultRow};

const WIDTH: u32 = 640;
const HEIGHT: u32 = 480;
/// Centre (x, y) and half axes (along x, along y) of the plate's rim, in px.
const RIM_PX: [f64; 4] = [320.0, 250.0, 190.0, 130.0];

/// The picture that stands for every image.
pub struct Scene {
    jpeg: Vec<u8>,
    first: bool,
}

impl Scene {
    pub fn new() -> anyhow::Result<Self> {
        let mut jpeg = Cursor::new(Vec::new());
        RgbImage::from_fn(WIDTH, HEIGHT, colour).write_to(&mut jpeg, ImageFormat::Jpeg)?;
        Ok(Self { jpeg: jpeg.into_inner(), first: true })
    }

    /// The pictures of the images that the rows of a session were measured on.
    pub fn pictures(&mut self, rows: &[ResultRow]) -> Vec<GalleryPicture> {
        let mut marked: BTreeMap<(&str, &str), Vec<&ResultRow>> = BTreeMap::new();
        for row in rows {
            if let Some(image) = &row.image {
                marked.entry((&row.session, image)).or_default().push(row);
            }
        }
        let mut pictures = Vec::new();
        for ((session, image), rows) in marked {
            let views = [PictureView::Camera, PictureView::Corrected, PictureView::Plane];
            let views = if std::mem::take(&mut self.first) { &views[..] } else { &views[..1] };
            pictures.extend(views.iter().map(|view| GalleryPicture {
                session: session.to_owned(),
                image: image.to_owned(),
                view: *view,
                size_px: [WIDTH, HEIGHT],
                jpeg: self.jpeg.clone(),
                marks: marks(&rows),
            }));
        }
        pictures
    }
}

fn colour(x: u32, y: u32) -> Rgb<u8> {
    let [cx, cy, a, b] = RIM_PX;
    let (dx, dy) = ((f64::from(x) - cx) / a, (f64::from(y) - cy) / b);
    let shade = u8::try_from(y / 8).unwrap_or(0);
    match dx.hypot(dy) {
        r if r < 0.7 => Rgb([226, 222, 212]),
        r if r < 1.0 => Rgb([244, 242, 236]),
        _ => Rgb([118 + shade, 92 + shade, 68 + shade]),
    }
}

/// One outline per object and rater, each a little larger than the one before.
fn marks(rows: &[&ResultRow]) -> Vec<GalleryMark> {
    let mut names: Vec<(&str, &str)> = rows.iter().map(|row| (row.object.as_str(), row.rater.as_str())).collect();
    names.sort_unstable();
    names.dedup();
    let mark = |(place, (object, rater)): (usize, &(&str, &str))| GalleryMark {
        object: (*object).to_owned(),
        rater: (*rater).to_owned(),
        feature: Feature::Rim,
        closed: true,
        points_px: rim(1.0 - 0.12 * f64::from(u32::try_from(place).unwrap_or(0))),
    };
    names.iter().enumerate().map(mark).collect()
}

fn rim(scale: f64) -> Vec<[f64; 2]> {
    let [cx, cy, a, b] = RIM_PX;
    let point = |part: i32| {
        let angle = TAU * f64::from(part) / 48.0;
        [cx + scale * a * angle.cos(), cy + scale * b * angle.sin()]
    };
    (0..48).map(point).collect()
}
