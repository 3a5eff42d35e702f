//! Two runs at a time.
#![cfg(unix)]

use super::Bench;
use super::bench::wait_for_lock;
use crate::support::{aim_batch, assert_exit, stderr};

const PAUSE: [(&str, &str); 1] = [("AIM_BATCH_TEST_PAUSE_MS", "400")];

#[test]
fn the_second_in_a_work_folder_is_refused_and_told_who_is_first() {
    let bench = Bench::new();
    let mut first = bench.start(&["--jobs", "2"], &PAUSE);
    wait_for_lock(&bench, &first);
    let other_out = bench.path("other/results.parquet");
    let mut command = aim_batch();
    command.arg("run").arg(bench.study()).arg("--out").arg(&other_out).arg("--work").arg(bench.work());
    let second = command.output().unwrap();
    assert_exit(&second, 1);
    let said = stderr(&second);
    assert!(said.contains("another run is at work in this folder: aim-batch "), "{said}");
    assert!(said.contains(&format!("process {} on ", first.id())), "{said}");
    assert!(!other_out.exists());
    let said = bench.status(&[]);
    assert!(said.contains("a run is at work: aim-batch"), "{said}");
    assert!(first.wait().unwrap().success(), "the first goes on undisturbed");
    assert_eq!(bench.files(), bench.undisturbed());
}

#[test]
fn the_second_that_writes_the_same_results_is_refused() {
    let bench = Bench::new();
    let mut first = bench.start(&["--jobs", "2"], &PAUSE);
    wait_for_lock(&bench, &first);
    let other_work = bench.path("other.work");
    let second = bench.command().arg("--work").arg(&other_work).output().unwrap();
    assert_exit(&second, 1);
    assert!(stderr(&second).contains("another process is writing this file"), "{}", stderr(&second));
    assert!(first.wait().unwrap().success());
    assert_eq!(bench.files(), bench.undisturbed());
}

#[test]
fn the_lock_dies_with_its_process() {
    let bench = Bench::new();
    let mut first = bench.start(&[], &PAUSE);
    wait_for_lock(&bench, &first);
    first.kill().unwrap();
    first.wait().unwrap();
    assert!(bench.work().join("lock").exists());
    assert_eq!(bench.run_well(), bench.undisturbed());
}

#[test]
fn two_work_folders_two_outputs_one_study() {
    let bench = Bench::new();
    let mut first = bench.start(&[], &[]);
    let mut command = aim_batch();
    let other = bench.path("other/results.parquet");
    let second = command.arg("run").arg(bench.study()).arg("--out").arg(&other).output().unwrap();
    assert_exit(&second, 0);
    assert!(first.wait().unwrap().success());
    assert_eq!(bench.files().0, std::fs::read(other).unwrap());
}
