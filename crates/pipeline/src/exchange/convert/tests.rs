#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
use std::collections::BTreeMap;

use super::*;
use crate::exchange::foreign::Sight;

fn convert(label: &str, drawn: Drawn, with_hidden: bool) -> Result<Converted, String> {
    let names = Names::new(&["bowl".to_owned()], BTreeMap::new());
    let annotation = Annotation { place: String::new(), label: label.to_owned(), attributes: BTreeMap::new(), drawn };
    marks_of(&annotation, &names, [64, 48], with_hidden)
}

fn drawn(form: Form, points_px: &[[f64; 2]]) -> Drawn {
    Drawn::Points { form, points_px: points_px.to_vec() }
}

fn skeleton(points: &[(&str, f64, Sight)]) -> Drawn {
    let point = |(name, x, sight): &(&str, f64, Sight)| NamedPoint {
        name: (*name).to_owned(),
        point_px: [*x, 1.0],
        sight: *sight,
    };
    Drawn::Named(points.iter().map(point).collect())
}

/// Label, LabelMe's word and the x of the points of every mark.
fn marks(converted: &Converted) -> Vec<(&str, &str, Vec<f64>)> {
    let x = |made: &ConvertedMark| made.points_px.iter().map(|point| point[0]).collect();
    converted.marks.iter().map(|made| (made.label.as_str(), made.shape_type, x(made))).collect()
}

use Sight::{Absent, Hidden, Seen};

#[test]
fn forms_keep_their_points() {
    let points = [[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]];
    for (label, form, count, expected) in [
        ("bowl/rim", Form::Polygon, 3, "polygon"),
        ("bowl/base", Form::Polyline, 3, "linestrip"),
        ("bowl/rim", Form::Loose, 1, "points"),
        ("bowl/height", Form::Polyline, 2, "line"),
        ("bowl/diameter", Form::Loose, 2, "line"),
    ] {
        let converted = convert(label, drawn(form, &points[..count]), false).unwrap();
        let mark = ConvertedMark { label: label.to_owned(), shape_type: expected, points_px: points[..count].to_vec() };
        assert_eq!(converted, Converted { marks: vec![mark], notes: Vec::new() });
    }
}

#[test]
fn names_of_points_say_what_they_mark() {
    let points = [
        ("rim_10", 10.0, Seen),
        ("height_rim", 2.0, Seen),
        ("rim_2", 9.0, Seen),
        ("height-foot", 1.0, Seen),
        ("rim_1", 8.0, Seen),
        ("base_1", 7.0, Absent),
    ];
    let converted = convert("bowl", skeleton(&points), false).unwrap();
    let expected = [("bowl/height", "line", vec![1.0, 2.0]), ("bowl/rim", "points", vec![8.0, 9.0, 10.0])];
    assert_eq!(marks(&converted), expected);
    for names in [["1", "2"], ["foot", "rim"], ["height_foot", "height_rim"]] {
        let turned = skeleton(&[(names[1], 2.0, Seen), (names[0], 1.0, Seen)]);
        assert_eq!(marks(&convert("bowl/height", turned, false).unwrap()), expected[..1], "{names:?}");
    }
}

#[test]
fn hidden_points_are_left_out_unless_asked_for() {
    let rim = skeleton(&[("1", 1.0, Seen), ("2", 2.0, Hidden), ("3", 3.0, Seen)]);
    let converted = convert("bowl/rim", rim.clone(), false).unwrap();
    assert_eq!(marks(&converted), [("bowl/rim", "points", vec![1.0, 3.0])]);
    assert!(converted.notes[0].contains("1 hidden points of rim left out"));
    assert_eq!(marks(&convert("bowl/rim", rim, true).unwrap())[0].2.len(), 3);
    let line = skeleton(&[("1", 1.0, Seen), ("2", 2.0, Hidden)]);
    assert!(convert("bowl/width", line.clone(), false).unwrap_err().contains("an end of width is marked as hidden"));
    assert_eq!(marks(&convert("bowl/width", line, true).unwrap()), [("bowl/width", "line", vec![1.0, 2.0])]);
}

#[test]
fn an_ellipse_gives_no_more_points_than_it_holds() {
    let ellipse =
        |x: f64| Drawn::Ellipse(Ellipse { centre_px: [x, 20.0], half_axes_px: [12.0, 6.0], rotation_rad: 0.3 });
    let converted = convert("bowl/rim", ellipse(30.0), false).unwrap();
    assert_eq!((converted.marks[0].shape_type, converted.marks[0].points_px.len()), ("points", 8));
    let over_the_border = convert("bowl/rim", ellipse(4.0), false).unwrap();
    assert_eq!(over_the_border.marks[0].points_px.len(), 5);
    assert!(convert("bowl/rim", ellipse(-5.0), false).unwrap_err().contains("mark what is seen of it"));
    assert!(convert("bowl/diameter", ellipse(30.0), false).unwrap_err().contains("got an ellipse"));
}

#[test]
fn what_is_unclear_is_refused() {
    let nothing = || skeleton(&[("1", 1.0, Absent)]);
    for (label, drawn, expected) in [
        ("bowl", drawn(Form::Polygon, &[[1.0, 1.0]; 3]), "names 'bowl', but not what of it is marked"),
        ("bowl/width", drawn(Form::Polygon, &[[1.0, 1.0]; 4]), "got a polygon with 4"),
        ("bowl/width", drawn(Form::Polyline, &[[1.0, 1.0]; 3]), "got a polyline with 3"),
        (
            "bowl/rim",
            drawn(Form::Polygon, &[[1.0, 1.0], [66.0, 1.0]]),
            "a point at 66, 1: expected points in the picture",
        ),
        ("bowl/rim", drawn(Form::Polygon, &[[f64::NAN, 1.0]]), "a point at NaN"),
        ("bowl/rim", drawn(Form::Polygon, &[[1.0, -1e300]]), "expected points in the picture, of 64 x 48 px"),
        ("bowl", skeleton(&[("left", 1.0, Seen)]), "'left' of the skeleton is unclear; expected WHAT_1"),
        ("bowl", skeleton(&[("width_1", 1.0, Seen)]), "expected 2 points for width, got 1"),
        ("bowl", skeleton(&[("rim_1", 1.0, Seen), ("rim_1", 2.0, Seen)]), "the same number"),
        ("bowl", skeleton(&[("height_a", 1.0, Seen), ("height_b", 1.0, Seen)]), "which end is the foot?"),
        ("bowl/rim", skeleton(&[("base_1", 1.0, Seen)]), "'base_1' in a skeleton of rim"),
        ("bowl/rim", nothing(), "none of its points"),
        ("cup/rim", nothing(), "object 'cup' is not in objects.csv"),
    ] {
        let fact = convert(label, drawn, false).unwrap_err();
        assert!(fact.contains(expected), "{label}: {fact}");
    }
}
