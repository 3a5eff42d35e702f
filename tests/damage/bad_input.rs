//! Bad input: a clear message, nothing else lost.

use std::path::Path;
use std::process::Output;

use model::{FrameReason, ResultRow};

use crate::support::{Shot, StudyFolder, assert_exit, label_me, line, run, stderr};

const CAMERA: &str = "schema_version = 1\nname = \"c\"\nwidth_px = 64\nheight_px = 48\nfocal_px = [60.0, 60.0]\n\
                      principal_px = [32.0, 24.0]\n[lens]\nmodel = \"none\"\n";
const OBJECTS: &str = "object,kind,shape,true_diameter_mm\nplate,plate,circle,200\nbowl,bowl,circle,\n";

fn picture() -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image::RgbImage::new(64, 48).write_to(&mut bytes, image::ImageFormat::Jpeg).unwrap();
    bytes.into_inner()
}

fn marks() -> serde_json::Value {
    label_me(vec![line("plate/diameter", [[20.0, 24.0], [44.0, 24.0]])])
}

fn shot() -> Shot {
    Shot { picture: picture(), extension: "jpg", pitch_deg: 55.0, roll_deg: 0.0, range_mm: 500.0, marks: Some(marks()) }
}

/// A study with a whole session `good`; the tests damage another one.
fn study() -> StudyFolder {
    let study = StudyFolder::new("", OBJECTS, CAMERA);
    study.session("good", &[shot()]);
    study
}

fn run_study(study: &StudyFolder) -> Output {
    run(["run", study.path().to_str().unwrap(), "--out", out(study).to_str().unwrap()])
}

fn out(study: &StudyFolder) -> std::path::PathBuf {
    study.path().join("out/results.parquet")
}

fn rows(study: &StudyFolder) -> Vec<ResultRow> {
    report::Results::read(&out(study)).unwrap().rows
}

fn reasons(study: &StudyFolder, session: &str) -> Vec<FrameReason> {
    let frames = report::read_frames(&study.path().join("out/frames.parquet")).unwrap();
    frames.into_iter().filter(|frame| frame.session == session).map(|frame| frame.reason).collect()
}

/// Exit code 3, the facts on stderr, and the rows of session `good` as they are without the damage.
#[track_caller]
fn assert_told_and_rest_complete(study: &StudyFolder, facts: &[&str]) {
    let output = run_study(study);
    assert_exit(&output, 3);
    for fact in facts {
        assert!(stderr(&output).contains(fact), "'{fact}' is missing in\n{}", stderr(&output));
    }
    let whole = self::study();
    assert_exit(&run_study(&whole), 0);
    let good: Vec<_> = rows(study).into_iter().filter(|row| row.session == "good").collect();
    assert!(!good.is_empty());
    assert_eq!(good, rows(&whole));
}

#[test]
fn a_whole_study_exits_0_and_measures() {
    let study = study();
    assert_exit(&run_study(&study), 0);
    let rows = rows(&study);
    // 24 px at 60 px focal length over the range at the principal point
    assert!((rows[0].predicted_mm.unwrap() - 200.0).abs() < 1e-3, "{:?}", rows[0].predicted_mm);
    assert_eq!(reasons(&study, "good"), [FrameReason::Selected]);
}

#[test]
fn missing_card() {
    let study = study();
    study.write("marks/A/lost/x.json", marks().to_string());
    assert_told_and_rest_complete(&study, &["missing_card", "cards/lost", "copy the SD card there"]);
}

#[test]
fn empty_card() {
    let study = study();
    std::fs::create_dir_all(study.path().join("cards/empty")).unwrap();
    assert_told_and_rest_complete(
        &study,
        &["empty (session lost) [ingest] card_does_not_fit_profile", "profile 'csv'"],
    );
}

#[test]
fn empty_image() {
    let study = study();
    study.session("bad", &[shot(), Shot { picture: Vec::new(), ..shot() }]);
    assert_told_and_rest_complete(
        &study,
        &["empty_image", "0 bytes", "copy the file from the card again", "marked_image_dropped"],
    );
    assert_eq!(reasons(&study, "bad"), [FrameReason::Selected, FrameReason::EmptyImage]);
}

