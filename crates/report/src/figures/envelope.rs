//! Many values over time, drawn as lines from the smallest to the largest value of neighbours.

use std::collections::BTreeMap;

use super::drawing::{Drawing, Paint, short};

/// An image at its place on the page, in units of the page.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sample {
    pub(super) x: f64,
    /// None where the image has no value.
    pub(super) y: Option<f64>,
    pub(super) selected: bool,
}

/// Width of a step, in units of the page. Images in the same step are neighbours.
const STEP: f64 = 1.6;

/// Draws, for each step, an upright line for the selected images and one for the others, from the least to the largest value,
/// and a short one at `bottom` where images have no value. `paints` are those of selected images, of others, and of images
/// without a value.
pub(super) fn draw(drawing: &mut Drawing, samples: &[Sample], paints: [Paint; 3], bottom: f64) {
    #[expect(clippy::cast_possible_truncation, reason = "places on a page")]
    let step = |sample: &Sample| (sample.x / STEP).floor() as i32;
    let mut bins: [BTreeMap<i32, [f64; 2]>; 3] = Default::default();
    for sample in samples {
        let (bin, ends) = match sample.y {
            Some(y) => (usize::from(!sample.selected), [y, y]),
            None => (2, [bottom - 6.0, bottom]),
        };
        let known = bins[bin].entry(step(sample)).or_insert(ends);
        *known = [known[0].min(ends[0]), known[1].max(ends[1])];
    }
    let line = |(step, [top, bottom]): (&i32, &[f64; 2])| {
        // A single value becomes a dot, so that it is seen.
        let [top, bottom] = if bottom - top < 1.2 { [top - 0.6, bottom + 0.6] } else { [*top, *bottom] };
        format!("M{},{}V{}", short((f64::from(*step) + 0.5) * STEP), short(top), short(bottom))
    };
    // The others come first, so that the selected images lie above them.
    for (index, class) in [(1, "extremes"), (0, "extremes selected"), (2, "without")] {
        let paint = Paint::line(paints[index].stroke, 1.4);
        // The selected images stand out even without colour.
        let paint = if index == 1 { paint.faint(0.4) } else { paint };
        drawing.path(class, paint, bins[index].iter().map(line).collect());
    }
}
