#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
use super::*;
use crate::exchange::foreign::{Annotation, Drawn, Ellipse, Form, NamedPoint, Sight};

/// As CVAT 2 writes it, all shapes of its dumper.
const FILE: &str = include_str!("sample.xml");

fn read(inner: &str) -> Result<Foreign, ExchangeError> {
    parse(&format!("<annotations><version>1.1</version>{inner}</annotations>"), Path::new("a.xml"))
}

fn drawn(shape: &str) -> Drawn {
    let foreign = read(&format!("<image id=\"0\" name=\"a.jpg\" width=\"64\" height=\"48\">{shape}</image>")).unwrap();
    foreign.images[0].annotations[0].drawn.clone()
}

#[test]
fn a_file_as_cvat_writes_it() {
    let foreign = parse(FILE, Path::new("annotations.xml")).unwrap();
    assert!(foreign.refused.is_empty());
    let [first, second] = foreign.images.as_slice() else { panic!("two images") };
    assert_eq!((first.name.as_str(), first.size_px), ("S1/images/20240101T000010.000Z.jpg", Some([64, 48])));
    assert!(second.annotations.is_empty());
    let labels: Vec<_> = first.annotations.iter().map(|a| (a.label.as_str(), a.place.as_str())).collect();
    assert_eq!(labels[0], ("bowl/rim", "line 43"));
    assert_eq!(labels.len(), 9);
    let Annotation { attributes, drawn, .. } = &first.annotations[1];
    assert_eq!(attributes["object"], "bowl & \"co\"");
    let points_px = vec![[10.25, 20.5], [30.0, 40.75]];
    assert_eq!(drawn, &Drawn::Points { form: Form::Polyline, points_px });
    let rotation_rad = 30_f64.to_radians();
    let ellipse = Ellipse { centre_px: [30.0, 20.0], half_axes_px: [10.0, 5.0], rotation_rad };
    assert_eq!(first.annotations[3].drawn, Drawn::Ellipse(ellipse));
    let Drawn::Named(points) = &first.annotations[4].drawn else { panic!("a skeleton") };
    let sights: Vec<_> = points.iter().map(|point| (point.name.as_str(), point.sight)).collect();
    let expected = [("height_foot", Sight::Seen), ("height_rim", Sight::Hidden), ("rim_1", Sight::Absent)];
    assert_eq!(sights, expected);
    for (at, expected) in [(5, "a box says nothing of a rim"), (6, "a mask"), (7, "a cuboid"), (8, "a tag")] {
        let Drawn::Unusable(fact) = &first.annotations[at].drawn else { panic!("unusable") };
        assert!(fact.contains(expected), "{fact}");
    }
}

