//! Whole-program tests: the binary `aim-batch` as a user runs it.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod bad_input;
mod layers;
mod project;
mod published_bench;
mod real;
mod support;
