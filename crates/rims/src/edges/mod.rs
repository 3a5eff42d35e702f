//! From a picture to edges on the plane Z = 0: a picture at a reduced scale ([`scaled`]), its edges ([`edge`]), linked to chains
//! ([`chains`]), and carried to the table ([`ground`]).

mod chains;
mod edge;
mod ground;
mod scaled;

pub(crate) use ground::{GroundEdge, ground_edges};
pub(crate) use scaled::Scaled;
