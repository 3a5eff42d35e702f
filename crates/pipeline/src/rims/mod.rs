//! Rims of plates and bowls found without marks.
//!
//! The pose is known, so a level circle at any height is a circle on the plane Z = 0 ([`ground`]). Edges of the picture at a
//! reduced scale are linked to chains ([`edges`], [`chains`]), carried to that plane, and vote there for circles
//! ([`votes`]); likely circles are fitted ([`arcs`]), carried from inner to outer edges ([`outward`]), weighed against
//! chance ([`significance`]), and one per container is kept ([`select`]). The rim is then followed through the full picture
//! ([`refine`]). Its height comes from the foot below it ([`height`]).
//!
//! A found rim becomes the same [`ObjectMarks`] as a person's marks, and is measured by the same code.

mod arcs;
mod buckets;
mod chains;
mod edges;
mod found;
mod ground;
mod height;
mod outward;
mod raster;
mod refine;
mod scaled;
mod search;
mod select;
mod significance;
mod sizes;
#[cfg(test)]
mod tests;
mod votes;

use ingest::Picture;
use model::{Feature, Kind, Mark, ObjectMarks, View};
use nalgebra::{Point2, Point3};

use arcs::Arc;
use buckets::Buckets;
pub use found::Found;
pub use height::{HeightSource, RimHeight};
use scaled::Scaled;

/// A rim found in a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Rim {
    /// From 0 to 1: how sure it is that this is the rim of a container.
    pub confidence: f64,
    /// What it looks like: plates are flat and large.
    pub kind: Kind,
    /// Where the centre of the rim appears.
    pub center_px: Point2<f64>,
    /// Points along it, in order, where the picture shows it.
    pub points_px: Vec<Point2<f64>>,
    /// Length of the rim as it appears.
    pub perimeter_px: f64,
    /// Share of the rim that has an edge along it, of what lies in the picture.
    pub coverage: f64,
    /// Its height if it is a bowl's.
    pub height: RimHeight,
    /// Centre (world X, Y) and radius of the circle that it appears as on the plane Z = 0, in mm.
    pub on_table_mm: ([f64; 2], f64),
}

/// Why rims cannot be looked for.
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

/// Plates are wider than this (the second: nothing else is), and lower than this share of their diameter.
const PLATE_MM: f64 = 190.0;
const ALWAYS_PLATE_MM: f64 = 220.0;
const PLATE_HEIGHT: f64 = 0.3;
/// Version of what is found. A change of meaning gives another number, and pictures are searched anew.
pub(crate) const VERSION: u32 = 1;
/// Fewer points do not hold a rim.
pub(crate) const LEAST_POINTS: usize = 12;

/// The rims in a picture taken from a known pose, most likely first.
///
/// # Errors
/// [`RimError`] when the picture is not of the camera's size, or not all there.
pub fn find_rims(picture: &Picture, view: &View) -> Result<Vec<Rim>, RimError> {
    let found_px = [picture.width_px, picture.height_px];
    if found_px != view.camera().size_px() {
        return Err(RimError::Size { found_px, expected_px: view.camera().size_px() });
    }
    let expected = 3 * picture.width_px as usize * picture.height_px as usize;
    if picture.rgb.len() != expected {
        return Err(RimError::Bytes { found: picture.rgb.len(), expected });
    }
    let scaled = Scaled::of(picture);
    let buckets = Buckets::new(&ground::ground_edges(view, &scaled));
    let rims = search::rims(view, &buckets);
    Ok(rims
        .iter()
        .filter_map(|found| {
            let height = height::of_bowl(&buckets, &found.arc, view.pose().camera_height_mm());
            let points_px = refine::follow(picture, view, &found.arc, scaled.factor);
            let center_px = view.pixel_of(Point3::new(found.arc.disc.x, found.arc.disc.y, 0.0)).ok()?;
            (points_px.len() >= LEAST_POINTS).then(|| Rim {
                kind: kind(&found.arc, height, view),
                confidence: found.confidence,
                center_px,
                points_px,
                perimeter_px: found.arc.perimeter_px * scaled.factor as f64,
                coverage: found.evidence.coverage,
                on_table_mm: ([found.arc.disc.x, found.arc.disc.y], found.arc.disc.radius),
                height,
            })
        })
        .collect())
}

/// What it looks like: a plate is very wide, or wide without a high wall below its rim (a shadow may look like a low one).
fn kind(arc: &Arc, height: RimHeight, view: &View) -> Kind {
    let on_table_mm = 2.0 * arc.disc.radius;
    let diameter_mm = on_table_mm * (1.0 - height.mm / view.pose().camera_height_mm());
    let shows_a_wall = height.source == HeightSource::Foot && height.mm > PLATE_HEIGHT * diameter_mm;
    if on_table_mm >= ALWAYS_PLATE_MM || (on_table_mm >= PLATE_MM && !shows_a_wall) { Kind::Plate } else { Kind::Bowl }
}

impl Rim {
    /// The marks that a person would have made.
    #[must_use]
    pub fn marks(&self, object: &str) -> ObjectMarks {
        let marks = vec![Mark::Outline { feature: Feature::Rim, points_px: self.points_px.clone() }];
        ObjectMarks { object: object.to_owned(), marks }
    }
}
