//! The same bytes, however a run came about.

use super::Bench;
use crate::support::{assert_exit, copy_folder};

#[test]
fn any_number_of_jobs_any_bound_of_memory_any_place() {
    let bench = Bench::with(&[("--damage", "50")]);
    let expected = bench.undisturbed();
    for options in [["--jobs", "1"], ["--jobs", "2"], ["--jobs", "7"], ["--memory", "1"]] {
        let _ = std::fs::remove_dir_all(bench.path("out"));
        assert_exit(&bench.run_with(&options), 3);
        assert_eq!(bench.files(), expected, "{options:?}");
    }
    let elsewhere = bench.path("elsewhere");
    copy_folder(&bench.study(), &elsewhere.join("study"));
    let out = elsewhere.join("a b/results.parquet");
    let output =
        crate::support::run(["run".as_ref(), elsewhere.join("study").as_os_str(), "--out".as_ref(), out.as_os_str()]);
    assert_exit(&output, 3);
    assert_eq!(std::fs::read(out).unwrap(), expected.0, "results do not tell where the study lies");
}

#[test]
fn sessions_that_come_later_take_their_place_in_the_order() {
    let bench = Bench::new();
    let expected = bench.undisturbed();
    let away = bench.path("away");
    for session in ["S00001", "S00004"] {
        std::fs::create_dir_all(&away).unwrap();
        std::fs::rename(bench.study().join("cards").join(session), away.join(session)).unwrap();
        std::fs::rename(bench.study().join("marks/R1").join(session), away.join(format!("marks-{session}"))).unwrap();
    }
    let fewer = bench.run_well();
    assert_ne!(fewer, expected);
    for session in ["S00001", "S00004"] {
        std::fs::rename(away.join(session), bench.study().join("cards").join(session)).unwrap();
        std::fs::rename(away.join(format!("marks-{session}")), bench.study().join("marks/R1").join(session)).unwrap();
    }
    assert_eq!(bench.run_well(), expected);
    assert_eq!(bench.done(), [2, 2, 2]);
}