#[test]
fn not_an_image_and_a_picture_of_another_camera() {
    let study = study();
    let mut other = std::io::Cursor::new(Vec::new());
    image::RgbImage::new(10, 10).write_to(&mut other, image::ImageFormat::Jpeg).unwrap();
    let other = Shot { picture: other.into_inner(), marks: None, ..shot() };
    let text = Shot { picture: b"no picture at all".to_vec(), marks: None, ..shot() };
    study.session("bad", &[other, text]);
    assert_told_and_rest_complete(&study, &["wrong_size", "not_an_image"]);
    assert_eq!(reasons(&study, "bad"), [FrameReason::WrongSize, FrameReason::NotAnImage]);
}

#[test]
fn malformed_labelme() {
    let study = study();
    study.session("bad", &[shot()]);
    let file = format!("marks/A/bad/{}.json", StudyFolder::image_stem(0));
    study.write(&file, "{\"shapes\": [");
    assert_told_and_rest_complete(&study, &["marks_malformed", &file, "line 1 column", "LabelMe"]);
}

#[test]
fn marks_that_fit_nothing() {
    let study = study();
    let strange = label_me(vec![
        line("cup/diameter", [[20.0, 24.0], [44.0, 24.0]]),
        line("bowl/diameter", [[20.0, 24.0], [44.0, 24.0]]),
    ]);
    study.session("bad", &[Shot { marks: Some(strange), ..shot() }]);
    study.write("marks/A/bad/other.json", marks().to_string());
    assert_told_and_rest_complete(
        &study,
        &["unknown_object", "objects.csv, which has: bowl, plate", "no_height", "rim height", "marks_without_image"],
    );
    let bowl: Vec<_> = rows(&study).into_iter().filter(|row| row.object == "bowl").collect();
    assert!(!bowl.is_empty() && bowl.iter().all(|row| row.predicted_mm.is_none() && row.flags.contains("no_height")));
}

#[test]
fn a_camera_that_looks_above_the_horizon() {
    let study = study();
    study.session("bad", &[Shot { pitch_deg: -10.0, ..shot() }]);
    assert_told_and_rest_complete(&study, &["marked_image_without_pose", "never meets the table"]);
    assert_eq!(reasons(&study, "bad"), [FrameReason::NotBelowHorizon]);
}

#[test]
fn sensors_that_are_silent_or_wrong() {
    let study = study();
    study.session("bad", &[Shot { range_mm: 8190.0, marks: None, ..shot() }]);
    assert_told_and_rest_complete(&study, &["no_image_with_pose", "too few valid range samples"]);
    assert_eq!(reasons(&study, "bad"), [FrameReason::NoRange]);
    study.session("bad", &[Shot { range_mm: 0.45, marks: None, ..shot() }]);
    assert_told_and_rest_complete(
        &study,
        &["no_image_with_pose", "metres", "mm_per_count of the device profile: 1000"],
    );
    study.write("cards/bad/accel.csv", "time_s,x_g,y_g,z_g\n1704067210,0,-1,0\n");
    assert_told_and_rest_complete(&study, &["no_image_with_pose", "too few accelerometer samples"]);
    assert_eq!(reasons(&study, "bad"), [FrameReason::NoAcceleration]);
}

#[test]
fn bad_session_toml() {
    let study = study();
    study.session("bad", &[shot()]);
    study.write("cards/bad/session.toml", "particpant = \"P01\"\n");
    assert_told_and_rest_complete(&study, &["bad_session_toml", "particpant", "participant"]);
}

/// Marks on a corrected picture are of another camera; with a session's own camera that camera must be named too.
#[test]
fn a_session_camera_needs_its_own_marks_camera_where_the_study_has_one() {
    let corrected = CAMERA.replace("width_px = 64", "width_px = 128").replace("[32.0,", "[64.0,");
    let study = StudyFolder::new("[marks]\ncamera = \"corrected\"\n", OBJECTS, CAMERA);
    study.write("devices/corrected.toml", &corrected);
    study.session("good", &[shot()]);
    study.session("own", &[shot()]);
    study.write("cards/own/session.toml", "camera = \"cam\"\n");
    let output = run_study(&study);
    assert_exit(&output, 3);
    assert!(stderr(&output).contains("expected marks_camera here too"), "{}", stderr(&output));
    study.write("cards/own/session.toml", "camera = \"cam\"\nmarks_camera = \"corrected\"\n");
    assert_exit(&run_study(&study), 0);
    let of = |session: &str| {
        let row = rows(&study).into_iter().find(|row| row.session == session).unwrap();
        row.predicted_mm.unwrap()
    };
    assert!((of("own") - of("good")).abs() < 1e-9);
}

