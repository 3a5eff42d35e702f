//! The evidence for a rim, as numbers, and the confidence that follows from it.

mod chance;
mod round;
mod square;

pub(crate) use chance::binomial_tail_log10;
pub use round::Evidence;
pub use square::SquareEvidence;
