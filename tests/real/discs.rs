//! Printed discs of 15 mm under perspective, with roll up to 60 degrees.

use serde_json::Value;

use super::{Photo, camera_file, cases, number, summary};
use crate::support::{outline, real_data};

pub const DISC_MM: f64 = 15.0;

/// Points of an ellipse as OpenCV's `fitEllipse` gives it: centre, two full axes, angle of the first in degrees.
fn ellipse_points(ellipse: &Value) -> Vec<[f64; 2]> {
    let [x, y, first, second, angle_deg] = [0, 1, 2, 3, 4].map(|i| number(&ellipse[i]));
    let (sin, cos) = angle_deg.to_radians().sin_cos();
    let turn = std::f64::consts::TAU / 24.0;
    (0..24)
        .map(|i| (f64::from(i) * turn).sin_cos())
        .map(|(s, c)| (0.5 * first * c, 0.5 * second * s))
        .map(|(u, v)| [x + u * cos - v * sin, y + u * sin + v * cos])
        .collect()
}

/// One photograph per entry; `disc_name` names each disc.
pub fn photos(disc_name: impl Fn(usize) -> String) -> Option<Vec<Photo>> {
    let folder = real_data("boofcv_circles_15mm")?;
    let cases = cases(folder.join("cases.json"));
    let focal_px = [number(&cases["K"][0][0]), number(&cases["K"][1][1])];
    let principal_px = [number(&cases["K"][0][2]), number(&cases["K"][1][2])];
    let lens = format!("model = \"radial\"\nk1 = {}", number(&cases["k1"]));
    let photo = |image: &Value| {
        let ellipses = image["ellipses"].as_array().unwrap().iter().enumerate();
        Photo {
            path: folder.join(image["file"].as_str().unwrap()),
            camera: camera_file([640, 480], focal_px, principal_px, &lens),
            pitch_deg: number(&image["pitch"]),
            roll_deg: -number(&image["roll"]), // these files count roll the other way round
            range_mm: number(&image["d"]),
            kind: "plate",
            shape: "circle",
            rim_height_mm: None,
            shapes: ellipses.map(|(i, e)| outline(&format!("{}/rim", disc_name(i)), &ellipse_points(e))).collect(),
        }
    };
    Some(cases["images"].as_array().unwrap().iter().map(photo).collect())
}

#[test]
fn discs_of_15_mm_within_1_6_pct() {
    let Some(photos) = photos(|i| format!("disc-{i}")) else { return };
    let mut all = Vec::new();
    for photo in &photos {
        let errors: Vec<f64> = photo.measure().iter().map(|(_, _, mm)| 100.0 * (mm / DISC_MM - 1.0)).collect();
        let name = photo.path.file_name().unwrap().to_string_lossy();
        let stats = summary(&format!("BoofCV discs, {name}, roll {:+.0} degrees", photo.roll_deg), &errors);
        assert!(stats.mean.abs() < 1.6, "{name}");
        all.extend(errors);
    }
    let stats = summary("BoofCV discs, all", &all);
    assert!(stats.n > 400 && stats.mean_absolute < 1.6);
}
