//! The legend of a figure: the meaning of its shapes in words.

use super::drawing::{Anchor, Drawing, Paint, Text, short};
use super::marks::Look;
use super::words::estimated_width;

/// A sample of the shapes that an entry explains.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Sample {
    Mark(Look),
    Line(Paint),
    Area(Paint),
}

/// An entry of a legend: a sample and its words.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Entry {
    pub(super) sample: Sample,
    pub(super) text: String,
}

impl Entry {
    pub(super) fn new(sample: Sample, text: impl Into<String>) -> Self {
        Self { sample, text: text.into() }
    }

    fn width(&self) -> f64 {
        SAMPLE + estimated_width(&self.text, 10.5) + 14.0
    }
}

/// Width of a sample and the space behind it.
const SAMPLE: f64 = 26.0;
/// Height of a line of the legend.
const LINE: f64 = 17.0;

/// Height of a legend of this width, in units of the page.
#[expect(clippy::cast_precision_loss, reason = "a handful of lines")]
pub(super) fn height(entries: &[Entry], width: f64) -> f64 {
    LINE * lines(entries, width).len() as f64
}

/// Draws the legend with its upper left corner at this place.
#[expect(clippy::cast_precision_loss, reason = "a handful of lines")]
pub(super) fn draw(drawing: &mut Drawing, entries: &[Entry], [left, top]: [f64; 2], width: f64) {
    for (index, line) in lines(entries, width).into_iter().enumerate() {
        let y = top + LINE * (index as f64 + 0.5);
        let mut x = left;
        for entry in line {
            draw_sample(drawing, entry.sample, x, y);
            drawing.text(Text::new(x + SAMPLE, y + 3.8, Anchor::Start, &entry.text).small());
            x += entry.width();
        }
    }
}

fn draw_sample(drawing: &mut Drawing, sample: Sample, x: f64, y: f64) {
    match sample {
        Sample::Mark(look) => drawing.path("sample", look.paint, look.symbol.path(x + 10.0, y)),
        Sample::Line(paint) => drawing.path("sample", paint, format!("M{},{}h20", short(x), short(y))),
        Sample::Area(paint) => {
            drawing.path("sample", paint, format!("M{},{}h20v10h-20z", short(x), short(y - 5.0)));
        }
    }
}

fn lines(entries: &[Entry], width: f64) -> Vec<Vec<&Entry>> {
    let mut lines: Vec<Vec<&Entry>> = Vec::new();
    let mut used = f64::INFINITY;
    for entry in entries {
        if used + entry.width() > width {
            lines.push(Vec::new());
            used = 0.0;
        }
        used += entry.width();
        if let Some(line) = lines.last_mut() {
            line.push(entry);
        }
    }
    lines
}
