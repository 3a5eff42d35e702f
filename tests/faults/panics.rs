//! A worker that panics, by a hook that builds without debug assertions do not contain; and --fail-fast.
#![cfg(debug_assertions)]

use model::Stage;

use super::Bench;
use crate::support::{stderr, stdout};

/// Panics in one stage of one session; the others complete, and the next run mends it.
fn panics_in(stage: Stage) {
    let bench = Bench::new();
    let output = bench.command().env("AIM_BATCH_TEST_PANIC", format!("S00003:{stage}")).output().unwrap();
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    let statuses = bench.statuses();
    assert_eq!(statuses.len(), Bench::SESSIONS);
    for status in &statuses {
        assert_eq!(status.failed, status.session == "S00003", "{status:?}");
    }
    let problem = &statuses[2].problems[0];
    assert_eq!((problem.stage, problem.code.code()), (stage, "internal_error"));
    assert!(problem.fact.contains("a fault on purpose"), "{problem:?}");
    assert_eq!(statuses[2].images, 6, "its images are in the ledger");
    assert_eq!(bench.run_well(), bench.undisturbed());
}

#[test]
fn a_panic_in_ingest() {
    panics_in(Stage::Ingest);
}

#[test]
fn a_panic_in_signals() {
    panics_in(Stage::Signals);
}

#[test]
fn a_panic_in_measuring() {
    panics_in(Stage::Measure);
}

#[test]
fn fail_fast_stops_at_the_first_failure_and_writes_no_results() {
    let bench = Bench::new();
    let output = bench
        .command()
        .args(["--fail-fast", "--jobs", "1"])
        .env("AIM_BATCH_TEST_PANIC", "S00003:measure")
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    let said = stderr(&output);
    assert!(said.contains("session 'S00003' failed") && said.contains("a fault on purpose"), "{said}");
    assert!(stdout(&output).is_empty() && !bench.out().exists());
    assert_eq!(bench.run_well(), bench.undisturbed());
    assert_eq!(bench.done()[0] as usize, Bench::SESSIONS - 3, "the sessions before it were kept");
}
