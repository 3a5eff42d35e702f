//! Tests of the crate from outside. They are one binary, since each binary must link Polars.
#![allow(clippy::unwrap_used, clippy::float_cmp, reason = "a test fails by panicking; exact values are meant")]

extern crate aim_batch_report as report;

mod bench;
mod compare;
mod documents;
mod drawn;
mod escaping;
mod figures;
mod files;
mod flow;
mod golden;
mod misuse;
mod page;
mod parquet;
mod sizes;
mod statistics;
mod truth;
mod validation;
