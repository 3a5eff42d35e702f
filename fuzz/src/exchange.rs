//! Marks from other annotation tools. Input: the XML or JSON file.

use std::collections::BTreeMap;
use std::path::Path;

use pipeline::exchange::{Names, Refused, marks_of, read};

/// CVAT and COCO, told apart by their first byte: what is drawn becomes marks in the picture or is told, and is bounded by the
/// bytes; errors name the file.
pub fn exchange(input: &[u8]) -> usize {
    let foreign = match read(input, Path::new("m.any")) {
        Ok(foreign) => foreign,
        Err(error) => {
            assert!(error.to_string().ends_with(": m.any"), "{error}");
            return 0;
        }
    };
    let is_told = |Refused { place, fact }: &Refused| !place.is_empty() && !fact.is_empty();
    assert!(foreign.refused.iter().all(is_told));
    let objects = ["red bowl".to_owned(), "plate".to_owned()];
    let names = Names::new(&objects, BTreeMap::new());
    let picture_px = [64, 48];
    let (mut read, mut points) = (foreign.images.len(), 0);
    for annotation in foreign.images.iter().flat_map(|image| &image.annotations) {
        assert!(!annotation.place.is_empty());
        match marks_of(annotation, &names, picture_px, true) {
            Ok(converted) => {
                assert!(!converted.marks.is_empty() || !converted.notes.is_empty());
                for made in &converted.marks {
                    let (object, what) = made.label.rsplit_once('/').expect("OBJECT/WHAT");
                    assert!(objects.iter().any(|known| known == object) && !what.is_empty(), "{}", made.label);
                    let within = |[x, y]: &[f64; 2]| (-1.0..=65.0).contains(x) && (-1.0..=49.0).contains(y);
                    assert!(made.points_px.iter().all(within) && !made.points_px.is_empty());
                    points += made.points_px.len();
                }
                read += 1;
            }
            Err(fact) => assert!(!fact.is_empty() && fact.len() < 2000, "{fact}"),
        }
    }
    // A point takes 4 bytes, "x,y;", unless an ellipse of at least 40 gives 8.
    assert!(2 * points <= input.len() + 1, "{points} points of {} bytes", input.len());
    read
}
