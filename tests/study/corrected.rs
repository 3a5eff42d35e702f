//! Rims that a person corrects in the files of `--write-marks` count, whoever is asked for marks.

use std::path::{Path, PathBuf};

use model::{Level, Quantity, ResultRow};
use serde_json::{Value, json};

use super::auto::{by_ray, run, study};
use crate::support::{StudyFolder, stderr};

const AUTO: [&str; 2] = ["--marks", "auto"];

/// A study with the files that a run of it wrote, and the rows of that run.
fn written() -> (StudyFolder, PathBuf, Vec<ResultRow>) {
    let study = study();
    let marks = study.path().join("marks");
    let rows = run(&study, "first", &with_marks(&marks), 0).rows();
    (study, marks, rows)
}

fn with_marks(marks: &Path) -> Vec<&str> {
    [&AUTO[..], &["--write-marks", marks.to_str().unwrap()]].concat()
}

/// The file of the first image of S1.
fn first_file(marks: &Path) -> PathBuf {
    marks.join(format!("auto/S1/{}.json", StudyFolder::image_stem(0)))
}

fn change(file: &Path, change: impl FnOnce(&mut Value)) {
    let mut json: Value = serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap();
    change(&mut json);
    std::fs::write(file, json.to_string()).unwrap(); // in one line, with keys in another order
}

/// Makes the first shape larger about its middle.
fn enlarge(json: &mut Value, factor: f64) {
    let points: Vec<[f64; 2]> = serde_json::from_value(json["shapes"][0]["points"].clone()).unwrap();
    let middle = [0, 1].map(|axis| points.iter().map(|point| point[axis]).sum::<f64>() / points.len() as f64);
    let moved = |point: &[f64; 2]| [0, 1].map(|axis| middle[axis] + factor * (point[axis] - middle[axis]));
    json["shapes"][0]["points"] = json!(points.iter().map(moved).collect::<Vec<_>>());
}

fn is_first_image(row: &ResultRow) -> bool {
    row.session == "S1" && row.image.as_deref().is_some_and(|image| image.contains(&StudyFolder::image_stem(0)))
}

/// The diameter of the plate in the first image, which must be there once.
#[track_caller]
fn first_diameter(rows: &[ResultRow]) -> ResultRow {
    let mut rows = by_ray(rows, Level::Frame, Quantity::Diameter);
    rows.retain(is_first_image);
    assert_eq!(rows.len(), 1, "{rows:?}");
    rows.remove(0)
}

#[test]
fn a_corrected_rim_counts_and_says_so() {
    let (study, marks, before) = written();
    let file = first_file(&marks);
    change(&file, |json| enlarge(json, 1.1));
    let text = std::fs::read_to_string(&file).unwrap();
    let was = first_diameter(&before);
    for source in ["auto", "both", "manual"] {
        let ran = run(&study, source, &["--marks", source], 0);
        let rows = ran.rows();
        let is = first_diameter(&rows);
        let factor = is.predicted_mm.unwrap() / was.predicted_mm.unwrap();
        assert!((factor - 1.1).abs() < 0.01, "{source}: {factor}");
        assert_eq!(
            (is.rater.as_str(), is.flags.as_str(), is.confidence),
            ("auto", "range_held,corrected", None),
            "{source}"
        );
        let others = |rows: &[ResultRow]| -> Vec<String> {
            let is_other = |row: &&ResultRow| row.session == "S2" || row.level == Level::Frame && !is_first_image(row);
            let text = |row: &ResultRow| {
                format!("{} {:?} {} {} {:?}", row.object, row.image, row.quantity, row.method, row.predicted_mm)
            };
            rows.iter().filter(is_other).map(text).collect()
        };
        assert_eq!(others(&rows), others(&before), "{source}: the others keep their names and sizes");
        let fused = by_ray(&rows, Level::Fused, Quantity::Diameter);
        let fused = fused.iter().find(|row| row.session == "S1").unwrap();
        assert!(fused.flags.split(',').any(|flag| flag == "corrected"), "{}", fused.flags);
        assert_eq!((fused.frames, fused.confidence), (3, None));
    }
    let again = run(&study, "first", &with_marks(&marks), 0);
    assert!(stderr(&again.output).contains("1 more hold what a person has made or corrected"));
    assert!(!stderr(&again.output).to_lowercase().contains("delete"));
    assert_eq!(std::fs::read_to_string(&file).unwrap(), text);
    assert_eq!(
        first_diameter(&again.rows()).predicted_mm,
        first_diameter(&run(&study, "auto", &AUTO, 0).rows()).predicted_mm
    );
}

#[test]
fn a_person_may_delete_name_and_add_rims() {
    let (study, marks, _) = written();
    let file = first_file(&marks);
    change(&file, |json| json["shapes"][0]["label"] = json!("dinner plate/rim"));
    let named = first_diameter(&run(&study, "r", &AUTO, 0).rows());
    assert_eq!(
        (named.object.as_str(), named.flags.as_str(), named.confidence),
        ("dinner plate", "range_held,corrected", None)
    );
    assert!(named.error_pct.unwrap().abs() < 1.0);

    change(&file, |json| json["shapes"] = json!([]));
    let rows = run(&study, "r", &AUTO, 0).rows();
    assert!(!rows.iter().any(is_first_image), "there is no rim, a person says");
    assert!(by_ray(&rows, Level::Fused, Quantity::Diameter).iter().any(|row| row.session == "S1" && row.frames == 2));

    // A file that LabelMe made, without any key of this program.
    let stem = StudyFolder::image_stem(1);
    change(&file.with_file_name(format!("{stem}.json")), |json| {
        json.as_object_mut().unwrap().remove("aim_batch");
        json["shapes"][0].as_object_mut().unwrap().remove("aim_batch");
        json["shapes"][0]["label"] = json!("dinner plate/rim");
    });
    let rows = run(&study, "r", &AUTO, 0).rows();
    let of_image =
        |row: &&ResultRow| row.session == "S1" && row.image.as_deref().is_some_and(|image| image.contains(&stem));
    let rows: Vec<&ResultRow> = rows.iter().filter(of_image).collect();
    assert!(!rows.is_empty());
    assert!(rows.iter().all(|row| row.object == "dinner plate" && row.flags.contains("corrected")), "{rows:?}");
}

#[test]
fn files_that_nobody_changed_are_the_program_s_own() {
    let (study, marks, before) = written();
    change(&first_file(&marks), |json| {
        json["version"] = json!("6.3.1"); // saved again
        json["shapes"][0]["description"] = json!("");
    });
    let ran = run(&study, "first", &AUTO, 0);
    assert_eq!(ran.rows(), before);
    let toml = std::fs::read_to_string(study.path().join("study.toml")).unwrap();
    study.write("study.toml", format!("{toml}\n[marks]\nmin_confidence = 1.0\n"));
    let searched_less = run(&study, "less", &AUTO, 0).rows();
    assert!(searched_less.is_empty(), "old files are not read: {searched_less:?}");
}

#[test]
fn a_file_of_corrections_that_cannot_be_read_is_a_loss() {
    let (study, marks, _) = written();
    std::fs::write(first_file(&marks), "{\"shapes\": [").unwrap();
    let ran = run(&study, "r", &AUTO, 3);
    let sessions = ran.sessions();
    let problems: Vec<_> =
        sessions.iter().flat_map(|session| &session.problems).map(|problem| problem.code.code()).collect();
    assert!(problems.contains(&"marks_malformed"), "{problems:?}");
}
