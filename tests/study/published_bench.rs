//! The main job on the shipped sample.

use std::path::Path;

use crate::support::{assert_exit, copy_folder, published_bench, run, stderr, stdout};

fn run_bench(out: &Path, more: &[&str]) -> std::process::Output {
    let study = published_bench();
    let mut arguments = vec!["run", study.to_str().unwrap(), "--out", out.to_str().unwrap()];
    arguments.extend(more);
    run(arguments)
}

#[test]
fn tables_ii_to_vi_come_out_as_published() {
    let folder = tempfile::tempdir().unwrap();
    let (out, tables) = (folder.path().join("results.parquet"), folder.path().join("report"));
    let expected = published_bench().join("expected");
    let more = ["--expect", expected.to_str().unwrap(), "--tolerance", "0.15", "--report", tables.to_str().unwrap()];
    let output = run_bench(&out, &more);
    assert_exit(&output, 0);
    let text = stdout(&output);
    for line in ["2.01 ± 4.90", "± 38.11", "4.58 ± 6.78", "± 9.20", "4.70 ± 11.56"] {
        assert!(text.contains(line), "{line} is missing in\n{text}");
    }
    for table in ["II", "III", "IV", "V", "VI"] {
        for extension in ["csv", "md", "tex"] {
            assert!(tables.join(format!("table_{table}.{extension}")).is_file());
        }
    }
    assert!(text.contains("proves nothing about accuracy"), "every report of this study says so");
    let again = run(["report", out.to_str().unwrap()]);
    assert_exit(&again, 0);
    assert_eq!(stdout(&again), text, "the results alone give the same tables");
}

#[test]
fn the_page_has_pictures_and_report_makes_the_same_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    assert_exit(&run_bench(&path("r.parquet"), &["--report", path("one").to_str().unwrap()]), 0);
    let report = |to: &str| {
        run(["report", path("r.parquet").to_str().unwrap(), "-o", path(to).to_str().unwrap()].map(str::to_owned))
    };
    assert_exit(&report("two"), 0);
    let page = |of: &str| std::fs::read_to_string(path(of).join("index.html")).unwrap();
    assert!(page("one") == page("two"), "the results and the work folder give the same page");
    assert!(page("one").contains("data:image/jpeg;base64,") && page("one").contains("proves nothing about accuracy"));
    assert!(page("one").len() < 10_000_000);

    std::fs::remove_dir_all(path("r.work")).unwrap();
    let without = report("three");
    assert_exit(&without, 0);
    assert!(stderr(&without).contains("no pictures in the report"), "{}", stderr(&without));
    assert!(!page("three").contains("data:image/jpeg") && page("three").contains("Table VI"));
}

#[test]
fn jobs_and_a_second_run_do_not_change_a_byte() {
    let folder = tempfile::tempdir().unwrap();
    let read = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    let one = folder.path().join("one.parquet");
    assert_exit(&run_bench(&one, &["--jobs", "1"]), 0);
    let (results, frames) = (read("one.parquet"), read("one.frames.parquet"));
    let two = folder.path().join("two.parquet");
    assert_exit(&run_bench(&two, &["--jobs", "4"]), 0);
    assert!(read("two.parquet") == results && read("two.frames.parquet") == frames, "--jobs decides nothing");
    assert_exit(&run_bench(&one, &[]), 0);
    assert!(read("one.parquet") == results && read("one.frames.parquet") == frames, "nor does a second run");
}

#[test]
fn a_number_that_is_off_fails_and_is_shown() {
    let folder = tempfile::tempdir().unwrap();
    let expected = folder.path().join("expected");
    copy_folder(&published_bench().join("expected"), &expected);
    let table = expected.join("table_II.csv");
    let text = std::fs::read_to_string(&table).unwrap();
    assert!(text.contains("16.95"));
    std::fs::write(&table, text.replacen("16.95", "17.95", 1)).unwrap();
    let output = run_bench(&folder.path().join("r.parquet"), &["--expect", expected.to_str().unwrap()]);
    assert_exit(&output, 1);
    let said = stderr(&output);
    assert!(said.contains("table_II.csv") && said.contains("predicted_cm") && said.contains("17.95"), "{said}");
}

#[test]
fn flags_and_environment_win_over_the_study() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("r.parquet");
    assert_exit(&run_bench(&out, &["--method", "ray", "--target-pitch", "40", "--pitch-tolerance", "3"]), 0);
    let rows = report::Results::read(&out).unwrap().rows;
    assert!(rows.iter().all(|row| row.method == model::Method::Ray));
    let selected: Vec<f64> = rows.iter().filter(|row| row.selected).filter_map(|row| row.pitch_deg).collect();
    assert!(!selected.is_empty() && selected.iter().all(|pitch| (pitch - 40.0).abs() <= 3.0));

    let by_environment = |more: &[&str]| {
        let mut command = crate::support::aim_batch();
        command
            .env("AIM_BATCH_OUT", &out)
            .env("AIM_BATCH_METHOD", "paper")
            .arg("run")
            .arg(published_bench())
            .args(more);
        assert_exit(&command.output().unwrap(), 0);
        report::Results::read(&out).unwrap().rows
    };
    assert!(
        by_environment(&[]).iter().all(|row| row.method == model::Method::Paper),
        "the environment beats the study"
    );
    let rows = by_environment(&["--method=ray"]);
    assert!(rows.iter().all(|row| row.method == model::Method::Ray), "a flag beats the environment");
}
