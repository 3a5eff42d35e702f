//! `check` tells before a run what the run would lose, and writes nothing.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Output;

use serde_json::Value;

use crate::support::{
    Shot, StudyFolder, assert_exit, copy_folder, files_below, label_me, line, published_bench, run, small_camera,
    small_picture, stderr, stdout,
};

const OBJECTS: &str = "object,kind,shape,true_diameter_mm\nplate,plate,circle,200\nbowl,bowl,circle,\n";

fn shot() -> Shot {
    let marks = label_me(vec![line("plate/diameter", [[20.0, 24.0], [44.0, 24.0]])]);
    Shot {
        picture: small_picture(),
        extension: "jpg",
        pitch_deg: 55.0,
        roll_deg: 0.0,
        range_mm: 500.0,
        marks: Some(marks),
    }
}

/// A study with a whole session, one that loses data in several ways, one that fails, and marks without a card.
fn damaged() -> StudyFolder {
    let study = StudyFolder::new("", OBJECTS, &small_camera());
    study.session("good", &[shot(), Shot { marks: None, ..shot() }]);
    study.session(
        "loses",
        &[
            Shot { picture: Vec::new(), ..shot() },
            Shot { picture: b"no picture at all".to_vec(), marks: None, ..shot() },
            Shot { pitch_deg: -10.0, ..shot() },
            shot(),
        ],
    );
    study.write(&format!("marks/A/loses/{}.json", StudyFolder::image_stem(3)), "{");
    study.write("marks/B/loses/other.json", shot().marks.unwrap().to_string());
    std::fs::create_dir_all(study.path().join("cards/fails")).unwrap();
    study.write("marks/A/no-card/x.json", "{}");
    study
}

fn check(study: &Path, more: &[&str]) -> Output {
    run([&["check", study.to_str().unwrap()], more].concat())
}

fn json(output: &Output) -> Value {
    serde_json::from_str(&stdout(output)).unwrap()
}

#[test]
fn the_published_bench_would_run_whole() {
    let output = check(&published_bench(), &[]);
    assert_exit(&output, 0);
    let text = stdout(&output);
    assert!(text.contains("12 sessions: 12 would run whole\n") && text.contains("Flow of images"), "{text}");

    let document = json(&check(&published_bench(), &["--json"]));
    assert_eq!(document["verdict"], serde_json::json!({"sessions": 12, "whole": 12, "loses_data": 0, "fails": 0}));
    let images = document["sessions"].as_array().unwrap().iter().map(|s| s["images"].as_u64().unwrap()).sum::<u64>();
    assert_eq!(document["flow"]["steps"]["found"], images);
    assert_eq!(document["study_problems"], serde_json::json!([]));
}

/// Session, stage, code, severity, place and fact of every problem, and the counts.
fn statuses(sessions: &Value) -> BTreeSet<String> {
    let of = |session: &Value| {
        let name = session["session"].clone();
        let counts =
            ["failed", "images", "with_pose", "selected", "sizes"].map(|key| format!("{key}={}", session[key]));
        let problems = session["problems"].as_array().unwrap().iter().map(move |problem| format!("{name} {problem}"));
        problems.chain([format!("{} {}", session["session"], counts.join(" "))]).collect::<Vec<_>>()
    };
    sessions.as_array().unwrap().iter().flat_map(of).collect()
}

#[test]
fn a_check_tells_what_the_run_then_tells() {
    let study = damaged();
    let checked = check(study.path(), &["--json"]);
    assert_exit(&checked, 3);
    let out = tempfile::tempdir().unwrap();
    let results = out.path().join("results.parquet");
    assert_exit(&run(["run", study.path().to_str().unwrap(), "--out", results.to_str().unwrap()]), 3);
    let ran = report::Results::read(&results).unwrap();
    let ran = serde_json::to_value(&ran.metadata.sessions).unwrap();
    let document = json(&checked);
    assert_eq!(statuses(&document["sessions"]), statuses(&ran));
    let said = document.to_string();
    for code in ["empty_image", "not_an_image", "marks_malformed", "marks_without_image", "missing_card"] {
        assert!(said.contains(code), "{code} is missing in\n{said}");
    }
    assert_eq!(document["verdict"], serde_json::json!({"sessions": 4, "whole": 1, "loses_data": 1, "fails": 2}));
    let left_out = &document["flow"]["left_out"];
    assert_eq!((&left_out["empty_image"], &left_out["not_below_horizon"]), (&Value::from(1), &Value::from(1)));
}

#[test]
fn people_read_losses_with_remedies_and_a_verdict() {
    let study = damaged();
    let output = check(study.path(), &[]);
    assert_exit(&output, 3);
    let text = stdout(&output);
    for said in [
        "fails: would fail\n  loss [ingest] card_does_not_fit_profile: cards/fails\n",
        "loses: would lose data (and ",
        "no-card: would fail\n",
        "-> copy the SD card there, or move this session's marks out of the study\n",
        "the study as a whole\n  note [study] object_never_measured: objects.csv\n      'bowl' has no mark",
        "4 sessions: 1 would run whole, 1 would lose data, 2 would fail\n",
    ] {
        assert!(text.contains(said), "'{said}' is missing in\n{text}");
    }
    assert!(!text.contains("good: "), "{text}");
}

#[test]
fn notes_are_counted_and_shown_on_request() {
    let study = StudyFolder::new("", OBJECTS, &small_camera());
    study.session("good", &[shot(), shot()]); // the sensors are silent for some seconds between two shots
    let output = check(study.path(), &[]);
    assert_exit(&output, 0);
    let text = stdout(&output);
    assert!(text.contains(" not shown: --notes\n") && !text.contains("note [ingest] gaps"), "{text}");
    let output = check(study.path(), &["--notes"]);
    assert_exit(&output, 0);
    let text = stdout(&output);
    assert!(text.contains("good: would run whole\n  note [ingest] gaps: cards/good\n"), "{text}");
    assert!(!text.contains("not shown"), "{text}");
}

