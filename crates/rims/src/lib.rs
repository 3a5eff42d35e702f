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

#![warn(missing_docs)]

mod circles;
mod colour;
mod edges;
mod evidence;
mod find;
mod found;
mod height;
mod outline;
mod rim;
mod rim_height;
mod shape;
mod sizes;
mod squares;
#[cfg(test)]
mod tests;

pub use evidence::{Evidence, FEATURES, SQUARE_FEATURES, SquareEvidence};
pub use find::{LEAST_DIAMETER_MM, LEAST_POINTS, RimError, VERSION, find_rims, find_rims_of};
pub use found::Found;
pub use rim::Rim;
pub use rim_height::{HeightSource, RimHeight, as_judged};
pub use shape::{RimShape, UnknownRimShape};
