//! Rims of rectangles as LabelMe 6 and X-AnyLabeling draw them, on marks of exact geometry.

use model::{Method, Quantity};
use nalgebra::Point3;
use report::Results;
use serde_json::json;

use super::methods::{shot, view};
use crate::support::{StudyFolder, assert_exit, label_me, outline, run, small_camera, stderr};

const OBJECTS: &str = "object,kind,shape,true_diameter_mm\ntray,plate,rectangle,\nplate,plate,circle,200\n";

/// The corners of a rectangle of 180 x 120 mm on the table, turned by 20 degrees, in order around it.
fn corners() -> [[f64; 2]; 4] {
    let (view, y_mm) = (view(55.0, 3.0, 560.0), 560.0 * 55_f64.to_radians().cos());
    let (sin, cos) = 20_f64.to_radians().sin_cos();
    [[-90.0, -60.0], [90.0, -60.0], [90.0, 60.0], [-90.0, 60.0]].map(|[x, y]: [f64; 2]| {
        let on_table = Point3::new(cos * x - sin * y, y_mm + sin * x + cos * y, 0.0);
        let pixel = view.pixel_of(on_table).unwrap();
        [pixel.x, pixel.y]
    })
}

/// The width and length of the tray, and what the program says, where a shape of this type is its rim; the run ends with `code`.
fn sizes(label: &str, shape_type: &str, order: [usize; 4], code: i32) -> (Vec<(Quantity, f64)>, String) {
    let study = StudyFolder::new("", OBJECTS, &small_camera());
    let mut rim = outline(label, &order.map(|number| corners()[number]));
    rim["shape_type"] = json!(shape_type);
    let mut shot = shot(55.0, 3.0, 560.0, 0.0, 1.0);
    shot.marks = Some(label_me(vec![rim]));
    study.session("S", &[shot]);
    let out = study.path().join("out/r.parquet");
    let output = run(["run", study.path().to_str().unwrap(), "--out", out.to_str().unwrap()]);
    assert_exit(&output, code);
    let rows = Results::read(&out).unwrap().rows.into_iter();
    let rows = rows.filter(|row| row.method == Method::Ray && row.image.is_some());
    (rows.filter_map(|row| Some((row.quantity, row.predicted_mm?))).collect(), stderr(&output))
}

#[test]
fn four_corners_give_the_sides_of_a_rectangle() {
    let in_turn = [0, 1, 2, 3];
    for (shape_type, order) in [
        ("oriented_rectangle", in_turn),
        ("rotation", in_turn),
        ("quadrilateral", [3, 2, 1, 0]),
        ("quadrilateral", [0, 2, 1, 3]),
        ("polygon", in_turn),
    ] {
        let (sizes, said) = sizes("tray/rim", shape_type, order, 0);
        let [(Quantity::Width, width_mm), (Quantity::Length, length_mm)] = sizes[..] else {
            panic!("{sizes:?} {said}")
        };
        assert!((width_mm - 120.0).abs() < 0.3 && (length_mm - 180.0).abs() < 0.3, "{shape_type} {order:?}: {sizes:?}");
    }
}

/// The diagonals of a bow tie are no sides.
#[test]
fn a_polygon_that_crosses_itself_gives_no_size() {
    let (sizes, said) = sizes("tray/rim", "polygon", [0, 2, 1, 3], 3);
    assert_eq!(sizes, []);
    assert!(said.contains("not in order around it"), "{said}");
}

/// A circle would go through them.
#[test]
fn four_corners_give_no_diameter() {
    let (sizes, said) = sizes("plate/rim", "oriented_rectangle", [0, 1, 2, 3], 3);
    assert_eq!(sizes, []);
    assert!(said.contains("'plate' is round: mark its rim by a polygon"), "{said}");
}
