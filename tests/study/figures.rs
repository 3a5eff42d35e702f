//! Figures, as a user gets them.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use crate::support::{assert_exit, files_below, published_bench, run, stderr, stdout};

#[test]
fn a_run_and_a_report_write_the_same_figures() {
    let dir = tempfile::tempdir().unwrap();
    let [out, of_run, of_report] = ["results.parquet", "run", "report"].map(|name| dir.path().join(name));
    let study = published_bench();
    let [study, out, of_run_arg, of_report_arg] =
        [&study, &out, &of_run, &of_report].map(|path| path.to_str().unwrap());
    let output = run(["run", study, "--out", out, "--report", of_run_arg]);
    assert_exit(&output, 0);
    assert_exit(&run(["report", out, "-o", of_report_arg]), 0);
    let [of_run, of_report] = [of_run, of_report].map(|folder| {
        let folder = folder.join("figures");
        let named = |(path, bytes): (PathBuf, _)| (path.strip_prefix(&folder).unwrap().to_owned(), bytes);
        files_below(&folder).into_iter().map(named).collect::<BTreeMap<PathBuf, Vec<u8>>>()
    });
    assert_eq!(of_run.len(), 9 + 1, "nine figures and their captions: {:?}", of_run.keys());
    assert!(of_run == of_report, "the same bytes");
    assert!(of_run.values().all(|bytes| bytes.len() < 300_000));
    assert!(stdout(&output).contains(" pitch in range \u{2588}") && stdout(&output).contains("\u{2591} 33 (38 %)\n"));
}

#[test]
fn without_the_ledger_the_figures_of_images_are_left_out() {
    let dir = tempfile::tempdir().unwrap();
    let [out, report] = ["results.parquet", "report"].map(|name| dir.path().join(name));
    let [out_arg, report_arg] = [&out, &report].map(|path| path.to_str().unwrap());
    assert_exit(&run(["run", published_bench().to_str().unwrap(), "--out", out_arg, "--report", report_arg]), 0);
    assert!(report.join("figures/flow.svg").is_file());
    fs::remove_file(dir.path().join("frames.parquet")).unwrap();
    let output = run(["report", out_arg, "-o", report_arg]);
    assert_exit(&output, 0);
    assert!(stderr(&output).contains("no flow of images") && !stdout(&output).contains('\u{2588}'));
    assert!(!report.join("figures/flow.svg").exists() && report.join("figures/error_by_pitch.svg").is_file());
    let captions = fs::read_to_string(report.join("figures/figures.md")).unwrap();
    assert!(captions.contains("- Flow of images: the ledger of images"), "{captions}");
}
