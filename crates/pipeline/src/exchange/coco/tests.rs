#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
use super::*;

/// Instances and keypoints, each with the fields of the format's description.
fn file(annotations: &str) -> String {
    format!(
        r#"{{"info": {{"year": 2026, "version": "1", "description": "", "contributor": "", "url": "", "date_created": ""}},
            "licenses": [{{"name": "", "id": 0, "url": ""}}],
            "images": [{{"id": 3, "width": 64, "height": 48, "file_name": "S1/a.jpg", "license": 0, "flickr_url": "",
                         "coco_url": "", "date_captured": 0}}],
            "categories": [{{"id": 1, "name": "bowl/rim", "supercategory": ""}},
                           {{"id": 2, "name": "bowl", "supercategory": "", "keypoints": ["height_foot", "height_rim"],
                             "skeleton": [[1, 2]]}}],
            "annotations": [{annotations}]}}"#
    )
}

fn one(annotation: &str) -> Annotation {
    let rest = r#""image_id": 3, "area": 1.0, "bbox": [1.0, 2.0, 3.0, 4.0]"#;
    let foreign = parse(&file(&format!("{{\"id\": 7, {rest}, {annotation}}}")), Path::new("c.json")).unwrap();
    assert_eq!((foreign.images[0].name.as_str(), foreign.images[0].size_px), ("S1/a.jpg", Some([64, 48])));
    foreign.images[0].annotations[0].clone()
}

#[test]
fn polygons_in_one_part_and_in_several() {
    let whole = one(r#""category_id": 1, "segmentation": [[1, 2, 3, 4, 5, 6.5]], "iscrowd": 0"#);
    assert_eq!((whole.label.as_str(), whole.place.as_str()), ("bowl/rim", "annotation id 7"));
    let points_px = vec![[1.0, 2.0], [3.0, 4.0], [5.0, 6.5]];
    assert_eq!(whole.drawn, Drawn::Points { form: Form::Polygon, points_px });
    let parts = one(r#""category_id": 1, "segmentation": [[1,2,3,4,5,6],[7,8,9,10,11,12]]"#).drawn;
    assert!(matches!(parts, Drawn::Points { form: Form::Loose, points_px } if points_px.len() == 6));
}

#[test]
fn keypoints_with_their_visibility() {
    let both = one(r#""category_id": 2, "keypoints": [1, 2, 2, 3, 4, 1], "num_keypoints": 2, "iscrowd": 0,
           "segmentation": [[1, 2, 3, 4, 5, 6]], "attributes": {"object": "x", "occluded": false}"#);
    assert_eq!(both.attributes.into_iter().collect::<Vec<_>>(), [("object".to_owned(), "x".to_owned())]);
    let Drawn::Named(points) = both.drawn else { panic!("keypoints") };
    assert_eq!(points.iter().map(|point| point.sight).collect::<Vec<_>>(), [Sight::Seen, Sight::Hidden]);
    assert_eq!(points[1].name, "height_rim");
    let none = one(r#""category_id": 2, "keypoints": [0,0,0,0,0,0], "segmentation": [[1,2,3,4,5,6]]"#).drawn;
    assert!(matches!(none, Drawn::Points { .. }), "the outline, where no keypoint is labelled");
}

#[test]
fn what_is_no_mark_is_told_why() {
    for (annotation, expected) in [
        (r#""category_id": 1, "segmentation": []"#, "a box says nothing of a rim"),
        (r#""category_id": 1"#, "a box says nothing of a rim"),
        (r#""category_id": 1, "segmentation": {"counts": [1, 2], "size": [48, 64]}"#, "a mask (RLE)"),
        (r#""category_id": 1, "segmentation": {"counts": "abc", "size": [48, 64]}, "iscrowd": 1"#, "iscrowd"),
        (r#""category_id": 1, "segmentation": [[1, 2, 3, 4]]"#, "got a part with 4 numbers"),
        (r#""category_id": 1, "segmentation": [[1, 2, 3, 4, 5, 6, 7]]"#, "got a part with 7 numbers"),
        (r#""category_id": 1, "segmentation": [["a"]]"#, "expected polygons"),
        (r#""category_id": 2, "keypoints": [1, 2, 2]"#, "expected 6 numbers"),
        (r#""category_id": 2, "keypoints": [1, 2, 2, 1, 2, 3]"#, "visibility of 0, 1 or 2, got 3"),
        (r#""category_id": 2, "keypoints": "no""#, "expected numbers"),
        (r#""category_id": 9, "segmentation": [[1, 2, 3, 4, 5, 6]]"#, "category_id 9 is not among"),
    ] {
        let Drawn::Unusable(fact) = one(annotation).drawn else { panic!("{annotation}") };
        assert!(fact.contains(expected), "{annotation}: {fact}");
    }
}

#[test]
fn what_is_no_coco_file_is_told() {
    let error = |text: &str| parse(text, Path::new("c.json")).unwrap_err().to_string();
    assert!(error(r#"{"shapes": [], "imagePath": "a.jpg"}"#).contains("a LabelMe file, which needs no import"));
    assert!(error(r#"{"images": []}"#).contains("annotations or categories are missing"));
    assert!(error(&file(r#"{"image_id": NaN}"#)).contains("line 8 column"));
    assert!(error(&file(r#"{"image_id": 3, "keypoints": [1e999]}"#)).contains("out of range"));
    let twice = r#"{"images": [{"id": 1}, {"id": 1}], "annotations": [], "categories": []}"#;
    assert!(error(twice).contains("image id 1 stands there twice"));
}

#[test]
fn annotations_of_no_image_are_told() {
    let text = file(r#"{"id": "x", "image_id": "y", "category_id": 1, "segmentation": [[1, 2, 3, 4, 5, 6]]}"#);
    let foreign = parse(&text, Path::new("c.json")).unwrap();
    assert_eq!((foreign.refused[0].place.as_str(), foreign.refused.len()), ("annotation id x", 1));
}
