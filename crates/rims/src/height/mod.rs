//! The height of a rim above the table, from what is seen below it and within it.

mod floor;
mod heights;
mod kind;
mod raster;
mod wall;

pub(crate) use heights::{Heights, of_rim};
pub use kind::plate_log_odds;
