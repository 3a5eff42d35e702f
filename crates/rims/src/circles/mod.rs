//! From edges on the plane Z = 0 to the circles that are rims.

mod arcs;
mod bins;
mod buckets;
mod fitting;
mod lanes;
mod outward;
mod search;
mod select;
mod significance;
mod support;
mod trial;
mod votes;

pub(crate) use bins::{BINS, angle_of};
pub(crate) use buckets::Buckets;
pub(crate) use search::rims;
pub(crate) use select::Scored;
pub(crate) use trial::{Arc, Disc};
