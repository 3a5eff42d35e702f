//! A whole study made of real photographs: cards with the sensor readings of their poses, one camera per session, marks.

use model::{FrameReason, Level, Method, ResultRow};

use super::boards::{self, Board};
use super::{Photo, discs, summary};
use crate::support::{Shot, StudyFolder, assert_exit, label_me, run};

/// Any pitch counts, so that every photograph is selected.
const SETTINGS: &str = "[select]\ntarget_pitch_deg = 45.0\npitch_tolerance_deg = 45.0\n";

fn add_session(study: &StudyFolder, name: &str, photos: &[Photo], object: &str) {
    let shots: Vec<Shot> = photos
        .iter()
        .map(|photo| {
            let mut shapes = photo.shapes.clone();
            for shape in &mut shapes {
                let label = shape["label"].as_str().unwrap().split_once('/').unwrap().1.to_owned();
                shape["label"] = format!("{object}/{label}").into();
            }
            Shot {
                picture: std::fs::read(&photo.path).unwrap(),
                extension: "jpg",
                pitch_deg: photo.pitch_deg,
                roll_deg: photo.roll_deg,
                range_mm: photo.range_mm,
                marks: Some(label_me(shapes)),
            }
        })
        .collect();
    study.session(name, &shots);
    study.write(&format!("devices/{name}.toml"), &photos[0].camera);
    study.write(&format!("cards/{name}/session.toml"), format!("camera = \"{name}\"\n"));
}

fn errors_pct(rows: &[ResultRow], object: &str) -> Vec<f64> {
    let of_object = |row: &&ResultRow| row.object == object && row.method == Method::Ray && row.level == Level::Frame;
    rows.iter().filter(of_object).map(|row| row.error_pct.unwrap()).collect()
}

#[test]
fn real_photographs_as_a_study() {
    let (Some(discs), Some(stereo), Some(opencv), Some(wide)) = (
        discs::photos(|_| "disc".to_owned()),
        boards::board("boofcv_chess/bumblebee_left", boards::radial),
        boards::board("opencv_chess/left", boards::radial),
        boards::board("udacity_gopro_121deg", boards::division),
    ) else {
        return;
    };
    let truth = |name: &str, board: &Board| format!("{name},plate,rectangle,,{},{}\n", board.width_mm, board.length_mm);
    let objects = format!(
        "object,kind,shape,true_diameter_mm,true_width_mm,true_length_mm\ndisc,plate,circle,{},,\n{}{}{}",
        discs::DISC_MM,
        truth("stereo", &stereo),
        truth("opencv", &opencv),
        truth("wide", &wide),
    );
    let study = StudyFolder::new(SETTINGS, &objects, &discs[0].camera);
    add_session(&study, "discs", &discs, "disc");
    add_session(&study, "stereo", &stereo.photos, "stereo");
    add_session(&study, "opencv", &opencv.photos, "opencv");
    add_session(&study, "wide", &wide.photos, "wide");
    let out = study.path().join("results.parquet");
    assert_exit(&run(["run", study.path().to_str().unwrap(), "--out", out.to_str().unwrap()]), 0);

    let frames = report::read_frames(&study.path().join("frames.parquet")).unwrap();
    assert_eq!(frames.len(), 6 + 11 + 13 + 8);
    assert!(frames.iter().all(|frame| frame.reason == FrameReason::Selected), "every pose comes back from the sensors");
    let rows = report::Results::read(&out).unwrap().rows;
    for (object, median_pct) in [("disc", 1.6), ("stereo", 0.6), ("opencv", 0.6), ("wide", 0.6)] {
        let stats = summary(&format!("study of real photographs, {object}"), &errors_pct(&rows, object));
        assert!(stats.median_absolute < median_pct, "{object}");
    }
    let fused: Vec<_> = rows.iter().filter(|row| row.level == Level::Fused && row.method == Method::Ray).collect();
    assert_eq!(fused.len(), 1 + 2 + 2 + 2);
    assert!(fused.iter().all(|row| row.error_pct.unwrap().abs() < 1.6));
}
