//! Features of the table by which the pictures of one session are tied together.
//!
//! In: pictures of one table, each with its view (camera, lens, pitch, roll, height above the table) and the rims that were found in it.
//! Out: [`Ties`]: places of the table that are seen in several pictures, and a first place and heading of each picture in one common frame.
//! The pose is known, so every picture can be carried to the table plane Z = 0; there, two pictures of one table differ by a rotation, a
//! shift, and the small errors of their poses. What stands up does not move with the plane: rims and all that is within them are left out
//! beforehand, and matches of other raised things are outvoted.
//!
//! | module | in | out |
//! |---|---|---|
//! | `ground` | a picture | the table from above, in pixels of a millimetre |
//! | `corners` | the table from above | corners (FAST), ranked by Harris' measure, to a fraction of a pixel |
//! | `descriptor` | the table from above, a corner | a turned binary descriptor (BRIEF) |
//! | `features` | a picture | its corners with their descriptors |
//! | `matching` | two pictures' features | pairs that look alike |
//! | `registration` | such pairs | the motion between both pictures, and the pairs that follow it |
//! | `tracks` | the registrations of a session | tie points and the common frame |
//!
//! The crate knows nothing of sessions, studies or files, and of rims only where they are.
//!
//! Sources: FAST (Rosten and Drummond 2006), Harris and Stephens (1988), BRIEF (Calonder et al. 2010), turned by the intensity centroid as in
//! ORB (Rublee et al. 2011). The test pairs of the descriptor are this crate's own.

#![warn(missing_docs)]

mod corners;
mod descriptor;
mod features;
mod ground;
mod matching;
mod registration;
mod tracks;

pub use features::{Disc, Feature, features};
pub use registration::{Registration, register};
pub use tracks::{Placed, TiePoint, Ties, tie};
