//! Files as CVAT 2 and the tools around COCO write them, made from LabelMe files by code that shares nothing with the program.

use std::fmt::Write as _;

use serde_json::{Value, json};

/// One picture with its LabelMe file.
pub struct Picture {
    pub name: String,
    pub marks: Value,
}

fn shapes(picture: &Picture) -> impl Iterator<Item = (&str, &str, Vec<[f64; 2]>)> {
    picture.marks["shapes"].as_array().unwrap().iter().map(|shape| {
        let points = serde_json::from_value(shape["points"].clone()).unwrap();
        let (object, what) = shape["label"].as_str().unwrap().split_once('/').unwrap();
        (object, what, points)
    })
}

/// CVAT rounds to hundredths of a pixel; so must LabelMe's points be that sizes are compared of.
pub fn rounded(mut marks: Value) -> Value {
    for shape in marks["shapes"].as_array_mut().unwrap() {
        for coordinate in shape["points"].as_array_mut().unwrap().iter_mut().flat_map(|p| p.as_array_mut().unwrap()) {
            *coordinate = json!(format!("{:.2}", coordinate.as_f64().unwrap()).parse::<f64>().unwrap());
        }
    }
    marks
}

/// 'CVAT for images 1.1': outlines by labels `OBJECT/WHAT`, diameters by a label `WHAT` with the attribute `object`, heights as
/// skeletons.
pub fn cvat(pictures: &[Picture], size_px: [u32; 2]) -> String {
    let mut text = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<annotations>\n  <version>1.1</version>\n  <meta>\n    <job>\n      \
                    <id>3</id>\n      <mode>annotation</mode>\n    </job>\n    <dumped>2026-03-02 10:41:22+00:00</dumped>\n  \
                    </meta>\n"
        .to_owned();
    for (id, picture) in pictures.iter().enumerate() {
        let ([width, height], name) = (size_px, &picture.name);
        writeln!(text, "  <image id=\"{id}\" name=\"{name}\" width=\"{width}\" height=\"{height}\">").unwrap();
        for (object, what, points) in shapes(picture) {
            let list: Vec<_> = points.iter().map(|[x, y]| format!("{x:.2},{y:.2}")).collect();
            let shape = match what {
                "rim" | "base" => format!(
                    "    <polygon label=\"{object}/{what}\" source=\"manual\" occluded=\"0\" points=\"{}\" z_order=\"0\">\n    </polygon>",
                    list.join(";")
                ),
                "height" => format!(
                    "    <skeleton label=\"{object}\" source=\"manual\" z_order=\"0\">\n      \
                     <points label=\"height_rim\" source=\"manual\" outside=\"0\" occluded=\"0\" points=\"{}\">\n      </points>\n      \
                     <points label=\"height_foot\" source=\"manual\" outside=\"0\" occluded=\"0\" points=\"{}\">\n      </points>\n    \
                     </skeleton>",
                    list[1], list[0]
                ),
                _ => format!(
                    "    <polyline label=\"{what}\" source=\"manual\" occluded=\"0\" points=\"{}\" z_order=\"0\">\n      \
                     <attribute name=\"object\">{object}</attribute>\n    </polyline>",
                    list.join(";")
                ),
            };
            writeln!(text, "{shape}").unwrap();
        }
        text.push_str("  </image>\n");
    }
    text + "</annotations>\n"
}

/// One category per object with keypoints for its lines, and one per outline.
pub fn coco(pictures: &[Picture], size_px: [u32; 2]) -> Value {
    let [width, height] = size_px;
    let (mut images, mut annotations) = (Vec::new(), Vec::new());
    let mut categories: Vec<Value> = Vec::new();
    let mut category = |name: String, keypoints: Option<[String; 2]>| {
        if let Some(at) = categories.iter().position(|category| category["name"] == json!(name)) {
            return at + 1;
        }
        let mut new = json!({"id": categories.len() + 1, "name": name, "supercategory": "tableware"});
        if let Some(keypoints) = keypoints {
            new["keypoints"] = json!(keypoints);
            new["skeleton"] = json!([[1, 2]]);
        }
        categories.push(new);
        categories.len()
    };
    for (image_id, picture) in (1..).zip(pictures) {
        images.push(json!({"id": image_id, "width": width, "height": height, "file_name": picture.name,
                           "license": 0, "flickr_url": "", "coco_url": "", "date_captured": 0}));
        for (object, what, points) in shapes(picture) {
            let flat: Vec<f64> = points.iter().flatten().copied().collect();
            let mut annotation = json!({"id": annotations.len() + 1, "image_id": image_id, "area": 0.0, "iscrowd": 0,
                                        "bbox": [0.0, 0.0, 1.0, 1.0]});
            if matches!(what, "rim" | "base") {
                annotation["category_id"] = json!(category(format!("{object}/{what}"), None));
                annotation["segmentation"] = json!([flat]);
            } else {
                let names = if what == "height" { ["foot", "rim"] } else { ["1", "2"] };
                let keypoints: Vec<f64> = points.iter().flat_map(|[x, y]| [*x, *y, 2.0]).collect();
                annotation["category_id"] = json!(category(format!("{object}/{what}"), Some(names.map(str::to_owned))));
                annotation["segmentation"] = json!([]);
                annotation["keypoints"] = json!(keypoints);
                annotation["num_keypoints"] = json!(2);
            }
            annotations.push(annotation);
        }
    }
    json!({"info": {"description": "", "url": "", "version": "", "year": 2026, "contributor": "", "date_created": ""},
           "licenses": [{"name": "", "id": 0, "url": ""}], "images": images, "annotations": annotations,
           "categories": categories})
}
