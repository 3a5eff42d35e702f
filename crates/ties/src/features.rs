//! The features of one picture.

use ingest::Picture;
use model::View;
use nalgebra::{Point2, Point3};

use crate::corners::corners;
use crate::descriptor::{Describer, Descriptor, MARGIN};
pub use crate::ground::Disc;
use crate::ground::{Grid, Ground, Luma};

/// The scales at which the table is looked at, in mm of a pixel: fine grain, and what is left of it further away.
const SCALES_MM: [f64; 3] = [1.25, 1.5, 1.8];
/// The most features of one scale.
const MOST_OF_SCALE: [usize; 3] = [300, 300, 300];

/// A feature of the table, in one picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Feature {
    /// The pixel that shows it.
    pub pixel: Point2<f64>,
    /// World X and Y on Z = 0 by the view of its picture, in mm.
    pub at_mm: Point2<f64>,
    pub(crate) descriptor: Descriptor,
}

/// The features of the table in a picture, but for those within `left_out`. The same bytes give the same features.
#[must_use]
pub fn features(picture: &Picture, view: &View, left_out: &[Disc]) -> Vec<Feature> {
    let (luma, grid) = (Luma::from_picture(picture), Grid::new(view));
    let mut features = Vec::new();
    for (mm_per_px, most) in SCALES_MM.into_iter().zip(MOST_OF_SCALE) {
        let ground = Ground::new(&luma, &grid, left_out, mm_per_px);
        let describer = Describer::new(&ground);
        for corner in corners(&ground, MARGIN, most) {
            let at_mm = ground.place_mm(corner.place);
            let Ok(pixel) = view.pixel_of(Point3::new(at_mm.x, at_mm.y, 0.0)) else { continue };
            features.push(Feature { pixel, at_mm, descriptor: describer.describe(corner.column, corner.row) });
        }
    }
    features
}
