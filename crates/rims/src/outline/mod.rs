//! From a circle near a rim to the points of its outer edge, in the full picture.

mod lip;
mod rays;
mod refine;
mod rings;

pub(crate) use lip::outer_edge;
pub(crate) use refine::{Followed, follow};
