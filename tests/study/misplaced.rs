//! Marks where people and tools put them, but the program does not read them: told as lost, with the command that mends it.

use std::path::Path;
use std::process::Command;

use model::{Method, Quantity};
use report::Results;

use super::methods::{OBJECTS, shot};
use crate::support::{StudyFolder, assert_exit, run, small_camera, stderr};

/// Two sessions, S1 marked on its first image and S2 on both, as no two sessions have marks for the same image.
fn study() -> StudyFolder {
    let study = StudyFolder::new("", OBJECTS, &small_camera());
    let shots = [shot(55.0, 3.0, 560.0, 0.0, 1.0), shot(58.0, 3.0, 540.0, 0.0, 1.0)];
    study.session("it's 1", &shots[..1]);
    study.session("S2", &shots);
    std::fs::remove_dir_all(study.path().join("marks/A/it's 1")).unwrap();
    std::fs::remove_dir_all(study.path().join("marks/A/S2")).unwrap();
    std::fs::remove_dir(study.path().join("marks/A")).unwrap();
    study
}

/// Writes the marks of the second picture of S2 to a folder.
fn put(study: &StudyFolder, folder: &str) {
    let marks = shot(58.0, 3.0, 540.0, 0.0, 1.0).marks.unwrap();
    study.write(&format!("{folder}/{}.json", StudyFolder::image_stem(1)), marks.to_string());
}

/// The diameters of plates that a run gives, which ends with `code`, and what it says.
fn plates(study: &Path, code: i32) -> (Vec<f64>, String) {
    let out = study.join("out/r.parquet");
    let output = run(["run", study.to_str().unwrap(), "--out", out.to_str().unwrap()]);
    assert_exit(&output, code);
    let rows = Results::read(&out).unwrap().rows;
    let plates = rows.into_iter().filter(|row| {
        let is_plate = row.object == "plate" && row.session == "S2" && row.image.is_some();
        is_plate && (row.method, row.quantity) == (Method::Ray, Quantity::Diameter)
    });
    (plates.filter_map(|row| row.predicted_mm).collect(), stderr(&output))
}

/// Runs the commands that the last run's problems of marks give, and returns them.
fn carry_out_remedies(study: &StudyFolder) -> Vec<String> {
    let text = std::fs::read_to_string(study.path().join("out/r.run.json")).unwrap();
    let run: serde_json::Value = serde_json::from_str(&text).unwrap();
    let problems =
        run["sessions"].as_array().unwrap().iter().flat_map(|session| session["problems"].as_array().unwrap());
    let misplaced = problems.filter(|problem| problem["code"] == "marks_misplaced");
    let commands = misplaced.map(|problem| {
        let remedy = problem["remedy"].as_str().unwrap().strip_prefix("in the study's folder: ").unwrap();
        let command = remedy.split(" (").next().unwrap().to_owned();
        let done = Command::new("sh").args(["-c", &command]).current_dir(study.path()).status().unwrap();
        assert!(done.success(), "{command}");
        command
    });
    commands.collect()
}

/// Marks in `folder` are told, and what the program says to do gives the known size.
#[track_caller]
fn assert_mended(folder: &str, rater: &str) {
    let study = study();
    put(&study, folder);
    let (none, said) = plates(study.path(), 3);
    assert_eq!(none, Vec::<f64>::new(), "{folder}");
    assert!(said.contains("marks_misplaced"), "{folder}: {said}");
    let [command] = carry_out_remedies(&study).try_into().unwrap();
    let moved = study.path().join(format!("marks/{rater}/S2/{}.json", StudyFolder::image_stem(1)));
    assert!(moved.exists(), "{folder}: {command}");
    let (sizes, said) = plates(study.path(), 0);
    assert!(matches!(sizes[..], [size] if (size - 200.0).abs() < 0.5), "{folder}: {sizes:?} {said}");
}

#[test]
fn marks_in_a_wrong_place_are_told_with_the_command_that_mends_it() {
    for (folder, rater) in [
        ("cards/S2/images", "RATER"), // LabelMe's default
        ("marks/S2", "RATER"),
        ("marks", "RATER"),
        ("marks/Anna B", "Anna B"),
        ("marks/S2/Anna", "Anna"), // the wrong way round
        ("marks/Anna/S2/images", "Anna"),
        ("marks/Anna/Anna/S2", "Anna"),
    ] {
        assert_mended(folder, rater);
    }
}

/// A name of a session that a shell would take apart; and two files, of which each belongs to another session.
#[test]
fn marks_of_two_sessions_in_one_folder_go_where_their_images_are() {
    let study = study();
    let marks = shot(55.0, 3.0, 560.0, 0.0, 1.0).marks.unwrap();
    let only = StudyFolder::image_stem(7);
    let first = study.path().join("cards/it's 1/images").join(format!("{}.jpg", StudyFolder::image_stem(0)));
    std::fs::rename(&first, first.with_file_name(format!("{only}.jpg"))).unwrap();
    study.write(&format!("marks/Anna/{only}.json"), marks.to_string());
    put(&study, "marks/Anna");
    let (_, said) = plates(study.path(), 3);
    assert_eq!(carry_out_remedies(&study).len(), 2, "{said}");
    assert!(study.path().join(format!("marks/Anna/it's 1/{only}.json")).exists(), "{said}");
    assert!(study.path().join(format!("marks/Anna/S2/{}.json", StudyFolder::image_stem(1))).exists(), "{said}");
}

/// Files beside the pictures that are no marks, or the same marks as a rater's, are nothing to tell.
#[test]
fn other_files_beside_the_pictures_are_no_marks() {
    let study = study();
    put(&study, "cards/S2/images");
    put(&study, "marks/A/S2");
    study.write(&format!("cards/S2/images/{}.json", StudyFolder::image_stem(0)), "{\"exposure\": 1}");
    let (sizes, said) = plates(study.path(), 0);
    assert_eq!(sizes.len(), 1);
    assert!(!said.contains("marks_misplaced"), "{said}");
}

/// A file of another tool among the marks.
#[test]
fn marks_of_another_tool_are_told_with_the_way_to_import_them() {
    let study = study();
    put(&study, "marks/A/S2");
    study.write("marks/A/coco.json", "{\"images\": [], \"annotations\": [], \"categories\": []}");
    let (sizes, said) = plates(study.path(), 3);
    assert_eq!(sizes.len(), 1);
    assert!(said.contains("aim-batch marks import STUDY FILE --rater RATER"), "{said}");
}
