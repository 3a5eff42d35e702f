//! Tests of the crate from outside, as one binary.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod annotated;
mod arbitrary_bytes;
mod broken_cards;
mod configuration;
mod csv_files;
mod cwa_files;
mod damaged_images;
mod damaged_mcap;
mod fuzz_seeds;
mod image_extent;
mod image_times;
mod odd_cards;
mod packets;
mod round_trip;
mod support;
mod survey;
