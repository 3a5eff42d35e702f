//! All steps of the search in one picture.

use ingest::Picture;
use model::{Kind, View};
use nalgebra::Point3;

use crate::circles::{self, Buckets, Scored};
use crate::edges::{Scaled, ground_edges};
use crate::evidence::Evidence;
use crate::height::{self, Heights};
use crate::outline::{Followed, RingPair, follow, outer_edge, pairs};
use crate::rim::Rim;
use crate::shape::RimShape;
use crate::squares::squares;

/// Version of the search. A change of what it finds gives another number, and pictures are searched anew.
pub const VERSION: u32 = 3;
/// The least diameter of plates and bowls, in mm; cups, mugs and drinking glasses are narrower. A study may set another limit.
pub const LEAST_DIAMETER_MM: f64 = 90.0;
/// The least number of points along a rim: fewer do not fix it.
pub const LEAST_POINTS: usize = 12;

/// The reason why rims cannot be looked for.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum RimError {
    /// The picture is not the camera's.
    #[error(
        "the picture is {found_px:?} px, but the camera's pictures are {expected_px:?}: give this picture's camera"
    )]
    Size {
        /// Width and height of the picture.
        found_px: [u32; 2],
        /// Width and height by the camera.
        expected_px: [u32; 2],
    },
    /// The picture does not hold three bytes per pixel.
    #[error("the picture holds {found} bytes, but its size asks for {expected}")]
    Bytes {
        /// Bytes of the picture.
        found: usize,
        /// Three per pixel.
        expected: usize,
    },
}

/// The round rims in a picture taken from a known pose, most likely first.
///
/// # Errors
/// [`RimError`] when the picture is not of the camera's size, or not all there.
pub fn find_rims(picture: &Picture, view: &View) -> Result<Vec<Rim>, RimError> {
    find_rims_of(picture, view, &[RimShape::Circle])
}

/// The rims of these shapes in a picture taken from a known pose, most likely first.
///
/// # Errors
/// [`RimError`] when the picture is not of the camera's size, or not all there.
pub fn find_rims_of(picture: &Picture, view: &View, shapes: &[RimShape]) -> Result<Vec<Rim>, RimError> {
    check(picture, view)?;
    let scaled = Scaled::from_picture(picture, view.camera().focal_px()[0]);
    let ground = ground_edges(view, &scaled);
    let mut rims = Vec::new();
    if shapes.contains(&RimShape::Circle) {
        let (buckets, pieces) = (Buckets::new(&ground.edges), Buckets::new(&ground.pieces));
        let found = circles::rims(view, &buckets, &pieces);
        rims.extend(found.iter().filter_map(|found| in_full(picture, view, &buckets, found, scaled.factor)));
    }
    if shapes.contains(&RimShape::Rectangle) {
        let squares = squares(picture, view, &ground.edges, scaled.factor);
        rims.extend(squares.into_iter().map(|square| square.rim(view)));
    }
    rims.sort_by(|a, b| b.confidence.total_cmp(&a.confidence));
    Ok(rims)
}

/// The pairs of edges about the likely circles of a picture, of which the outer edges of the rims are chosen: the cases to which the
/// set `ring` of weights.toml is fitted (example `rings`).
///
/// # Errors
/// [`RimError`] when the picture is not of the camera's size, or not all there.
pub fn ring_pairs(picture: &Picture, view: &View) -> Result<Vec<RingPair>, RimError> {
    check(picture, view)?;
    let scaled = Scaled::from_picture(picture, view.camera().focal_px()[0]);
    let ground = ground_edges(view, &scaled);
    let (buckets, pieces) = (Buckets::new(&ground.edges), Buckets::new(&ground.pieces));
    let found = circles::rims(view, &buckets, &pieces);
    Ok(found.iter().flat_map(|found| pairs(picture, view, &found.arc, scaled.factor)).collect())
}

/// Whether the picture is the camera's, and all there.
fn check(picture: &Picture, view: &View) -> Result<(), RimError> {
    let found_px = [picture.width_px, picture.height_px];
    if found_px != view.camera().size_px() {
        return Err(RimError::Size { found_px, expected_px: view.camera().size_px() });
    }
    let expected = 3 * picture.width_px as usize * picture.height_px as usize;
    if picture.rgb.len() != expected {
        return Err(RimError::Bytes { found: picture.rgb.len(), expected });
    }
    Ok(())
}

/// The rim of a circle that was found, followed through the full picture; none where too little of it is seen there.
#[expect(clippy::cast_precision_loss, reason = "a small factor")]
fn in_full(picture: &Picture, view: &View, buckets: &Buckets, found: &Scored, factor: usize) -> Option<Rim> {
    let arc = outer_edge(picture, view, found.arc.clone(), factor);
    let Followed { points_px, sharp } = follow(picture, view, &arc, factor);
    if points_px.len() < LEAST_POINTS {
        return None;
    }
    let Heights { plate, bowl, plate_log_odds } = height::of_rim(buckets, &arc, view.pose().camera_height_mm());
    let evidence = Evidence { sharp, ..found.best };
    Some(Rim {
        confidence: evidence.confidence(),
        evidence,
        kind: if plate_log_odds >= 0.0 { Kind::Plate } else { Kind::Bowl },
        plate_log_odds,
        center_px: view.pixel_of(Point3::new(arc.disc.x, arc.disc.y, 0.0)).ok()?,
        points_px,
        perimeter_px: arc.perimeter_px * factor as f64,
        height: bowl,
        plate_height: plate,
        on_table_mm: ([arc.disc.x, arc.disc.y], arc.disc.radius),
        square: None,
    })
}
