//! Bundle adjustment of the pictures of one table: poses, places of table features, and rims, solved together.
//!
//! In: for each picture its pose by the sensors and a first place in the common frame; tie points, which are features of the table plane
//! Z = 0 seen in several pictures; and points along rims, which lie on level circles at unknown heights. Out: the poses, and for each rim
//! its centre, radius and height above the table with their uncertainties.
//!
//! A rim at the height H moves against the table by b H / (c - H) when the camera, at the height c, moves by b: that is what gives the
//! height, whatever wall, foot or food do. What stays unknown is one scale, the range's, that all pictures share; it is held at the
//! sensors' value, and belongs to every size ([`BundleInput`] has no uncertainty for it).
//!
//! Source: Triggs et al., *Bundle Adjustment: A Modern Synthesis* (2000); robust weights after Cauchy.

mod normal;
mod residuals;
mod shot;
mod solve;

use nalgebra::{Point2, Vector3};

use crate::pose::Pose;

pub use solve::{BundleError, solve_bundle};

/// A picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BundleShot {
    /// The pose by the sensors.
    pub sensed: Pose,
    /// The first guess of the turn of its world frame in the common frame, in radians, counter-clockwise from above.
    pub turn_rad: f64,
    /// The first guess of the point under the camera in the common frame, in mm.
    pub foot_mm: Point2<f64>,
}

/// A feature of the table as one picture shows it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BundleTie {
    /// The number of the picture.
    pub shot: usize,
    /// The number of the feature.
    pub feature: usize,
    /// The ideal ray through its pixel, (x, y, 1) in the camera frame.
    pub ray: Vector3<f64>,
}

/// The rim of one container as one picture shows it.
#[derive(Debug, Clone, PartialEq)]
pub struct BundleRim {
    /// The number of the picture.
    pub shot: usize,
    /// The number of the container.
    pub container: usize,
    /// The ideal rays through points along the rim.
    pub rays: Vec<Vector3<f64>>,
}

/// What is known of the height of a rim beforehand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeightPrior {
    /// The height, in mm.
    pub mm: f64,
    /// Its standard uncertainty, in mm.
    pub sigma_mm: f64,
}

/// The standard uncertainties of what goes in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BundleSigma {
    /// Of pitch and roll, the part that all pictures share, in radians.
    pub common_rad: f64,
    /// Of pitch and roll, each picture's own part, in radians.
    pub own_rad: f64,
    /// Of the range, each picture's own part, as a share of it.
    pub own_range: f64,
    /// Of the place of a feature, as an angle in radians.
    pub tie_rad: f64,
    /// Of the place of a rim's edge, as an angle in radians.
    pub rim_rad: f64,
    /// Of the place of a rim's edge, in mm: a lip is rounded, and no rim is a perfect circle.
    pub rim_mm: f64,
}

/// Everything that is solved together.
#[derive(Debug, Clone, PartialEq)]
pub struct BundleInput {
    /// The pictures. The first one defines the frame: its turn and its point under the camera stay as they are.
    pub shots: Vec<BundleShot>,
    /// The tie points.
    pub ties: Vec<BundleTie>,
    /// The rims.
    pub rims: Vec<BundleRim>,
    /// What is known of the height of each container.
    pub heights: Vec<HeightPrior>,
    /// The uncertainties.
    pub sigma: BundleSigma,
}

/// A picture as it was solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolvedShot {
    /// The pose.
    pub pose: Pose,
    /// The turn of its world frame in the common frame, in radians.
    pub turn_rad: f64,
    /// The point under the camera in the common frame, in mm.
    pub foot_mm: Point2<f64>,
}

/// A rim as it was solved.
#[derive(Debug, Clone, PartialEq)]
pub struct SolvedRim {
    /// The centre of the rim in the common frame, in mm.
    pub center_mm: Point2<f64>,
    /// Its radius, in mm.
    pub radius_mm: f64,
    /// Its height above the table, in mm.
    pub height_mm: f64,
    /// The standard uncertainty of the radius, in mm, but for the range's common scale.
    pub sigma_radius_mm: f64,
    /// The standard uncertainty of the height, in mm, but for the range's common scale.
    pub sigma_height_mm: f64,
    /// For each of its pictures the number of the picture, and the RMS distance of the rim's points from the circle, in standard
    /// uncertainties. About 1 where the picture agrees; several where the container was moved, or it is another one.
    pub misfits: Vec<(usize, f64)>,
}

/// A solved bundle.
#[derive(Debug, Clone, PartialEq)]
pub struct SolvedBundle {
    /// The pictures.
    pub shots: Vec<SolvedShot>,
    /// The rims by container.
    pub rims: Vec<SolvedRim>,
    /// The numbers of the tie points (in the order of the input) that contradict the others, and count for next to nothing.
    pub rejected: Vec<usize>,
    /// The RMS misfit of the other tie points, in standard uncertainties.
    pub tie_misfit: f64,
}
