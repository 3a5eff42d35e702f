//! `run --annotate`: recordings for viewers, made once and made again when something has changed.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use ingest::{SessionReader, annotated_key};

use crate::support::{
    Shot, StudyFolder, aim_batch, assert_exit, files_below, label_me, line, published_bench, small_camera,
    small_picture, stderr,
};

const OBJECTS: &str = "object,kind,shape,true_diameter_mm\nplate,plate,circle,100.0\n";

/// A picture with a mark as long as `end_px` says.
fn shot(end_px: f64) -> Shot {
    let marks = label_me(vec![line("plate/diameter", [[10.0, 24.0], [end_px, 24.0]])]);
    Shot {
        picture: small_picture(),
        extension: "jpg",
        pitch_deg: 55.0,
        roll_deg: 0.0,
        range_mm: 400.0,
        marks: Some(marks),
    }
}

fn study() -> StudyFolder {
    let study = StudyFolder::new("", OBJECTS, &small_camera());
    study.session("S1", &[shot(50.0), shot(48.0)]);
    study.session("S2", &[shot(52.0)]);
    study
}

fn out(study: &StudyFolder) -> PathBuf {
    study.path().join("out/r.parquet")
}

/// Runs with `--annotate`; gives what was said.
#[track_caller]
fn run(study: &StudyFolder, options: &[&str], exit: i32) -> String {
    let mut command = aim_batch();
    let ran =
        command.arg("run").arg(study.path()).arg("--out").arg(out(study)).arg("--annotate").args(options).output();
    let ran = ran.unwrap();
    assert_exit(&ran, exit);
    stderr(&ran)
}

fn annotated(study: &StudyFolder) -> BTreeMap<PathBuf, Vec<u8>> {
    let folder = out(study).with_extension("work").join("annotated");
    let name = |path: &Path| path.strip_prefix(&folder).unwrap().to_owned();
    files_below(&folder).into_iter().map(|(path, bytes)| (name(&path), bytes)).collect()
}

#[test]
fn made_once_and_again_when_something_has_changed() {
    let study = study();
    assert!(run(&study, &[], 0).contains("2 written, 0 unchanged"));
    let first = annotated(&study);
    let names: Vec<_> = first.keys().map(|name| name.to_str().unwrap()).collect();
    assert_eq!(names, ["S1.annotated.mcap", "S2.annotated.mcap"]);
    assert!(run(&study, &[], 0).contains("0 written, 2 unchanged"));
    assert!(annotated(&study) == first);
    study.session("S2", &[shot(40.0)]); // another mark; the same card
    assert!(run(&study, &[], 0).contains("1 written, 1 unchanged"));
    let second = annotated(&study);
    assert!(second[Path::new("S1.annotated.mcap")] == first[Path::new("S1.annotated.mcap")]);
    assert!(second[Path::new("S2.annotated.mcap")] != first[Path::new("S2.annotated.mcap")]);
    for jobs in ["1", "2"] {
        assert!(run(&study, &["--force", "--jobs", jobs], 0).contains("2 written"));
        assert!(annotated(&study) == second, "--jobs {jobs}");
    }
}

#[test]
fn a_file_that_is_not_whole_is_made_again_and_those_of_no_session_go() {
    let study = study();
    run(&study, &[], 0);
    let first = annotated(&study);
    let folder = out(&study).with_extension("work").join("annotated");
    let file = folder.join("S1.annotated.mcap");
    std::fs::write(&file, &first[Path::new("S1.annotated.mcap")][..1000]).unwrap();
    std::fs::write(folder.join(".ingest-left.partial"), "of a run that was killed").unwrap();
    assert!(run(&study, &[], 0).contains("1 written, 1 unchanged"));
    assert!(annotated(&study) == first);
    for part in ["cards/S2", "marks/A/S2"] {
        std::fs::remove_dir_all(study.path().join(part)).unwrap();
    }
    run(&study, &["--prune"], 0);
    assert_eq!(annotated(&study).len(), 1);
}

#[test]
fn a_session_that_cannot_be_annotated_stops_no_other() {
    let study = study();
    assert_exit(&aim_batch().arg("run").arg(study.path()).arg("--out").arg(out(&study)).output().unwrap(), 0);
    let recording = out(&study).with_extension("work").join("mcap/S1.mcap");
    damage_picture(&recording);
    let said = run(&study, &[], 3);
    assert!(said.contains("session 'S1' has none") && said.contains("1 written"), "{said}");
    run(&study, &["--force"], 0);
    assert_eq!(annotated(&study).len(), 2);
}

fn damage_picture(recording: &Path) {
    let mut bytes = std::fs::read(recording).unwrap();
    let at = bytes.windows(3).position(|three| three == [0xff, 0xd8, 0xff]).unwrap();
    bytes[at + 20] ^= 0xff;
    std::fs::write(recording, bytes).unwrap();
}

/// Every image of the recording is in it, and it is one that this program reads.
#[test]
fn the_published_bench_is_annotated_whole() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("r.parquet");
    let ran = aim_batch().arg("run").arg(published_bench()).arg("--out").arg(&out).arg("--annotate").output().unwrap();
    assert_exit(&ran, 0);
    let work = out.with_extension("work");
    let recordings = files_below(&work.join("mcap"));
    assert_eq!(recordings.len(), 12);
    for recording in recordings.keys() {
        let session = recording.file_stem().unwrap().to_str().unwrap();
        let file = work.join(format!("annotated/{session}.annotated.mcap"));
        let (mut annotated, mut recorded) =
            (SessionReader::open(&file).unwrap(), SessionReader::open(recording).unwrap());
        assert_eq!(annotated.images().unwrap(), recorded.images().unwrap());
        assert_eq!(annotated.metadata(), recorded.metadata());
        assert!(annotated_key(&file).is_some());
    }
}
