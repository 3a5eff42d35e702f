//! Names in the two Unicode forms: as people type them, and as macOS stores them. Sizes are the known ones of exact marks.

use model::{Method, Quantity};
use report::Results;

use super::methods::{OBJECTS, shot};
use crate::support::{StudyFolder, assert_exit, label_me, line, run, small_camera, stderr};

/// `müller`, as typed and as macOS stores it.
const TYPED: &str = "m\u{fc}ller";
const STORED: &str = "mu\u{308}ller";

/// A study of one session with this name, whose plate is called `plate`; marked by rater A.
fn study(session: &str, plate: &str) -> StudyFolder {
    let study = StudyFolder::new("", &OBJECTS.replace("plate,plate", &format!("{plate},plate")), &small_camera());
    study.session(session, &[shot(55.0, 3.0, 560.0, 0.0, 1.0)]);
    study
}

/// The diameters of plates of a run that ends with `code`, by rater and object; and what it says.
fn plates(study: &StudyFolder, code: i32) -> (Vec<(String, String, f64)>, String) {
    let out = study.path().join("out/r.parquet");
    let output = run(["run", study.path().to_str().unwrap(), "--out", out.to_str().unwrap()]);
    assert_exit(&output, code);
    let rows = Results::read(&out).unwrap().rows;
    let of_plate = rows.into_iter().filter(|row| {
        row.method == Method::Ray && row.quantity == Quantity::Diameter && row.image.is_some() && row.object != "bowl"
    });
    let plates = of_plate.map(|row| (row.rater, row.object, row.predicted_mm.unwrap_or(f64::NAN))).collect();
    (plates, stderr(&output))
}

#[track_caller]
fn assert_plate(study: &StudyFolder, rater: &str, object: &str) {
    let (plates, said) = plates(study, 0);
    let [(got_rater, got_object, size_mm)] = plates.as_slice() else { panic!("{plates:?}\n{said}") };
    assert_eq!((got_rater.as_str(), got_object.as_str()), (rater, object));
    assert!((size_mm - 200.0).abs() < 0.5, "{size_mm}");
}

#[test]
fn a_session_is_the_same_in_both_forms() {
    for (card, marks) in [(STORED, TYPED), (TYPED, STORED)] {
        let study = study(card, "plate");
        std::fs::rename(study.path().join("marks/A").join(card), study.path().join("marks/A").join(marks)).unwrap();
        assert_plate(&study, "A", "plate");
    }
}

#[test]
fn an_object_is_the_same_in_both_forms() {
    for (listed, marked) in [(STORED, TYPED), (TYPED, STORED)] {
        let study = study("S", listed);
        let marks = study.path().join("marks/A/S").join(format!("{}.json", StudyFolder::image_stem(0)));
        let text = std::fs::read_to_string(&marks).unwrap();
        std::fs::write(&marks, text.replace("\"plate/", &format!("\"{marked}/"))).unwrap();
        assert_plate(&study, "A", TYPED);
    }
}

#[test]
fn a_rater_is_the_same_in_both_forms() {
    let study = study("S", "plate");
    let marks = study.path().join("marks");
    std::fs::rename(marks.join("A"), marks.join(STORED)).unwrap();
    assert_plate(&study, TYPED, "plate");
    let out = study.path().join("marks.json");
    let arguments = ["marks", "export", study.path().to_str().unwrap(), "--rater", TYPED, "--format", "coco", "-o"];
    assert_exit(&run([&arguments[..], &[out.to_str().unwrap()]].concat()), 0);
    let arguments = ["marks", "import", study.path().to_str().unwrap(), out.to_str().unwrap(), "--force", "--rater"];
    assert_exit(&run([&arguments[..], &[TYPED]].concat()), 0);
    assert_eq!(std::fs::read_dir(&marks).unwrap().count(), 1, "the folder of the rater is used as it is");
}

/// Two raters' folders that are one name: what is not read is told, and lost.
#[test]
fn two_folders_of_one_name_are_told() {
    let study = study("S", "plate");
    for rater in [TYPED, STORED] {
        let more = label_me(vec![line("plate/diameter", [[12.0, 24.0], [51.5, 24.25]])]);
        study.write(&format!("marks/{rater}/S/{}.json", StudyFolder::image_stem(0)), more.to_string());
    }
    let (plates, said) = plates(&study, 3);
    assert_eq!(plates.len(), 2, "rater A, and one of the two");
    assert!(
        said.contains("folders_alike") && said.contains("m\\u{fc}ller") && said.contains("mu\\u{308}ller"),
        "{said}"
    );
}

/// Two cards that are one name: both are measured by their own marks, and it is told.
#[test]
fn two_cards_of_one_name_are_told() {
    let study = study(TYPED, "plate");
    study.session(STORED, &[shot(55.0, 3.0, 560.0, 0.0, 1.0)]);
    let (plates, said) = plates(&study, 3);
    assert_eq!(plates.len(), 2);
    assert!(said.contains("folders_alike"), "{said}");
}
