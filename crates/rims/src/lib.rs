//! Rims of plates and bowls, found in one picture without marks.
//!
//! In: a picture, and the view from which it was taken (camera, lens, pitch, roll, height above the table). Out: [`Rim`]s, the most
//! likely one first. The pose is known, so a level circle at any height is a circle on the table plane Z = 0, and a level rectangle is
//! a rectangle there. The steps, in the order of the data, each a room of its own:
//!
//! | room | in | out |
//! |---|---|---|
//! | `edges` | the picture at a reduced scale | its edges, linked to chains, as points of the plane Z = 0 in mm |
//! | `circles` | those edges | one fitted circle per container: votes, rough and fine fits, chance, choice |
//! | `evidence` | numbers of a circle or a rectangle | the confidence that it is the rim of a container |
//! | `outline` | a circle, the full picture | the outer edge of the rim, and points along it in pixels |
//! | `height` | a circle, the edges | the height of the rim above the table as a plate's and as a bowl's, and the odds of both |
//! | `squares` | the edges, the full picture | rectangles, where they are asked for |
//! | `sizes` | a rim that was found | its sizes, by the code that measures people's marks |
//!
//! `find` calls them. `priors` holds what tableware is like, `weights` the fitted numbers of weights.toml. A found rim becomes the
//! same [`ObjectMarks`](model::ObjectMarks) as a person's marks ([`Rim::marks`]). A room uses those of lower layers
//! alone (`tests/repository/module_layers.rs`). The crate knows nothing of sessions, studies or files. docs/rims-method.md tells the method, docs/rims-evaluation.md how well it does.

#![warn(missing_docs)]

mod circles;
mod colour;
mod edges;
mod evidence;
mod find;
mod found;
mod height;
mod outline;
mod priors;
mod rim;
mod rim_height;
mod shape;
mod sizes;
mod squares;
#[cfg(test)]
mod tests;
mod weights;

pub use evidence::{Evidence, SquareEvidence};
pub use find::{LEAST_DIAMETER_MM, LEAST_POINTS, RimError, VERSION, find_rims, find_rims_of, ring_pairs};
pub use found::Found;
pub use height::plate_log_odds;
pub use outline::RingPair;
pub use rim::Rim;
pub use rim_height::{HeightSource, RimHeight, as_judged};
pub use shape::{RimShape, UnknownRimShape};
pub use weights::{FEATURES, FittedSet, RING_FEATURES, SQUARE_FEATURES, fitted_sets, weights_toml};
