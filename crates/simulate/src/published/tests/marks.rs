use model::{Mark, Method, ObjectMarks, Pose, Quantity, View, measure};
use nalgebra::Point2;

use super::catalogue::container_of;
use super::tables::{RATERS, RaterRow};
use super::*;

/// The sizes in mm that one LabelMe file gives by the paper's method, as (object, quantity, size).
fn sizes_of(file: &Path, pitch_deg: f64, range_mm: f64) -> Vec<(String, Quantity, f64)> {
    let json: serde_json::Value = serde_json::from_slice(&fs::read(file).unwrap()).unwrap();
    let mut object = String::new();
    let mut marks = Vec::new();
    for shape in json["shapes"].as_array().unwrap() {
        let (name, quantity) = shape["label"].as_str().unwrap().rsplit_once('/').unwrap();
        name.clone_into(&mut object);
        let end =
            |i: usize| Point2::new(shape["points"][i][0].as_f64().unwrap(), shape["points"][i][1].as_f64().unwrap());
        marks.push(Mark::Line { quantity: quantity.parse().unwrap(), ends_px: [end(0), end(1)] });
    }
    let pose = Pose::new(pitch_deg.to_radians(), 0.0, range_mm).unwrap();
    let view = View::new(camera().unwrap(), pose);
    let container = container_of(&object);
    measure(&view, Method::Paper, &container, &ObjectMarks { object: object.clone(), marks })
        .into_iter()
        .map(|(quantity, measured)| (object.clone(), quantity, measured.unwrap().predicted_mm))
        .collect()
}

fn assert_size(sizes: &[(String, Quantity, f64)], object: &str, quantity: Quantity, expected_cm: f64) {
    let (.., got_mm) = sizes.iter().find(|(o, q, _)| o == object && *q == quantity).unwrap();
    assert!((got_mm - expected_cm * 10.0).abs() < 1e-6, "{object} {quantity}: {got_mm} mm for {expected_cm} cm");
}

#[test]
fn bench_marks_give_the_published_predictions() {
    let (_keep, root) = study(Options::default().seed);
    let published = Published::load().unwrap();
    let plate_quantity =
        |object: &str| if object.starts_with("circular") { Quantity::Diameter } else { Quantity::Width };
    let tables = [
        (&published.plates, None),
        (&published.bowl_heights, Some(Quantity::Height)),
        (&published.bowl_diameters, Some(Quantity::Diameter)),
    ];
    for (table, quantity) in tables {
        for row in &table.rows {
            let folder = root.join(format!("marks/bench/bench-{}cm-{}deg", row.height_cm, row.pitch_deg));
            let files = files_below(&folder);
            assert_eq!(files.len(), 8);
            let sizes: Vec<_> =
                files.iter().flat_map(|file| sizes_of(&folder.join(file), row.pitch_deg, row.range_mm)).collect();
            let quantity = quantity.unwrap_or_else(|| plate_quantity(&row.object));
            assert_size(&sizes, &row.object, quantity, row.predicted_cm);
        }
    }
}

#[test]
fn worn_marks_give_each_raters_values_within_the_target_window_only() {
    let (_keep, root) = study(Options::default().seed);
    let published = Published::load().unwrap();
    for session in all_sessions().iter().filter(|session| session.name.starts_with("worn")) {
        let heads: Vec<_> = session.motion.rests.iter().map(|(_, head)| *head).collect();
        let inside = heads.iter().filter(|head| (47.5..=62.5).contains(&head.pitch_deg)).count();
        assert_eq!((heads.len(), inside), (5, 3));
        let of_session = |row: &&RaterRow| session.name.ends_with(&row.object.replace(' ', "-"));
        for table in [&published.container_sizes, &published.container_heights] {
            let row = table.rows.iter().find(of_session).unwrap();
            for (rater, predicted_cm) in RATERS.into_iter().zip(row.predicted_cm()) {
                let folder = root.join(format!("marks/{rater}/{}", session.name));
                for (file, head) in files_below(&folder).iter().zip(&heads) {
                    let sizes = sizes_of(&folder.join(file), head.pitch_deg, head.range_mm);
                    let factor =
                        if (47.5..=62.5).contains(&head.pitch_deg) { 1.0 } else { worn::OUTSIDE_WINDOW_FACTOR };
                    assert_size(&sizes, &row.object, row.quantity, predicted_cm * factor);
                }
            }
        }
    }
}

#[test]
fn labelme_files_name_their_picture_and_its_size() {
    let (_keep, root) = study(Options::default().seed);
    let file = "marks/bench/bench-20cm-42deg/20210301T150010.250Z.json";
    let json: serde_json::Value = serde_json::from_slice(&fs::read(root.join(file)).unwrap()).unwrap();
    assert_eq!(json["imagePath"], "../../../cards/bench-20cm-42deg/IMAGES/20210301T150010.250Z.JPG");
    assert_eq!((json["imageWidth"].as_u64(), json["imageHeight"].as_u64()), (Some(2592), Some(1944)));
    assert!(json["imageData"].is_null());
    assert_eq!(json["shapes"][0]["label"], "circular plate (small)/diameter");
    assert_eq!(json["shapes"][0]["shape_type"], "line");
}