#[test]
fn a_table_that_would_stay_empty_is_told() {
    let table = "[[tables]]\nid = \"I\"\ntitle = \"t\"\nlayout = \"setups\"\nobjects = [\"plate\"]\n\
                 quantities = [\"width\"]\nmethod = \"ray\"\nselection = \"all\"\n";
    let fits = table.replace("width", "diameter").replace("\"I\"", "\"II\"");
    let study = StudyFolder::new(&format!("{table}{fits}"), OBJECTS, &small_camera());
    study.session("good", &[shot()]);
    let output = check(study.path(), &[]);
    assert_exit(&output, 0);
    let text = stdout(&output);
    assert!(text.contains("no size fits table 'I': ") && !text.contains("table 'II'"), "{text}");
}

#[test]
fn nothing_is_written_into_the_study_or_left_elsewhere() {
    let study = damaged();
    let temporary = tempfile::tempdir().unwrap();
    let before = files_below(study.path());
    for command in ["check", "inspect"] {
        let mut aim_batch = crate::support::aim_batch();
        let output = aim_batch.arg(command).arg(study.path()).env("TMPDIR", temporary.path()).output().unwrap();
        assert_exit(&output, 3);
        assert_eq!(files_below(study.path()), before);
        assert!(files_below(temporary.path()).is_empty());
    }
}

#[test]
fn exit_codes_are_those_of_a_run() {
    let study = StudyFolder::new("", OBJECTS, &small_camera());
    std::fs::create_dir_all(study.path().join("cards/empty")).unwrap();
    let output = check(study.path(), &[]);
    assert_exit(&output, 1);
    assert!(stderr(&output).contains("no session could be used") && stdout(&output).contains("1 would fail"));
    assert_exit(&check(study.path(), &["--target-pitch", "120"]), 2);
    assert_exit(&check(&study.path().join("nowhere"), &[]), 2);
    study.write("study.toml", "schema_version = 1\n");
    assert_exit(&check(study.path(), &[]), 2);
}

/// The settings of the command line hold as they do for a run.
#[test]
fn settings_of_the_command_line_hold() {
    let study = StudyFolder::new("", OBJECTS, &small_camera());
    study.session("good", &[shot()]);
    let selected =
        |more: &[&str]| json(&check(study.path(), &[&["--json"], more].concat()))["flow"]["steps"]["selected"].clone();
    assert_eq!((selected(&[]), selected(&["--target-pitch", "30"])), (Value::from(1), Value::from(0)));
}

/// The lag of the images needs pictures, which a check does not keep; that it is asked for loses nothing.
#[test]
fn a_study_that_asks_for_the_lag_is_checked_without_it() {
    let study = StudyFolder::new("[time]\nestimate_lag = true\n", OBJECTS, &small_camera());
    study.session("good", &[shot(), shot()]);
    let output = check(study.path(), &["--json"]);
    assert_exit(&output, 0);
    assert!(!stdout(&output).contains("image_lag") && !stdout(&output).contains("bad_mcap"));
}

/// The sample study with one mistake in its set-up, and the first session's problem of that code.
#[track_caller]
fn mistaken(code: &str, change: impl FnOnce(&Path)) -> String {
    let folder = tempfile::tempdir().unwrap();
    let study = folder.path().join("study");
    copy_folder(&published_bench(), &study);
    change(&study);
    let output = check(&study, &["--json"]);
    assert_exit(&output, 3);
    let document = json(&output);
    let problems = document["sessions"].as_array().unwrap().iter().flat_map(|s| s["problems"].as_array().unwrap());
    let told = problems
        .filter(|problem| problem["code"] == code)
        .map(|problem| format!("{}; {}", problem["fact"], problem["remedy"]));
    told.collect::<Vec<_>>().first().unwrap_or_else(|| panic!("no {code}: {document}")).clone()
}

fn built_in_profile(study: &Path, from: &str, to: &str) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../ingest/profiles/aim2-packets.toml");
    let text = std::fs::read_to_string(root).unwrap();
    assert!(text.contains(from), "{text}");
    std::fs::create_dir_all(study.join("devices")).unwrap();
    std::fs::write(study.join("devices/aim2-packets.toml"), text.replace(from, to)).unwrap();
}

#[test]
fn implausible_set_ups_are_told_with_their_likely_cause() {
    let sign = |study: &Path| built_in_profile(study, "mount_pitch_deg = 21.0", "mount_pitch_deg = -21.0");
    let told = mistaken("implausible_pose", sign);
    assert!(told.contains("with 21 instead of -21 degrees"), "{told}");
    let swapped = |study: &Path| built_in_profile(study, "[\"+x\", \"+y\", \"+z\"]", "[\"+y\", \"+x\", \"+z\"]");
    let told = mistaken("implausible_pose", swapped);
    assert!(told.contains("right and down are swapped"), "{told}");
    let unit = |study: &Path| built_in_profile(study, "mm_per_count = 1.0", "mm_per_count = 0.2");
    let told = mistaken("implausible_range", unit);
    assert!(told.contains("cm, not mm"), "{told}");
    let unit = |study: &Path| built_in_profile(study, "g_per_count = 0.001 ", "g_per_count = 0.0001 ");
    let told = mistaken("implausible_gravity", unit);
    assert!(told.contains("10 times too small"), "{told}");
}
