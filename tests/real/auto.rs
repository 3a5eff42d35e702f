//! Rims that the program finds by itself, in the photographs whose rims other programs marked, and in those without labels.

use serde_json::Value;

use super::rims::{Labelled, labelled};
use super::{camera_file, number, point, summary};
use crate::support::{assert_exit, real_data, run, stdout};

/// The output of `measure --auto` for a picture.
fn auto(picture: &str, camera: &str, pose: [f64; 3], more: &[String]) -> Vec<Value> {
    let folder = tempfile::tempdir().unwrap();
    let camera_path = folder.path().join("cam.toml");
    std::fs::write(&camera_path, camera).unwrap();
    let mut arguments: Vec<String> = ["measure", picture, "--auto", "--json"].map(String::from).into();
    arguments.push(format!("--camera={}", camera_path.display()));
    for (name, value) in ["pitch", "roll", "range"].iter().zip(pose) {
        arguments.push(format!("--{name}={value}"));
    }
    arguments.extend_from_slice(more);
    let output = run(&arguments);
    assert_exit(&output, 0);
    serde_json::from_str(&stdout(&output)).unwrap()
}

/// The diameter of the likeliest rim whose centre lies near the labelled one's, in per cent off the reference.
fn error_pct(one: &Labelled, rim_height: bool) -> Option<f64> {
    let photo = &one.photo;
    let mut more = vec!["--kind=bowl".to_owned()];
    more.extend(photo.rim_height_mm.filter(|_| rim_height).map(|mm| format!("--rim-height={mm}")));
    let pose = [photo.pitch_deg, photo.roll_deg, photo.range_mm];
    let rows = auto(photo.path.to_str().unwrap(), &photo.camera, pose, &more);
    let bounds = |axis: usize| {
        let values = one.rim_px.iter().map(move |p| p[axis]);
        (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max))
    };
    let (x, y) = (bounds(0), bounds(1));
    let extent = (x.1 - x.0).max(y.1 - y.0);
    let is_near = |row: &&Value| {
        let [cx, cy] = point(&row["center_px"]);
        let off = ((cx - 0.5 * (x.0 + x.1)).abs()).max((cy - 0.5 * (y.0 + y.1)).abs());
        row["quantity"] == "diameter" && row["method"] == "ray" && off < 0.25 * extent
    };
    let best =
        rows.iter().filter(is_near).max_by(|a, b| number(&a["confidence"]).total_cmp(&number(&b["confidence"])))?;
    let error_pct = 100.0 * (number(&best["predicted_mm"]) / one.reference_mm - 1.0);
    println!("{} {error_pct:+.2} %, height from {}", photo.path.display(), best["rim_height_from"]);
    Some(error_pct)
}

#[test]
fn labelled_rims_are_found_and_measured() {
    let (Some(one), Some(other)) = (labelled("graspnet6dof_realsense"), labelled("uois_realsense")) else { return };
    let all: Vec<Labelled> = one.into_iter().chain(other).collect();
    assert_eq!(all.len(), 14);
    for (rim_height, most_pct) in [(true, 2.0), (false, 5.0)] {
        let errors: Vec<f64> = all.iter().filter_map(|one| error_pct(one, rim_height)).collect();
        assert!(errors.len() >= 13, "{} of 14 rims found", errors.len());
        let stats = summary(if rim_height { "rim height given" } else { "nothing given" }, &errors);
        assert!(stats.median_absolute < most_pct, "median {:.2} %", stats.median_absolute);
    }
}

/// Boxes, a bottle and tins on a table, no bowl in reach: nothing wide is taken for a rim.
#[test]
fn tables_without_bowls_have_no_wide_rims() {
    let Some(folder) = real_data("graspnet6dof_realsense") else { return };
    let cases = super::cases(folder.join("cases.json"));
    for frame in cases["frames"].as_array().unwrap() {
        let name = frame["name"].as_str().unwrap();
        if !["6dof_cheezit", "6dof_sugar", "6dof_mustard", "6dof_pepper"].contains(&name) {
            continue;
        }
        let size = [0, 1].map(|i| frame["size"][i].as_u64().unwrap());
        let principal_px = [number(&frame["cx"]), number(&frame["cy"])];
        let camera = camera_file(size, [number(&frame["fx"]), number(&frame["fy"])], principal_px, "model = \"none\"");
        let pose = [
            number(&frame["pitch_deg"]),
            -number(&frame["roll_deg"]),
            1000.0 * number(&frame["distance_along_axis_m"]),
        ];
        let picture = folder.join(frame["color"].as_str().unwrap());
        let rows = auto(picture.to_str().unwrap(), &camera, pose, &[]);
        assert!(rows.is_empty(), "{name}: {} sizes", rows.len());
    }
}

/// Plates with bread on a table, pose estimated: one rim each, wide, with almost no doubt. There is no scale.
#[test]
fn plates_with_food_are_found() {
    let Some(folder) = real_data("meal_photos_graikos") else { return };
    let camera = camera_file([1920, 1080], [1500.0, 1500.0], [959.5, 539.5], "model = \"none\"");
    for (number_, pitch_deg, roll_deg) in [(1, 39.0, -3.0), (2, 35.0, 0.0), (3, 36.0, 0.0), (4, 47.0, 0.0)] {
        let picture = folder.join(format!("table_test_test_{number_}.jpg"));
        let rows = auto(picture.to_str().unwrap(), &camera, [pitch_deg, roll_deg, 600.0], &["--kind=plate".to_owned()]);
        let wide: Vec<&Value> =
            rows.iter().filter(|row| row["method"] == "ray" && number(&row["predicted_mm"]) > 150.0).collect();
        assert_eq!(wide.len(), 1, "picture {number_}: {}", wide.len());
        assert!(number(&wide[0]["confidence"]) > 0.9);
    }
}
