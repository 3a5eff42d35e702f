//! Rims of plates and bowls found without marks.
//!
//! The pose is known, so a level circle at any height is a circle on the plane Z = 0 ([`ground`]). Edges of the picture at a
//! reduced scale are linked to chains ([`edges`], [`chains`]), carried to that plane, and vote there for circles ([`votes`]);
//! likely circles are fitted ([`arcs`], [`fitting`], [`support`]; four edges at a time, [`lanes`]), carried from inner to
//! outer edges ([`outward`]), weighed against chance ([`significance`]), and one per container is kept ([`select`]). In the
//! full picture the outer edge is found ([`lip`], [`rays`], [`rings`]) and followed ([`refine`]). The height comes from foot
//! and wall below the rim and the floor within it ([`height`], [`wall`], [`floor`]).
//!
//! Rectangles are found among the same edges, where they are asked for ([`squares`]).
//!
//! A found rim becomes the same [`ObjectMarks`] as a person's marks, and is measured by the same code.

mod arcs;
mod buckets;
mod chains;
mod edges;
mod fitting;
mod floor;
mod found;
mod ground;
mod height;
mod lanes;
mod lip;
mod outward;
mod raster;
mod rays;
mod refine;
mod rings;
mod scaled;
mod search;
mod select;
mod shapes;
mod significance;
mod sizes;
mod squares;
mod support;
#[cfg(test)]
mod tests;
mod votes;
mod wall;

use ingest::Picture;
use model::{Feature, Kind, Mark, ObjectMarks, Shape, View};
use nalgebra::{Point2, Point3};

use buckets::Buckets;
pub use found::Found;
use height::Heights;
pub(crate) use height::as_judged;
pub use height::{HeightSource, RimHeight};
use refine::Followed;
use scaled::Scaled;
use select::Scored;
pub use shapes::{RimShape, UnknownRimShape};
pub use significance::{Evidence, FEATURES};
pub use squares::{SQUARE_FEATURES, SquareEvidence};

/// A rim found in a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Rim {
    /// From 0 to 1: how sure it is that this is the rim of a container.
    pub confidence: f64,
    /// What it looks like: plates are flat and large.
    pub kind: Kind,
    /// How sure that is: natural logarithm of the odds of a plate against a bowl.
    pub plate_log_odds: f64,
    /// Where the centre of the rim appears.
    pub center_px: Point2<f64>,
    /// Points along it, in order, where the picture shows it; of a rectangle its four corners.
    pub points_px: Vec<Point2<f64>>,
    /// Length of the rim as it appears.
    pub perimeter_px: f64,
    /// What speaks for it.
    pub evidence: Evidence,
    /// Its height if it is a bowl's.
    pub height: RimHeight,
    /// Its height if it is a plate's.
    pub plate_height: RimHeight,
    /// Centre (world X, Y) and radius of the circle that it appears as on the plane Z = 0, in mm; of a rectangle a quarter of
    /// the sum of both sides.
    pub on_table_mm: ([f64; 2], f64),
    /// What speaks for it besides, if it is a rectangle; none of a round rim.
    pub square: Option<SquareEvidence>,
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

/// Version of what is found. A change of meaning gives another number, and pictures are searched anew.
pub(crate) const VERSION: u32 = 3;
/// Plates and bowls are wider; cups, mugs and drinking glasses are not. A study may set another limit.
pub const LEAST_DIAMETER_MM: f64 = 90.0;
/// Fewer points do not hold a rim.
pub(crate) const LEAST_POINTS: usize = 12;

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
    let found_px = [picture.width_px, picture.height_px];
    if found_px != view.camera().size_px() {
        return Err(RimError::Size { found_px, expected_px: view.camera().size_px() });
    }
    let expected = 3 * picture.width_px as usize * picture.height_px as usize;
    if picture.rgb.len() != expected {
        return Err(RimError::Bytes { found: picture.rgb.len(), expected });
    }
    let scaled = Scaled::of(picture, view.camera().focal_px()[0]);
    let ground = ground::ground_edges(view, &scaled);
    let mut rims = Vec::new();
    if shapes.contains(&RimShape::Circle) {
        let (buckets, pieces) = (Buckets::new(&ground.edges), Buckets::new(&ground.pieces));
        let found = search::rims(view, &buckets, &pieces);
        rims.extend(found.iter().filter_map(|found| in_full(picture, view, &buckets, found, scaled.factor)));
    }
    if shapes.contains(&RimShape::Rectangle) {
        let squares = squares::squares(picture, view, &ground.edges, scaled.factor);
        rims.extend(squares.into_iter().map(|square| square.rim(view)));
    }
    rims.sort_by(|a, b| b.confidence.total_cmp(&a.confidence));
    Ok(rims)
}

/// A circle that was found, followed through the full picture; none where too little of it is seen there.
#[expect(clippy::cast_precision_loss, reason = "a small factor")]
fn in_full(picture: &Picture, view: &View, buckets: &Buckets, found: &Scored, factor: usize) -> Option<Rim> {
    let arc = lip::outer_edge(picture, view, found.arc.clone(), factor);
    let Followed { points_px, sharp } = refine::follow(picture, view, &arc, factor);
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

impl Rim {
    /// Its diameter if it is what it looks like, in mm.
    #[must_use]
    pub fn diameter_mm(&self, view: &View) -> f64 {
        let height = if self.kind == Kind::Plate { self.plate_height } else { self.height };
        2.0 * self.on_table_mm.1 * (1.0 - height.mm / view.pose().camera_height_mm())
    }

    /// Its outline.
    #[must_use]
    pub fn shape(&self) -> Shape {
        if self.square.is_some() { Shape::Rectangle } else { Shape::Circle }
    }

    /// The marks that a person would have made.
    #[must_use]
    pub fn marks(&self, object: &str) -> ObjectMarks {
        let marks = vec![Mark::Outline { feature: Feature::Rim, points_px: self.points_px.clone() }];
        ObjectMarks { object: object.to_owned(), marks }
    }
}
