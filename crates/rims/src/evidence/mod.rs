//! What speaks for a rim, as numbers, and how sure it is by them: the weights of the confidence are here.

mod chance;
mod round;
mod square;

pub(crate) use chance::binomial_tail_log10;
pub use round::{Evidence, FEATURES};
pub use square::{SQUARE_FEATURES, SquareEvidence};
