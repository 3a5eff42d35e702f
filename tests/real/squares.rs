//! Rectangular plates looked for in photographs that show none: round plates, bowls, boxes, boards.

use serde_json::Value;

use super::rims::labelled;
use super::{camera_file, number};
use crate::support::{assert_exit, real_data, run, stdout};

/// Rectangles of confidence 0.5 and more in a picture.
fn rectangles(picture: &str, camera: &str, pose: [f64; 3]) -> usize {
    let folder = tempfile::tempdir().unwrap();
    let camera_path = folder.path().join("cam.toml");
    std::fs::write(&camera_path, camera).unwrap();
    let mut arguments: Vec<String> =
        ["measure", picture, "--auto", "--json", "--shapes=rectangle"].map(String::from).into();
    arguments.push(format!("--camera={}", camera_path.display()));
    arguments.extend(["pitch", "roll", "range"].iter().zip(pose).map(|(name, value)| format!("--{name}={value}")));
    let output = run(&arguments);
    assert_exit(&output, 0);
    let rows: Vec<Value> = serde_json::from_str(&stdout(&output)).unwrap();
    rows.iter().filter(|row| row["method"] == "ray" && row["quantity"] == "width").count()
}

#[test]
fn none_among_bowls_and_cups() {
    let (Some(one), Some(other)) = (labelled("graspnet6dof_realsense"), labelled("uois_realsense")) else { return };
    for rim in one.into_iter().chain(other) {
        let photo = rim.photo;
        let pose = [photo.pitch_deg, photo.roll_deg, photo.range_mm];
        assert_eq!(rectangles(photo.path.to_str().unwrap(), &photo.camera, pose), 0, "{}", photo.path.display());
    }
}

#[test]
fn none_among_boxes_and_tins() {
    let Some(folder) = real_data("graspnet6dof_realsense") else { return };
    for frame in super::cases(folder.join("cases.json"))["frames"].as_array().unwrap() {
        let size = [0, 1].map(|i| frame["size"][i].as_u64().unwrap());
        let principal_px = [number(&frame["cx"]), number(&frame["cy"])];
        let camera = camera_file(size, [number(&frame["fx"]), number(&frame["fy"])], principal_px, "model = \"none\"");
        let range_mm = 1000.0 * number(&frame["distance_along_axis_m"]);
        let pose = [number(&frame["pitch_deg"]), -number(&frame["roll_deg"]), range_mm];
        let picture = folder.join(frame["color"].as_str().unwrap());
        assert_eq!(rectangles(picture.to_str().unwrap(), &camera, pose), 0, "{}", picture.display());
    }
}

#[test]
fn none_on_a_round_plate_with_bread() {
    let Some(folder) = real_data("meal_photos_graikos") else { return };
    let camera = camera_file([1920, 1080], [1500.0, 1500.0], [959.5, 539.5], "model = \"none\"");
    for (number_, pitch_deg, roll_deg) in [(1, 39.0, -3.0), (2, 35.0, 0.0), (3, 36.0, 0.0), (4, 47.0, 0.0)] {
        let picture = folder.join(format!("table_test_test_{number_}.jpg"));
        assert_eq!(rectangles(picture.to_str().unwrap(), &camera, [pitch_deg, roll_deg, 600.0]), 0, "{number_}");
    }
}
