//! True time: what the stamps of a sensor say, put in order and never bridged.
//!
//! Packets and rows as they stand in the files -> `Stepper`: a time for each sample -> `Line`: in order, with an account of
//! gaps, duplicates and clocks that were set -> the MCAP file.

mod account;
mod block;
mod clock;
mod facts;
mod line;
mod pieces;
mod spread;
mod stamped;
mod stepper;

pub use block::{Block, Times};
pub use clock::{Clock, ClockError};
pub use facts::{ClockJump, LISTED, Span, StreamFacts, Timeline};
pub use line::Line;
pub(crate) use spread::{LEARNED_ROWS, SharedStamps, Spreader, StampCounts};
pub use stamped::{BlockStamp, BlockTimes, SampleTimes};
pub use stepper::Stepper;
