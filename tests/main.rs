//! Whole-program tests: the binary `aim-batch` as a user runs it.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "what was measured, and what was skipped, shows with --nocapture")]

mod annotate;
mod auto;
mod bad_input;
mod calibrate;
mod check;
mod damage;
mod documents;
mod faults;
mod figures;
mod flow;
mod gallery;
mod inspect;
mod large;
mod layers;
mod marks;
mod measure;
mod methods;
mod names;
mod pipeline_layers;
mod project;
mod published_bench;
mod real;
mod scene;
mod squares;
mod support;
