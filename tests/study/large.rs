//! The preset `large`: whole sessions run without a word, damaged ones are told, each with its code.

use std::collections::BTreeMap;
use std::path::Path;

use model::{Level, Method, ResultRow, SessionStatus, Severity};

use crate::support::{assert_exit, run, stderr};

/// Makes a study below `folder` and runs it.
struct Large {
    folder: tempfile::TempDir,
    exit: i32,
    rows: Vec<ResultRow>,
    sessions: Vec<SessionStatus>,
}

impl Large {
    #[track_caller]
    fn run(options: &[&str]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let (study, out) = (folder.path().join("study"), folder.path().join("results.parquet"));
        let made = ["simulate", "large", "--image-size", "64x48", "-o", study.to_str().unwrap()];
        assert_exit(&run(made.iter().chain(options)), 0);
        let output = run(["run", study.to_str().unwrap(), "--out", out.to_str().unwrap()]);
        let exit = output.status.code().unwrap();
        assert_exit(&output, exit); // no panic
        let results = report::Results::read(&out).unwrap();
        Self { exit, rows: results.rows, sessions: results.metadata.sessions, folder }
    }

    fn table(&self, name: &str) -> Vec<BTreeMap<String, String>> {
        let path = self.folder.path().join("study").join(name);
        csv::Reader::from_path(path).unwrap().deserialize().map(Result::unwrap).collect()
    }

    /// Asserts that exactly the sessions of damaged.csv have lost something, each what it says there.
    #[track_caller]
    fn assert_damaged(&self, sessions: usize) {
        let damaged: BTreeMap<String, BTreeMap<String, String>> =
            self.table("damaged.csv").into_iter().map(|row| (row["session"].clone(), row)).collect();
        assert_eq!(damaged.len(), sessions);
        for status in &self.sessions {
            let losses = status.problems.iter().filter(|problem| problem.severity == Severity::Loss);
            let codes: Vec<&str> = losses.map(|problem| problem.code.code()).collect();
            match damaged.get(&status.session) {
                Some(row) => assert!(codes.contains(&row["code"].as_str()), "{row:?}, but {codes:?}"),
                None => assert!(!status.has_losses(), "{} is whole, but {codes:?}", status.session),
            }
        }
    }
}

#[test]
fn damaged_sessions_are_told_and_the_others_are_measured() {
    let study = Large::run(&["--sessions", "12", "--images", "6", "--damage", "33"]);
    assert_eq!((study.exit, study.sessions.len()), (3, 12));
    study.assert_damaged(4);
    let whole: Vec<&SessionStatus> = study.sessions.iter().filter(|status| !status.has_losses()).collect();
    assert_eq!(whole.len(), 8);
    for status in whole {
        assert_eq!((status.images, status.with_pose), (6, 6));
        let is_of_it = |row: &&ResultRow| row.session == status.session && row.method == Method::Ray;
        let rows: Vec<&ResultRow> = study.rows.iter().filter(is_of_it).collect();
        assert!(rows.iter().any(|row| row.level == Level::Fused), "{}", status.session);
        // The sensors keep the pitch to some thousandths of a degree, and the marks are exact.
        assert!(rows.iter().all(|row| row.error_pct.is_some_and(|error| error.abs() < 0.1)), "{rows:?}");
    }
}

#[test]
fn poses_agree_with_truth() {
    let study = Large::run(&["--sessions", "5", "--images", "6"]);
    assert_eq!(study.exit, 0, "nothing is damaged");
    assert!(!study.folder.path().join("study/damaged.csv").exists());
    let frames = report::read_frames(&study.folder.path().join("frames.parquet")).unwrap();
    let (truth, made_from) = report::read_truth(&study.folder.path().join("study/truth.parquet")).unwrap();
    assert!(made_from.contains(r#""preset":"large""#) && made_from.contains(r#""seed":1"#), "{made_from}");
    assert_eq!((frames.len(), truth.len()), (30, 30));
    for (frame, truth) in frames.iter().zip(&truth) {
        assert_eq!((&frame.session, &frame.image), (&truth.session, &truth.image));
        assert_eq!((&frame.participant, frame.time_utc), (&truth.participant, Some(truth.time_utc)));
        let within = |found: Option<f64>, truth: f64, tolerance: f64| (found.unwrap() - truth).abs() < tolerance;
        assert!(within(frame.pitch_deg, truth.pitch_deg, 0.02), "{frame:?} {truth:?}");
        assert!(within(frame.roll_deg, truth.roll_deg, 0.04), "{frame:?} {truth:?}");
        assert!(within(frame.range_mm, truth.range_mm, 0.01), "{frame:?} {truth:?}");
        assert_eq!(frame.raters == 1, truth.marked);
    }
}

/// Whatever the seed, and however short the sessions.
#[test]
fn every_kind_of_damage_is_told_with_its_code() {
    let kinds = simulate::large::Damage::ALL.len();
    for (seed, images) in [("1", "1"), ("2", "2"), ("3", "3"), ("4", "9"), ("5", "24")] {
        let sessions = (3 * kinds).to_string();
        let options = ["--sessions", &sessions, "--images", images, "--damage", "100", "--seed", seed];
        let study = Large::run(&options);
        assert_eq!(study.exit, 3, "{options:?}");
        study.assert_damaged(3 * kinds);
    }
}

#[test]
fn options_that_do_not_fit_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("study");
    let refused = |preset: &str, options: &[&str], expected: &str| {
        let output = run(["simulate", preset, "-o", out.to_str().unwrap()].iter().chain(options));
        assert_exit(&output, 2);
        assert!(stderr(&output).contains(expected), "{}", stderr(&output));
        assert!(!Path::new(&out).exists());
    };
    refused("large", &["--image-size", "640"], "such as 320x240");
    refused("large", &["--image-size", "5000x100"], "image width 5000: expected 32 to 4096");
    refused("large", &["--damage", "101"], "0 to 100 per cent");
    refused("large", &["--sessions", "0"], "sessions 0: expected 1 to 100000");
    refused("large", &["--no-pictures"], "belongs to the preset published-bench");
    refused("published-bench", &["--sessions", "5"], "belong to other presets");
    refused("bench", &["--sessions", "5"], "do not fit the preset bench");
    refused("bench", &["--image-size", "32x32"], "--image-size 32x32: expected 64 to 8192 px each way");
    refused("worn", &["--damage", "5"], "belongs to the preset large");
    refused("worn", &["--images", "0"], "--images 0: expected 1 to 2000");
}
