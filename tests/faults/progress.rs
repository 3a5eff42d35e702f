//! The messages of a run while it is at work, and at its end.
#![cfg(debug_assertions)]

use super::Bench;
use crate::support::{assert_exit, stderr};

fn said(options: &[&str]) -> String {
    let bench = Bench::new();
    let slow = [("AIM_BATCH_PROGRESS_S", "0.1"), ("AIM_BATCH_TEST_PAUSE_MS", "150")];
    let output = bench.command().args(options).envs(slow).output().unwrap();
    assert_exit(&output, 0);
    stderr(&output)
}

#[test]
fn plain_lines_where_stderr_is_no_terminal() {
    let said = said(&["--jobs", "2"]);
    let lines: Vec<&str> = said.lines().filter(|line| line.contains("/6 sessions")).collect();
    assert!(lines.len() >= 3, "{said}");
    assert!(lines.iter().all(|line| line.contains("images") && line.contains(" failed")), "{said}");
    assert!(lines.iter().any(|line| line.contains(" read, about ")), "{said}");
}

#[test]
fn none_with_quiet() {
    let said = said(&["--jobs", "2", "--quiet"]);
    assert!(!said.contains("/6 sessions"), "{said}");
    assert!(said.contains("6 sessions (0 failed)"), "the summary stays: {said}");
}

#[test]
fn the_summary_fits_on_a_screen_and_tells_where_and_how_long() {
    let bench = Bench::with(&[("--damage", "100"), ("--sessions", "28")]);
    let output = bench.run();
    assert_exit(&output, 3);
    let said = stderr(&output);
    assert!(said.lines().count() <= 30, "{said}");
    for part in [
        "28 sessions (",
        " with a pose, ",
        "s in all; ingest ",
        "signals ",
        "measure ",
        "wrote ",
        "run.json",
        "work folder ",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
}
