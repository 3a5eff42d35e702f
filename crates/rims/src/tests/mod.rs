//! Tests of the whole search, on pictures that are drawn here.

mod round;
mod squares;
