//! Ingest, signals and runs against their peers, each a ratio of two programs that take turns in one run.
//!
//! `cargo bench -p aim-batch-pipeline`, or some of it: `-- copy packets csv week memory jobs rims`. docs/performance.md says what is
//! compared with what, and what was measured.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a benchmark fails by panicking, and prints")]

mod against_cp;
mod against_python;
mod card;
mod jobs;
mod memory;
mod python;
mod rims;
mod turns;
mod week;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    if arguments.first().is_some_and(|argument| argument == memory::CHILD) {
        return memory::child(&arguments[1..]);
    }
    let is_wanted = |name: &str| arguments.is_empty() || arguments.iter().any(|argument| argument == name);
    let parts: [(&str, fn()); 7] = [
        ("copy", against_cp::run),
        ("packets", against_python::packets),
        ("csv", against_python::csv),
        ("week", week::run),
        ("memory", memory::run),
        ("jobs", jobs::run_jobs),
        ("rims", rims::run),
    ];
    for (_, run) in parts.iter().filter(|(name, _)| is_wanted(name)) {
        run();
    }
}
