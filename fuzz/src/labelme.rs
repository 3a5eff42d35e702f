//! Marks made by people. Input: the JSON file.

use std::path::Path;

use pipeline::labelme::{MarksError, parse};

/// LabelMe: marks are bounded by the bytes, points are numbers, refusals are told in the order of the file.
pub fn labelme(input: &[u8]) -> usize {
    let marks = match parse(input, Path::new("m.json"), [640, 480]) {
        Ok(marks) => marks,
        Err(error) => {
            assert!(error.to_string().ends_with(": m.json"), "{error}");
            return 0;
        }
    };
    let names: Vec<&str> = marks.objects.iter().map(|object| object.object.as_str()).collect();
    assert!(names.is_sorted_by(|a, b| a < b) && names.iter().all(|name| !name.is_empty()), "{names:?}");
    let all = || marks.objects.iter().flat_map(|object| &object.marks);
    assert!(marks.objects.iter().all(|object| !object.marks.is_empty()));
    assert!(all().flat_map(|mark| mark.points_px()).flat_map(|point| point.iter()).all(|c| c.is_finite()));
    let points: usize = all().map(|mark| mark.points_px().len()).sum();
    let (kept, refused) = (all().count(), marks.refused.len());
    // A point takes 5 bytes, [0,0], and a shape 8: ["",[]] and a comma.
    assert!(5 * points + 8 * (kept + refused) <= input.len() + 1, "{points} points of {kept} marks, {refused} refused");
    let mut last = 0;
    for error in &marks.refused {
        let MarksError::Shape { number, fact, .. } = error else { panic!("a shape is refused, not {error}") };
        assert!(*number > last && *number <= kept + refused && !fact.is_empty(), "{error}");
        last = *number;
    }
    kept
}
