//! SIGKILL, SIGINT and SIGTERM.
#![cfg(unix)]

use std::os::unix::process::ExitStatusExt as _;
use std::time::{Duration, Instant, SystemTime};

use super::Bench;
use super::bench::{signal, wait_for_lock};
use crate::support::assert_exit;

/// Stretches the stages, so that a moment falls into any of them, and sessions are in flight when signals come.
const PAUSE: [(&str, &str); 1] = [("AIM_BATCH_TEST_PAUSE_MS", "8")];
const LONG_PAUSE: [(&str, &str); 1] = [("AIM_BATCH_TEST_PAUSE_MS", "30000")];

#[test]
fn killed_at_20_random_moments_then_resumed_gives_the_same_bytes() {
    let bench = Bench::new();
    let expected = bench.undisturbed();
    let start = Instant::now();
    let mut whole = bench.start(&["--jobs", "2"], &PAUSE);
    assert!(whole.wait().unwrap().success());
    let whole_run = start.elapsed();
    let mut random = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap().as_nanos() as u64 | 1;
    let (mut killed, mut runs) = (0, 0);
    while killed < 20 {
        runs += 1;
        assert!(runs <= 100, "only {killed} of {runs} runs were killed before their end");
        std::fs::remove_dir_all(bench.path("out")).unwrap();
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let moment = whole_run.mul_f64((random >> 11) as f64 / (1_u64 << 53) as f64);
        let mut child = bench.start(&["--jobs", "2"], &PAUSE);
        std::thread::sleep(moment);
        child.kill().unwrap();
        killed += u32::from(child.wait().unwrap().signal() == Some(9));
        if bench.out().exists() {
            assert_eq!(bench.files().0, expected.0, "killed after {moment:?}");
        }
        assert_exit(&bench.run(), 0);
        assert_eq!(bench.files(), expected, "killed after {moment:?}");
        assert_eq!(bench.leftovers(), Vec::<String>::new(), "killed after {moment:?}");
    }
}

#[test]
fn killed_again_and_again_a_run_still_comes_to_its_end() {
    let bench = Bench::new();
    let expected = bench.undisturbed();
    let mut runs = 0;
    loop {
        let mut child = bench.start(&["--jobs", "1"], &[("AIM_BATCH_TEST_PAUSE_MS", "20")]);
        std::thread::sleep(Duration::from_millis(250));
        runs += 1;
        if child.try_wait().unwrap().is_some_and(|status| status.success()) {
            break;
        }
        child.kill().unwrap();
        child.wait().unwrap();
        assert!(runs < 200, "each run loses what the one before has done");
    }
    assert!(runs > 1);
    assert_eq!(bench.files(), expected);
}

#[test]
fn killed_while_it_replaces_results_the_old_ones_or_the_new_ones_are_there() {
    let bench = Bench::new();
    let old = bench.run_well();
    bench.edit("study.toml", |text| format!("{text}\n[select]\npitch_tolerance_deg = 3.0\n"));
    let new = bench.undisturbed();
    assert_ne!(old, new);
    for moment_ms in (0..120).step_by(12) {
        let mut child = bench.start(&[], &PAUSE);
        std::thread::sleep(Duration::from_millis(moment_ms));
        child.kill().unwrap();
        child.wait().unwrap();
        let found = bench.files();
        assert!(found.0 == old.0 || found.0 == new.0, "half-written results after {moment_ms} ms");
        assert!(found.1 == old.1 || found.1 == new.1, "half-written ledger after {moment_ms} ms");
    }
    assert_eq!(bench.run_well(), new);
}

/// Sends a signal while sessions are in flight, once there are so many recordings; gives exit code and what was said.
fn stopped_by(bench: &Bench, name: &str, recordings: usize) -> (Option<i32>, String) {
    let child = bench.start(&["--jobs", "2"], &[("AIM_BATCH_TEST_PAUSE_MS", "400")]);
    wait_for_lock(bench, &child);
    // With three recordings made by two workers, one session at least is done; three more are to be.
    while bench.recordings() < recordings {
        std::thread::sleep(Duration::from_millis(5));
    }
    let start = Instant::now();
    signal(&child, name);
    let output = child.wait_with_output().unwrap();
    assert!(start.elapsed() < Duration::from_secs(10), "{:?}", start.elapsed());
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

#[test]
fn sigint_keeps_what_is_done_and_ends_with_130() {
    let bench = Bench::new();
    let (code, said) = stopped_by(&bench, "INT", 3);
    assert_eq!(code, Some(130), "{said}");
    assert!(said.contains("stopped by SIGINT") && said.contains("run again to go on"), "{said}");
    assert!(!bench.out().exists());
    assert_eq!(bench.leftovers(), Vec::<String>::new());
    assert_eq!(bench.run_well(), bench.undisturbed());
    assert!(bench.done()[2] < Bench::SESSIONS as u64, "what was done before the signal is not done again");
}

#[test]
fn sigterm_ends_with_143_and_leaves_the_old_results() {
    let bench = Bench::new();
    let old = bench.run_well();
    bench.edit("study.toml", |text| format!("{text}\n[select]\npitch_tolerance_deg = 3.0\n"));
    let (code, said) = stopped_by(&bench, "TERM", 0);
    assert_eq!(code, Some(143), "{said}");
    assert!(said.contains("stopped by SIGTERM"), "{said}");
    assert_eq!(bench.files(), old);
    assert_eq!(bench.run_well(), bench.undisturbed());
}

#[test]
fn a_second_sigint_ends_at_once() {
    let bench = Bench::new();
    let child = bench.start(&[], &LONG_PAUSE);
    wait_for_lock(&bench, &child);
    let start = Instant::now();
    signal(&child, "INT");
    std::thread::sleep(Duration::from_millis(100));
    signal(&child, "INT");
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    assert!(start.elapsed() < Duration::from_secs(25), "it waited for the sessions in flight");
    assert_eq!(bench.run_well(), bench.undisturbed());
}

#[test]
fn a_check_that_is_stopped_leaves_nothing_behind() {
    let bench = Bench::with(&[("--images", "400")]);
    let temporary = bench.path("tmp");
    std::fs::create_dir(&temporary).unwrap();
    let mut command = crate::support::aim_batch();
    command.arg("check").arg(bench.study()).env("TMPDIR", &temporary).stdout(std::process::Stdio::null());
    let mut child = command.stderr(std::process::Stdio::piped()).spawn().unwrap();
    while std::fs::read_dir(&temporary).unwrap().next().is_none() && child.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(1));
    }
    if child.try_wait().unwrap().is_none() {
        signal(&child, "INT");
    }
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(std::fs::read_dir(&temporary).unwrap().count(), 0);
}
