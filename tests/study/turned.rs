//! Pictures that EXIF tells viewers to turn: the sizes are those of the same pictures without the tag, or marks are refused.

use model::{Method, Orientation, Quantity};
use report::Results;
use serde_json::{Value, json};

use super::methods::{OBJECTS, shot};
use crate::support::{Shot, StudyFolder, assert_exit, run, small_camera, stderr};

const SIZE_PX: [u32; 2] = [64, 48];

/// The picture with a tag, and its marks as LabelMe 6.3.1 writes them: on the turned picture.
fn turned(orientation: Orientation, size: Option<[u32; 2]>) -> Shot {
    let upright = shot(55.0, 3.0, 560.0, 0.0, 1.0);
    let number = u8::try_from(orientation.exif()).unwrap();
    let exif =
        [b"\xff\xe1\0\x22Exif\0\0II\x2a\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0".as_slice(), &[number, 0, 0, 0]];
    let picture = [&upright.picture[..2], &exif.concat(), &[0; 4], &upright.picture[2..]].concat();
    let mut marks = upright.marks.clone().unwrap();
    for point in marks["shapes"].as_array_mut().unwrap().iter_mut().flat_map(|s| s["points"].as_array_mut().unwrap()) {
        let stored = [0, 1].map(|axis| point[axis].as_f64().unwrap());
        *point = json!(orientation.shown_from_stored(stored, SIZE_PX));
    }
    if let Some([width, height]) = size {
        marks["imageWidth"] = json!(width);
        marks["imageHeight"] = json!(height);
    }
    Shot { picture, marks: Some(marks), ..upright }
}

fn study_of(shot: Shot, settings: &str) -> StudyFolder {
    let study = StudyFolder::new(settings, OBJECTS, &small_camera());
    study.session("S", &[shot]);
    study
}

/// The diameter of the plate (true: 200 mm) that a run gives, which ends with `code`, and what it says.
fn plate_mm(study: &StudyFolder, code: i32) -> (Option<f64>, String) {
    let out = study.path().join("out/r.parquet");
    let output = run(["run", study.path().to_str().unwrap(), "--out", out.to_str().unwrap()]);
    assert_exit(&output, code);
    let rows = Results::read(&out).unwrap().rows;
    let plate = rows.iter().find(|row| {
        row.object == "plate" && row.image.is_some() && (row.method, row.quantity) == (Method::Ray, Quantity::Diameter)
    });
    (plate.and_then(|row| row.predicted_mm), stderr(&output))
}

#[track_caller]
fn assert_true((plate_mm, said): (Option<f64>, String), case: &str) {
    assert!(plate_mm.is_some_and(|mm| (mm - 200.0).abs() < 0.5), "{case}: {plate_mm:?}\n{said}");
}

#[test]
fn marks_on_the_shown_picture_give_the_true_size() {
    for orientation in Orientation::ALL {
        let shown_px = orientation.shown_size_px(SIZE_PX);
        let study = study_of(turned(orientation, Some(shown_px)), "");
        assert_true(plate_mm(&study, 0), &format!("{orientation:?}"));
    }
}

#[test]
fn marks_in_an_unknown_frame_are_refused_until_it_is_said() {
    for version in [json!("3.0.0"), Value::Null] {
        let mut shot = turned(Orientation::HalfTurn, Some(SIZE_PX));
        shot.marks.as_mut().unwrap()["version"] = version;
        let (none, said) = plate_mm(&study_of(shot.clone(), ""), 3);
        assert_eq!(none, None, "{said}");
        assert!(said.contains("marks_frame_unknown") && said.contains("EXIF orientation 3"), "{said}");
        assert_true(plate_mm(&study_of(shot, "[marks]\nframe = \"shown\"\n"), 0), "shown");
    }
    let stored = shot(55.0, 3.0, 560.0, 0.0, 1.0).marks;
    let shot = Shot { marks: stored, ..turned(Orientation::Mirrored, None) };
    assert_true(plate_mm(&study_of(shot, "[marks]\nframe = \"stored\"\n"), 0), "stored");
}

/// The plate's outline as COCO, which does not say how the tool shows pictures.
fn coco(shot: &Shot, [width, height]: [u32; 2]) -> Value {
    let shapes = shot.marks.as_ref().unwrap()["shapes"].as_array().unwrap();
    let points: Vec<Value> =
        shapes[3]["points"].as_array().unwrap().iter().flat_map(|p| p.as_array().unwrap().clone()).collect();
    let name = format!("{}.jpg", StudyFolder::image_stem(0));
    json!({
        "images": [{"id": 1, "file_name": name, "width": width, "height": height}],
        "categories": [{"id": 1, "name": "plate/rim"}],
        "annotations": [{"id": 1, "image_id": 1, "category_id": 1, "segmentation": [points]}],
    })
}

#[test]
fn imported_marks_are_carried_over_or_refused() {
    for (orientation, frame, code) in [
        (Orientation::Clockwise, None, 0), // the size shows that the picture was turned
        (Orientation::HalfTurn, Some("shown"), 0),
        (Orientation::HalfTurn, None, 1),
    ] {
        let shot = turned(orientation, None);
        let coco = coco(&shot, orientation.shown_size_px(SIZE_PX));
        let study = study_of(Shot { marks: None, ..shot }, "");
        study.write("coco.json", coco.to_string());
        let (folder, file) = (study.path().to_str().unwrap(), study.path().join("coco.json"));
        let mut arguments = vec!["marks", "import", folder, file.to_str().unwrap(), "--rater", "A"];
        arguments.extend(frame.map(|frame| ["--frame", frame]).into_iter().flatten());
        let output = run(arguments);
        assert_exit(&output, code);
        if code == 0 {
            assert_true(plate_mm(&study, 0), &format!("{orientation:?}"));
        } else {
            assert!(stderr(&output).contains("EXIF orientation 3"), "{}", stderr(&output));
        }
    }
}
