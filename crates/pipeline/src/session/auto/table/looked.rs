//! What one picture shows of the table.

use ingest::Picture;
use model::{Kind, Shape, View};
use nalgebra::{Point2, Vector3};
use rims::Rim;
use ties::{Disc, Feature, features};

/// What a searched picture shows of the table.
pub(in crate::session::auto) struct Looked {
    /// The number of the image in the session.
    pub image: usize,
    pub view: View,
    pub features: Vec<Feature>,
}

/// Rims of less confidence may be anything that stands up, and are left out of the table as well.
const LEAST_CONFIDENCE: f64 = 0.2;
/// What stands up is left out with this much around its rim, in mm.
const AROUND_MM: f64 = 8.0;
/// The points of a rim that are taken; more say no more, since the errors of neighbours are alike.
const RIM_POINTS: usize = 32;
impl Looked {
    /// The features of the table in a picture, outside of the rims that were found in it.
    pub fn new(image: usize, picture: &Picture, view: &View, rims: &[Rim]) -> Self {
        let standing = rims.iter().filter(|rim| rim.confidence >= LEAST_CONFIDENCE);
        let camera_mm = view.pose().camera_height_mm();
        let discs: Vec<Disc> = standing.flat_map(|rim| discs_of(rim, camera_mm)).collect();
        Self { image, view: *view, features: features(picture, view, &discs) }
    }
}

/// What a container hides or shows of itself on Z = 0: its rim, and its wall below, which stands on the table nearer to the wearer. A wall moves
/// by less than the rim, so that its features might pass for those of the table.
fn discs_of(rim: &Rim, camera_mm: f64) -> impl Iterator<Item = Disc> {
    let (center_mm, reach_mm) = (Point2::from(rim.on_table_mm.0), reach_mm(rim));
    let heights: &[f64] = if rim.kind == Kind::Plate { &PLATE_HEIGHTS } else { &BOWL_HEIGHTS };
    heights.iter().map(move |share| {
        let lowered = 1.0 - (share * 2.0 * rim.on_table_mm.1 / camera_mm).min(0.5);
        Disc { center_mm: center_mm * lowered, radius_mm: reach_mm * lowered + AROUND_MM }
    })
}

/// Heights over the diameter, up to that of a deep one.
const PLATE_HEIGHTS: [f64; 2] = [0.0, 0.12];
const BOWL_HEIGHTS: [f64; 3] = [0.0, 0.25, 0.5];

/// The distance from the centre of a rim within which all of it lies, in mm on Z = 0.
fn reach_mm(rim: &Rim) -> f64 {
    // Of a rectangle a quarter of the sum of both sides is given; its corners lie further out.
    if rim.shape() == Shape::Circle { rim.on_table_mm.1 } else { 1.6 * rim.on_table_mm.1 }
}

/// Some of the rays through points of a rim, spread evenly along it.
pub(in crate::session::auto) fn rays_of(view: &View, rim: &Rim) -> Vec<Vector3<f64>> {
    let points = &rim.points_px;
    let step = points.len().div_ceil(RIM_POINTS).max(1);
    points.iter().step_by(step).filter_map(|pixel| view.camera().ray_through(*pixel).ok()).collect()
}
