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
    assert!(error(&file(r#"{"image_id": 3,,}"#)).contains("line 8 column"));
}

/// The ids of one image, category and annotation, as numbers, floats and texts: whichever, they are one id.
#[test]
fn an_id_is_the_same_as_number_float_and_text() {
    for image in ["7", "7.0", "\"7\"", "\"7.0\"", "70e-1"] {
        for other in ["7", "7.0", "\"7\"", "\" 7 \""] {
            let text = format!(
                r#"{{"images": [{{"id": {image}, "file_name": "a.jpg", "width": "64", "height": 48.0}}, {{"id": "x7"}}],
                    "categories": [{{"id": {other}, "name": "bowl/rim"}}],
                    "annotations": [{{"id": {other}, "image_id": {other}, "category_id": {image},
                                      "segmentation": [[1, 2, 3, 4, 5, 6]]}}]}}"#
            );
            let foreign = parse(&text, Path::new("c.json")).unwrap();
            let [image, _] = &foreign.images[..] else { panic!("{text}") };
            assert_eq!(
                (image.size_px, image.fault.as_ref(), foreign.refused.len()),
                (Some([64, 48]), None, 0),
                "{text}"
            );
            let [annotation] = &image.annotations[..] else { panic!("{text}: {:?}", foreign.refused) };
            assert_eq!((annotation.place.as_str(), annotation.label.as_str()), ("annotation id 7", "bowl/rim"));
            assert!(matches!(annotation.drawn, Drawn::Points { .. }), "{text}");
        }
    }
}

/// Ids beyond the whole numbers that floats hold exactly are compared digit by digit.
#[test]
fn long_ids_are_not_rounded_into_each_other() {
    let text = r#"{"images": [{"id": 20240101123456788, "file_name": "a"}, {"id": 20240101123456789, "file_name": "b"}],
                   "categories": [], "annotations": [{"id": 1, "image_id": "20240101123456789"}]}"#;
    let foreign = parse(text, Path::new("c.json")).unwrap();
    assert_eq!(foreign.images.iter().map(|image| image.annotations.len()).collect::<Vec<_>>(), [0, 1]);
}

