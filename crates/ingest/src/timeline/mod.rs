//! True time: what the stamps of a sensor say, put in order and never bridged.

mod facts;

pub use facts::{ClockJump, LISTED, Span, StreamFacts, Timeline};
