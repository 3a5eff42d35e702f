//! Many values over time: the smallest and the largest of neighbours, as lines.

use std::collections::BTreeMap;

use super::drawing::{Drawing, Paint, short};

/// An image at its place on the page.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sample {
    pub(super) x: f64,
    /// None without a value.
    pub(super) y: Option<f64>,
    pub(super) selected: bool,
}

/// Neighbours lie within so many units.
const STEP: f64 = 1.6;

/// Draws one upright line for the selected, and one for the other images of each step, from their least to their largest
/// value; a short one at `bottom` where some have none. `paints`: of selected, others, and those without a value.
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
        // A single value is seen as a dot.
        let [top, bottom] = if bottom - top < 1.2 { [top - 0.6, bottom + 0.6] } else { [*top, *bottom] };
        format!("M{},{}V{}", short((f64::from(*step) + 0.5) * STEP), short(top), short(bottom))
    };
    // Others first: the selected lie above them.
    for (index, class) in [(1, "extremes"), (0, "extremes selected"), (2, "without")] {
        let paint = Paint::line(paints[index].stroke, 1.4);
        // The selected stand out without colour, too.
        let paint = if index == 1 { paint.faint(0.4) } else { paint };
        drawing.path(class, paint, bins[index].iter().map(line).collect());
    }
}
