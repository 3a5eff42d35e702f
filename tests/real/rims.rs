//! Bowls, mugs and cans on real tables, seen by depth cameras: rims marked, rim heights known.

use serde_json::Value;

use super::{Photo, camera_file, cases, number, point, summary};
use crate::support::{outline, real_data};

/// A photograph with one marked rim.
pub struct Labelled {
    pub photo: Photo,
    pub rim_px: Vec<[f64; 2]>,
    pub reference_mm: f64,
    /// Whether the reference is a ruler's.
    pub by_ruler: bool,
}

/// The marked rims of a set.
pub fn labelled(set: &str) -> Option<Vec<Labelled>> {
    let folder = real_data(set)?;
    let cases = cases(folder.join("cases.json"));
    let objects = cases["objects"].as_array().unwrap();
    let photo = |object: &Value| {
        let frame = cases["frames"].as_array().unwrap().iter().find(|frame| frame["name"] == object["frame"]).unwrap();
        let size = [0, 1].map(|i| frame["size"][i].as_u64().unwrap());
        let principal_px = [number(&frame["cx"]), number(&frame["cy"])];
        let rim: Vec<[f64; 2]> = object["fitted_rim_px"].as_array().unwrap().iter().map(point).collect();
        let photo = Photo {
            path: folder.join(frame["color"].as_str().unwrap()),
            camera: camera_file(size, [number(&frame["fx"]), number(&frame["fy"])], principal_px, "model = \"none\""),
            pitch_deg: number(&frame["pitch_deg"]),
            roll_deg: -number(&frame["roll_deg"]), // these files count roll the other way round
            range_mm: 1000.0 * number(&frame["distance_along_axis_m"]),
            kind: "bowl",
            shape: "circle",
            rim_height_mm: Some(number(&object["rim_height_mm"])),
            shapes: vec![outline("rim/rim", &rim)],
        };
        let by_ruler = object["true_diameter_mm"].as_f64();
        let reference = by_ruler.or_else(|| object["reference_diameter_mm_NOT_INDEPENDENT"].as_f64());
        let reference_mm = reference.or_else(|| object["measured_mm"].as_f64()).unwrap();
        Labelled { photo, rim_px: rim, reference_mm, by_ruler: by_ruler.is_some() }
    };
    Some(objects.iter().map(photo).collect())
}

#[test]
fn rims_in_real_scenes_agree_within_1_pct() {
    let (Some(one), Some(other)) = (labelled("graspnet6dof_realsense"), labelled("uois_realsense")) else { return };
    let errors: Vec<(f64, bool)> = one
        .iter()
        .chain(&other)
        .map(|one| (100.0 * (one.photo.measure()[0].2 / one.reference_mm - 1.0), one.by_ruler))
        .collect();
    let all: Vec<f64> = errors.iter().map(|(error, _)| *error).collect();
    let by_ruler: Vec<f64> = errors.iter().filter(|(_, by_ruler)| *by_ruler).map(|(error, _)| *error).collect();
    let ruler = summary("rims against a ruler's truth", &by_ruler);
    assert!(ruler.n == 2 && ruler.worst.abs() < 1.5);
    // The other references are other programs' values for the same rims: agreement, not accuracy.
    let stats = summary("rims against all references", &all);
    assert!(stats.n == 14 && stats.median_absolute < 1.0);
}
