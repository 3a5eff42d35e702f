//! Whole-program tests: the binary `aim-batch` as a user runs it.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "what was measured, and what was skipped, shows with --nocapture")]

mod commands;
mod damage;
mod faults;
mod real;
mod repository;
mod study;
mod support;