/// Problems are in the results too; they must not carry the paths of the machine.
#[test]
fn results_with_problems_do_not_depend_on_where_the_study_lies() {
    let bytes = |out: &str| {
        let study = study();
        study.session("bad", &[shot()]);
        study.write(&format!("marks/A/bad/{}.json", StudyFolder::image_stem(0)), "{");
        study.session("worse", &[shot()]);
        study.write("cards/worse/session.toml", "camera = \"none\"\n");
        std::fs::create_dir_all(study.path().join("cards/empty")).unwrap();
        let out = study.path().join(out);
        let arguments = ["run", study.path().to_str().unwrap(), "--out", out.to_str().unwrap()];
        assert_exit(&run(arguments), 3);
        (std::fs::read(&out).unwrap(), std::fs::read(out.with_file_name("frames.parquet")).unwrap())
    };
    assert!(bytes("here/results.parquet") == bytes("somewhere/else/results.parquet"));
}

#[cfg(unix)]
#[test]
fn a_card_behind_a_link_out_of_the_study_is_refused_and_told() {
    let study = study();
    let other = self::study();
    std::os::unix::fs::symlink(other.path().join("cards/good"), study.path().join("cards/linked")).unwrap();
    assert_told_and_rest_complete(&study, &["link_out_of_study", "cards/linked", "copy the card into the study"]);
}

#[test]
fn a_study_of_which_nothing_can_be_used_fails() {
    let study = StudyFolder::new("", OBJECTS, CAMERA);
    std::fs::create_dir_all(study.path().join("cards/empty")).unwrap();
    let output = run_study(&study);
    assert_exit(&output, 1);
    assert!(stderr(&output).contains("no session could be used"));
}

#[track_caller]
fn assert_refused(study: &Path, facts: &[&str]) {
    let output = run(["run", study.to_str().unwrap(), "--out", study.join("r.parquet").to_str().unwrap()]);
    assert_exit(&output, 2);
    for fact in facts {
        assert!(stderr(&output).contains(fact), "'{fact}' is missing in\n{}", stderr(&output));
    }
    assert!(!study.join("r.parquet").exists());
}

#[test]
fn unknown_key_in_study_toml() {
    let study = StudyFolder::new("[select]\ntarget_pich_deg = 50.0\n", OBJECTS, CAMERA);
    study.session("good", &[shot()]);
    assert_refused(
        study.path(),
        &["study.toml:6:1", "unknown key 'target_pich_deg'", "did you mean 'target_pitch_deg'"],
    );
}

#[test]
fn configuration_that_cannot_be() {
    let refused = |more: &str, objects: &str, facts: &[&str]| {
        let study = StudyFolder::new(more, objects, CAMERA);
        study.session("good", &[shot()]);
        assert_refused(study.path(), facts);
    };
    refused("[select]\ntarget_pitch_deg = 120.0\n", OBJECTS, &["select.target_pitch_deg = 120", "0 to 90 degrees"]);
    refused("[measure]\nmethods = [\"ray\", \"ray\"]\n", OBJECTS, &["measure.methods", "each method once"]);
    refused("time_zone = \"Mars/Olympus\"\n", OBJECTS, &["Mars/Olympus", "IANA"]);
    refused("", "object,kind,shape\nplate,plate,round\n", &["objects.csv", "round", "circle, square, rectangle"]);
    refused("", "object,kind,shape\nplate,plate,circle\nplate,bowl,circle\n", &["line 3", "a second time"]);
    refused("", "object,kind,shape,true_diameter_mm\nplate,plate,circle,-3\n", &["-3 mm", "a positive number"]);
    let table = "[[tables]]\nid = \"I\"\ntitle = \"t\"\nlayout = \"setups\"\nobjects = [\"cup\"]\nquantities = [\"width\"]\n\
                 method = \"ray\"\nselection = \"all\"\n";
    refused(table, OBJECTS, &["table 'I'", "'cup'", "objects.csv"]);
    assert_refused_folder();
}

fn assert_refused_folder() {
    let folder = tempfile::tempdir().unwrap();
    let nowhere = folder.path().join("nowhere");
    let output = run(["run", nowhere.to_str().unwrap()]);
    assert_exit(&output, 2);
    assert!(stderr(&output).contains("no folder here") && stderr(&output).contains("nowhere"));
}