#[test]
fn an_ellipse_turns_clockwise() {
    let half = drawn(r#"<ellipse label="p/rim" cx="30" cy="20" rx="10" ry="5" rotation="90.00"/>"#);
    let Drawn::Ellipse(ellipse) = half else { panic!("an ellipse") };
    let points = ellipse.points_px(4);
    // Pixels count downwards: what pointed right points down after a quarter turn clockwise.
    let expected = [[30.0, 30.0], [25.0, 20.0], [30.0, 10.0], [35.0, 20.0]];
    let far = |(a, b): (&[f64; 2], &[f64; 2])| (a[0] - b[0]).hypot(a[1] - b[1]) > 1e-9;
    assert!(!points.iter().zip(&expected).any(far), "{points:?}");
}

#[test]
fn what_is_wrong_with_a_shape_spoils_that_shape() {
    for (shape, expected) in [
        (r#"<polygon label="p/rim"/>"#, "expected points="),
        (r#"<polygon label="p/rim" outside="1" points="1,2;3,4;5,6"/>"#, "marked as outside"),
        (r#"<polygon label="p/rim" points="1,2;3"/>"#, "got '3'"),
        (r#"<polygon label="p/rim" points="1,2;nan,4"/>"#, "finite number, got 'nan'"),
        (r#"<polygon label="p/rim" points="1,2;1e999,4"/>"#, "finite number, got '1e999'"),
        (r#"<ellipse label="p/rim" cx="1" cy="1" rx="-1" ry="2"/>"#, "not both positive"),
        (r#"<ellipse label="p/rim" cx="1" cy="1" rx="1"/>"#, "without ry"),
        (
            r#"<skeleton label="p"><polygon label="rim_1" points="1,2;3,4"/></skeleton>"#,
            "expected 1 point, got a polygon with 2",
        ),
        (r#"<blob label="p/rim" points="1,2"/>"#, "<blob> is not known"),
    ] {
        let Drawn::Unusable(fact) = drawn(shape) else { panic!("{shape}") };
        assert!(fact.contains(expected), "{shape}: {fact}");
    }
}

#[test]
fn a_skeleton_in_order() {
    let skeleton = r#"<skeleton label="p/width"><points label="2" points="3,4" outside="0" occluded="0"/>
        <points label="1" points="1,2"></points><attribute name="n">x</attribute></skeleton>"#;
    let point = |name: &str, point_px| NamedPoint { name: name.to_owned(), point_px, sight: Sight::Seen };
    assert_eq!(drawn(skeleton), Drawn::Named(vec![point("2", [3.0, 4.0]), point("1", [1.0, 2.0])]));
}

#[test]
fn what_is_no_such_file_is_told_with_its_line() {
    let parse = |text: &str| parse(text, Path::new("a.xml")).unwrap_err().to_string();
    let many = "<!ENTITY a \"aaaaaaaaaa\">";
    for (text, expected) in [
        ("<html></html>", "line 1: expected CVAT's <annotations>"),
        ("", "expected CVAT's <annotations>"),
        ("<annotations>\n<image name=\"a\">\n", "line 3: not well-formed XML: the file ends within an element"),
        ("<annotations>\n</image></annotations>", "line 2: not well-formed XML"),
        ("<annotations/><annotations/>", "something follows"),
        ("<annotations>\n<image name=\"a\" name=\"b\"/></annotations>", "line 2: not well-formed XML"),
        ("<annotations><image name=\"&a;\"/></annotations>", "not well-formed XML"),
        (&format!("<!DOCTYPE x [{many}]><annotations>&a;</annotations>"), "a document type"),
    ] {
        let error = parse(text);
        assert!(error.contains(expected) && error.ends_with("a.xml"), "{text}: {error}");
    }
}

#[test]
fn tracks_are_refused_and_images_beside_them_are_read() {
    let track = r#"<track id="0" label="p/rim"><polygon frame="0" points="1,2;3,4" outside="0" keyframe="1"/></track>"#;
    let error = read(track).unwrap_err().to_string();
    assert!(error.contains("'CVAT for video'") && error.contains("export the task from CVAT as"), "{error}");
    let foreign = read(&format!("<image name=\"a.jpg\"/>\n{track}")).unwrap();
    assert_eq!((foreign.images.len(), foreign.refused[0].place.as_str()), (1, "line 2"));
    assert_eq!(foreign.images[0].size_px, None);
}

/// A size that cannot be read spoils its image, which would else be used without a look at its size; flags may be words.
#[test]
fn odd_sizes_and_flags_of_words() {
    let polyline = r#"<polyline label="bowl/diameter" points="1,2;3,4" outside="false"/>"#;
    for (width, size_px, fault) in
        [("64.0", Some([64, 48]), None), ("wide", None, Some("got 'wide'")), ("64.5", None, Some("got '64.5'"))]
    {
        let foreign =
            read(&format!("<image id=\"0\" name=\"a.jpg\" width=\"{width}\" height=\"48\">{polyline}</image>"))
                .unwrap();
        let image = &foreign.images[0];
        assert_eq!(image.size_px, size_px);
        assert_eq!(image.fault.is_some(), fault.is_some());
        assert!(image.fault.iter().all(|got| got.contains(fault.unwrap_or_default())), "{:?}", image.fault);
        assert!(matches!(image.annotations[0].drawn, Drawn::Points { .. }));
    }
}