/// One odd value of each kind beside a good annotation, which is kept.
#[test]
fn an_odd_value_spoils_its_annotation_and_not_the_file() {
    let good = r#"{"id": 1, "image_id": 3, "category_id": 1, "segmentation": [[1, 2, 3, 4, 5, 6]], "area": NaN}"#;
    for (odd, expected) in [
        (r#"{"id": 9, "image_id": NaN, "category_id": 1}"#, "image_id is missing"),
        (r#"{"id": 9, "image_id": {}, "category_id": 1}"#, "image_id: expected a number or a text"),
        (r#"{"id": 9, "image_id": true}"#, "image_id: expected a number or a text"),
        (r#"{"id": 9, "image_id": 3.5}"#, "image_id 3.5 is not among the images"),
        (r#"{"id": 9, "image_id": 3, "category_id": []}"#, "category_id: expected"),
        (r#"{"id": 9, "image_id": 3, "category_id": null}"#, "category_id is missing"),
        (r#"{"id": 9, "image_id": 3, "category_id": 2, "keypoints": [1e999]}"#, "out of range"),
        (r#"{"id": 9, "image_id": 3, "category_id": 1, "segmentation": [[1, 2, 3, 4, 5, NaN]]}"#, "expected polygons"),
        (r#"{"id": 9, "image_id": 3, "category_id": 1, "segmentation": [[1, 2, 3, 4, 5, 1e999]]}"#, "out of range"),
        (r#"{"id": 9, "image_id": 3, "category_id": 1, "iscrowd": "some"}"#, "iscrowd: expected 0 or 1"),
        (r#"{"id": [9], "image_id": 4, "category_id": 1}"#, "image_id 4 is not among the images"),
        (r#"{"id": 9, "id": 9}"#, "duplicate field"),
        ("null", "cannot be read"),
        ("17", "cannot be read"),
    ] {
        let foreign = parse(&file(&format!("{odd}, {good}")), Path::new("c.json")).unwrap();
        let annotations = &foreign.images[0].annotations;
        let kept = annotations.iter().filter(|annotation| matches!(annotation.drawn, Drawn::Points { .. }));
        assert_eq!(kept.count(), 1, "{odd}");
        let unusable = annotations.iter().filter_map(|annotation| match &annotation.drawn {
            Drawn::Unusable(fact) => Some(fact),
            _ => None,
        });
        let facts: Vec<&String> = foreign.refused.iter().map(|refused| &refused.fact).chain(unusable).collect();
        assert!(matches!(facts[..], [fact] if fact.contains(expected)), "{odd}: {facts:?}");
    }
}

/// The same for images and categories: what refers to them is told, and the rest is used.
#[test]
fn odd_images_and_categories_spoil_what_refers_to_them() {
    let text = r#"{"images": [{"id": 1, "file_name": "a", "width": "wide", "height": 48}, {"file_name": "b"}, null,
                              {"id": 2, "file_name": "c", "width": null}, {"id": 2, "file_name": "c"},
                              {"id": 5, "file_name": "e"}, {"id": "5", "file_name": "f"}, {"id": 5.0, "file_name": "g"}],
                   "categories": [{"id": 1, "name": "bowl/rim"}, {"id": 1.0, "name": "bowl/rim"}, {"id": 2},
                                  {"id": 3, "name": "bowl", "keypoints": [7]}],
                   "annotations": [{"id": 11, "image_id": 2, "category_id": 1, "segmentation": [[1, 2, 3, 4, 5, 6]]},
                                   {"id": 12, "image_id": 2, "category_id": 2, "segmentation": [[1, 2, 3, 4, 5, 6]]},
                                   {"id": 13, "image_id": 2, "category_id": 3, "keypoints": [1, 2, 2]},
                                   {"id": 14, "image_id": "5", "category_id": 1},
                                   {"id": 15, "image_id": "5.0", "category_id": 1}]}"#;
    let foreign = parse(text, Path::new("c.json")).unwrap();
    assert_eq!(foreign.images[0].fault.as_deref(), Some("width: expected a whole number of pixels, got 'wide'"));
    let image = |name: &str| foreign.images.iter().find(|image| image.name == name).unwrap();
    let drawn: Vec<&Drawn> = image("c").annotations.iter().map(|annotation| &annotation.drawn).collect();
    assert!(matches!(drawn[0], Drawn::Points { .. }), "an image and a category that stand there twice are one");
    assert!(matches!(drawn[1], Drawn::Unusable(fact) if fact.contains("category_id 2 is not among")));
    assert!(matches!(drawn[2], Drawn::Unusable(fact) if fact.contains("keypoints of category id 3")));
    assert_eq!(image("f").annotations.len(), 1, "of several, the one that is written in the same way");
    let facts: Vec<String> =
        foreign.refused.iter().map(|refused| format!("{}: {}", refused.place, refused.fact)).collect();
    for expected in [
        "image 2 of the file: it has no id",
        "image 3 of the file: cannot be read",
        "category 3 of the file: category id 2: it has no name",
        "annotation id 15: image_id 5 stands for 3 of the images",
    ] {
        assert!(facts.iter().any(|fact| fact.contains(expected)), "{expected}: {facts:?}");
    }
    assert_eq!(facts.len(), 4, "{facts:?}");
}

#[test]
fn annotations_of_no_image_are_told() {
    let text = file(r#"{"id": "x", "image_id": "y", "category_id": 1, "segmentation": [[1, 2, 3, 4, 5, 6]]}"#);
    let foreign = parse(&text, Path::new("c.json")).unwrap();
    assert_eq!((foreign.refused[0].place.as_str(), foreign.refused.len()), ("annotation id x", 1));
}
