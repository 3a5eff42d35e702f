#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
use super::*;

fn parse_shapes(shapes: &str) -> Result<Marks, MarksError> {
    let text = format!(r#"{{"version": "5.4.1", "shapes": [{shapes}], "imageWidth": 640, "imageHeight": 480}}"#);
    parse(text.as_bytes(), Path::new("m.json"), [640, 480])
}

#[test]
fn lines_and_outlines_are_read_by_object() {
    let marks = parse_shapes(
        r#"{"label": "red bowl/height", "points": [[1, 2], [3, 4]], "shape_type": "line"},
           {"label": "plate/rim", "points": [[1, 2], [3, 4], [5, 6.5]], "shape_type": "polygon", "flags": {}},
           {"label": "red bowl/diameter", "points": [[1, 2], [3, 4]], "shape_type": "line", "group_id": null}"#,
    )
    .unwrap();
    let names: Vec<_> = marks.objects.iter().map(|o| (o.object.as_str(), o.marks.len())).collect();
    assert_eq!(names, [("plate", 1), ("red bowl", 2)]);
    let Mark::Outline { feature: Feature::Rim, points_px } = &marks.objects[0].marks[0] else { panic!("a rim") };
    assert_eq!(points_px[2], Point2::new(5.0, 6.5));
}

#[test]
fn a_byte_order_mark_is_no_fault() {
    assert!(parse(b"\xef\xbb\xbf{\"shapes\": []}", Path::new("m.json"), [640, 480]).is_ok());
}

#[test]
fn the_label_is_cut_at_its_last_slash() {
    let marks = parse_shapes(r#"{"label": "a/b/width", "points": [[1, 2], [3, 4]], "shape_type": "line"}"#).unwrap();
    assert_eq!(marks.objects[0].object, "a/b");
}

#[test]
fn what_is_wrong_is_said() {
    for (shape, expected) in [
        (r#"{"label": "plate", "points": [], "shape_type": "line"}"#, "expected a label like OBJECT/diameter"),
        (r#"{"label": "plate/girth", "points": [], "shape_type": "line"}"#, "'girth' is nothing that can be marked"),
        (r#"{"label": "/width", "points": [], "shape_type": "line"}"#, "expected a label like"),
        (r#"{"label": "p/width", "points": [[1,2]], "shape_type": "line"}"#, "got a line with 1"),
        (r#"{"label": "p/width", "points": [[1,2],[3,4]], "shape_type": "rectangle"}"#, "got a rectangle with 2"),
        (
            r#"{"label": "p/base", "points": [[1,2],[3,4],[5,6],[7,8]], "shape_type": "rotation"}"#,
            "along the base, got a rotation",
        ),
        (r#"{"label": "p/rim", "points": [[1,2],[3,4]], "shape_type": "circle"}"#, "got a circle"),
    ] {
        let good = r#"{"label": "p/width", "points": [[1,2],[3,4]], "shape_type": "line"}"#;
        let marks = parse_shapes(&format!("{shape}, {good}")).unwrap();
        assert_eq!(marks.objects.len(), 1, "the other shape is kept");
        let error = marks.refused[0].to_string();
        assert!(error.contains(expected) && error.contains("shape 1") && error.contains("m.json"), "{error}");
    }
    assert!(parse_shapes(r#"{"label": "#).unwrap_err().to_string().contains("line 1 column"));
}

#[test]
fn marks_without_end_are_refused() {
    let line = r#"{"label": "p/width", "points": [[1,2],[3,4]], "shape_type": "line"}"#;
    let marks = parse_shapes(&vec![line; MOST_MARKS + 3].join(",")).unwrap();
    assert_eq!((marks.objects[0].marks.len(), marks.refused.len()), (MOST_MARKS, 3));
    assert!(marks.refused[0].to_string().contains("at most 100 marks"));
    let points = vec!["[1,2]"; MOST_POINTS + 1].join(",");
    let marks = parse_shapes(&format!(r#"{{"label": "p/rim", "points": [{points}]}}"#)).unwrap();
    assert_eq!((marks.objects.len(), marks.refused.len()), (0, 1));
}

#[test]
fn marks_of_another_picture_are_refused() {
    let text = br#"{"shapes": [], "imageWidth": 640, "imageHeight": 480}"#;
    let error = parse(text, Path::new("m.json"), [2592, 1944]).unwrap_err();
    assert_eq!(error.code().code(), "marks_of_other_picture");
    assert!(error.to_string().contains("640 x 480") && error.to_string().contains("2592 x 1944"));
    assert!(parse(br#"{"shapes": []}"#, Path::new("m.json"), [2592, 1944]).is_ok(), "the size may be left out");
}

/// One odd value of each kind spoils its shape, and not the file.
#[test]
fn an_odd_value_spoils_its_shape() {
    let good = r#"{"label": "p/width", "points": [[1,2],[3,4]], "shape_type": "line", "description": NaN}"#;
    for (odd, expected) in [
        (r#"{"label": 7, "points": [[1,2],[3,4]]}"#, "expected a string"),
        (r#"{"label": "p/rim", "points": [[1,2],[3,NaN],[5,6]]}"#, "invalid type: null"),
        (r#"{"label": "p/rim", "points": [[1,2],[3,1e999],[5,6]]}"#, "out of range"),
        (r#"{"label": "p/rim", "points": null}"#, "invalid type: null"),
        (r#"{"points": [[1,2]]}"#, "missing field"),
        ("null", "cannot be read"),
    ] {
        let marks = parse_shapes(&format!("{good}, {odd}, {good}")).unwrap();
        assert_eq!((marks.objects.len(), marks.objects[0].marks.len(), marks.refused.len()), (1, 2, 1), "{odd}");
        let error = marks.refused[0].to_string();
        assert!(error.starts_with("shape 2 ") && error.contains(expected), "{odd}: {error}");
    }
}

#[test]
fn the_size_may_be_a_float_or_a_text() {
    for (width, is_size) in
        [("640", true), ("640.0", true), ("\"640\"", true), ("null", true), ("\"wide\"", false), ("640.5", false)]
    {
        let text = format!(r#"{{"shapes": [], "imageWidth": {width}, "imageHeight": 480}}"#);
        assert_eq!(parse(text.as_bytes(), Path::new("m.json"), [640, 480]).is_ok(), is_size, "{width}");
    }
    let text = br#"{"shapes": [], "imageWidth": "641", "imageHeight": 480}"#;
    assert!(matches!(
        parse(text, Path::new("m.json"), [640, 480]),
        Err(MarksError::OtherPicture { got_width: 641, .. })
    ));
}

/// As LabelMe 6.3.1 writes it; its corners were drawn at 100, 100 and 300, 200.
const ORIENTED: &str = include_str!("oriented_rectangle.json");

fn rim_of(shape: &str) -> Result<Vec<[f64; 2]>, String> {
    let mut marks = parse_shapes(shape).unwrap();
    marks.refuse_four_corners(|_| false);
    if let Some(error) = marks.refused.first() {
        return Err(error.to_string());
    }
    Ok(marks.objects[0].marks[0].points_px().iter().map(|point| [point.x, point.y]).collect())
}

#[test]
fn an_oriented_rectangle_of_labelme_is_the_rim_of_a_rectangle() {
    let marks = parse(ORIENTED.as_bytes(), Path::new("m.json"), [640, 480]).unwrap();
    let [object] = &marks.objects[..] else { panic!("{:?}", marks.refused) };
    let [Mark::Outline { feature: Feature::Rim, points_px }] = &object.marks[..] else { panic!("a rim") };
    assert_eq!((points_px.len(), points_px[0]), (4, Point2::new(100.0, 100.0)));
    let side = |from: usize, to: usize| points_px[to] - points_px[from];
    assert!(side(0, 1).dot(&side(1, 2)).abs() < 1e-6, "its corners are in order, at right angles");
    assert!((side(0, 1) + side(2, 3)).norm() < 1e-6);
}

/// The corners of one quadrilateral, in each of the orders in which they can be drawn.
#[test]
fn four_corners_are_put_into_order() {
    let corners = [[10.0, 10.0], [50.0, 12.0], [48.0, 40.0], [12.0, 38.0]];
    for shape_type in ["rotation", "quadrilateral", "oriented_rectangle"] {
        for order in [[0, 1, 2, 3], [0, 2, 1, 3], [0, 1, 3, 2], [2, 0, 1, 3], [3, 2, 1, 0]] {
            let points = order.map(|number| corners[number]);
            let rim = rim_of(&format!(
                r#"{{"label": "box/rim", "points": {points:?}, "shape_type": "{shape_type}", "direction": 0.78}}"#
            ));
            let places = rim
                .unwrap()
                .iter()
                .map(|p| corners.iter().position(|c| (c[0] - p[0]).hypot(c[1] - p[1]) < 1e-9).unwrap())
                .collect::<Vec<_>>();
            let is_next = |a: usize, b: usize| (a + 1) % 4 == b || (b + 1) % 4 == a;
            assert!((0..4).all(|i| is_next(places[i], places[(i + 1) % 4])), "{shape_type} {order:?}: {places:?}");
        }
    }
}

#[test]
fn what_is_no_quadrilateral_is_refused() {
    for (points, expected) in [
        ("[[1,1],[9,1],[9,9]]", "expected 4 corners"),
        ("[[1,1],[9,1],[9,9],[1,9],[1,1]]", "expected 4 corners"),
        ("[[1,1],[9,1],[5,9],[5,4]]", "no quadrilateral"),
        ("[[1,1],[9,1],[9,9],[9,9]]", "no quadrilateral"),
        ("[[1,1],[5,1],[9,1],[1,9]]", "no quadrilateral"),
    ] {
        let fact = rim_of(&format!(r#"{{"label": "box/rim", "points": {points}, "shape_type": "quadrilateral"}}"#));
        assert!(fact.as_ref().is_err_and(|fact| fact.contains(expected)), "{points}: {fact:?}");
    }
}

#[test]
fn four_corners_are_no_round_rim() {
    let rotation = r#"{"label": "plate/rim", "points": [[1,1],[9,1],[9,9],[1,9]], "shape_type": "rotation"}"#;
    let line = r#"{"label": "plate/diameter", "points": [[1,2],[3,4]], "shape_type": "line"}"#;
    let square = rotation.replace("plate", "box");
    let mut marks = parse_shapes(&format!("{rotation}, {line}, {rotation}, {square}")).unwrap();
    marks.refuse_four_corners(|object| object == "plate");
    let kept: Vec<_> = marks.objects.iter().map(|of| (of.object.as_str(), of.marks.len())).collect();
    assert_eq!(kept, [("box", 1), ("plate", 1)]);
    assert!(matches!(marks.objects[1].marks[0], Mark::Line { .. }));
    let told: Vec<String> = marks.refused.iter().map(ToString::to_string).collect();
    assert!(matches!(&told[..], [one, two] if one.starts_with("shape 1 ") && two.starts_with("shape 3 ")), "{told:?}");
    assert!(told[0].contains("'plate' is round"));
}
