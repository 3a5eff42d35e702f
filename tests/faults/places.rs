//! Where results and messages go: not among the inputs, not over another run's files, and into pipes that nobody reads.

use std::process::Stdio;

use super::Bench;
use crate::support::{assert_exit, stderr};

#[test]
fn nothing_is_written_among_cards_and_marks() {
    let bench = Bench::new();
    let inside = bench.study().join("cards/new/work");
    let output = bench.run_with(&["--work", inside.to_str().unwrap()]);
    assert_exit(&output, 2);
    assert!(stderr(&output).contains("outside the study's cards/"), "{}", stderr(&output));
    assert!(!bench.study().join("cards/new").exists());
    let beside = bench.study().join("results.parquet");
    assert_exit(&bench.run_with(&["--work", bench.path("w").to_str().unwrap()]), 0);
    let study = bench.study();
    let in_study = crate::support::run(["run".as_ref(), study.as_os_str(), "--out".as_ref(), beside.as_os_str()]);
    assert_exit(&in_study, 0); // beside the cards is well
}

#[test]
fn no_output_takes_the_name_of_a_ledger() {
    let bench = Bench::new();
    for name in ["frames.parquet", "a.frames.parquet", "..parquet"] {
        let study = bench.study();
        let mut command = crate::support::aim_batch();
        let output = command.arg("run").arg(study).args(["--out", name]).current_dir(bench.path("")).output().unwrap();
        assert_exit(&output, 2);
    }
    assert_eq!(std::fs::read_dir(bench.path("")).unwrap().count(), 1, "the study alone");
}

#[test]
fn a_place_that_a_file_cannot_take_shows_before_the_work() {
    let bench = Bench::new();
    std::fs::create_dir_all(bench.path("out/run.json")).unwrap();
    assert_exit(&bench.run(), 1);
    assert!(!bench.out().exists() && !bench.mcap("S00001").exists());
}

#[cfg(target_os = "linux")]
#[test]
fn messages_that_nobody_takes_change_no_exit_code() {
    let bench = Bench::new();
    let sensor = bench.card_file("S00005", "SENSORS");
    let kept = std::fs::read(&sensor).unwrap();
    std::fs::write(&sensor, &kept[..kept.len() / 3]).unwrap();
    let full = std::fs::File::options().write(true).open("/dev/full").unwrap();
    let mut command = bench.command();
    assert_eq!(command.arg("-vv").stdout(Stdio::null()).stderr(full).status().unwrap().code(), Some(3));
    let mut child = bench.command().stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stderr.take()); // as `2>&1 | head` does
    assert_eq!(child.wait().unwrap().code(), Some(3));
}

#[cfg(target_os = "linux")]
#[test]
fn a_limit_of_the_size_of_files_is_told() {
    let bench = Bench::new();
    let limited = format!(
        "ulimit -f 20; exec {} run {} --out {}",
        env!("CARGO_BIN_EXE_aim-batch"),
        bench.study().display(),
        bench.out().display()
    );
    let output = std::process::Command::new("sh").arg("-c").arg(limited).output().unwrap();
    assert_exit(&output, 1);
    assert!(stderr(&output).contains("work folder"), "{}", stderr(&output));
    assert_eq!(bench.run_well(), bench.undisturbed());
}
