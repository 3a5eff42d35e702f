//! The figure of the flow of images for a terminal, with the same steps, words and shares.

use super::flow::{Step, lines, percent, steps};
use crate::parquet::Results;
use model::FlowStep;

/// Number of columns before the bars.
const HEADINGS: usize = 15;
/// Number of columns behind the bars.
const NUMBERS: usize = 18;
/// Width of the drawing in columns where that of the terminal is not known.
const WIDTH: usize = 80;
/// Greatest width of the drawing in columns.
const WIDEST: usize = 100;

/// The flow of images as bars of characters, as wide as the terminal (`width` in columns) unless that is very wide; none where
/// the ledger was not read ([`Results::read_flow`]) or has no image.
#[must_use]
pub fn flow_bars(results: &Results, width: Option<usize>) -> Option<String> {
    let flow = results.flow.as_ref()?.total();
    let found = flow.images_at(FlowStep::Found);
    if found == 0 {
        return None;
    }
    let width = width.unwrap_or(WIDTH).clamp(HEADINGS + NUMBERS + 10, WIDEST);
    let mut text = "Flow of images: reaching the step \u{2588}, left out by it \u{2591}\n".to_owned();
    for step in steps(&flow) {
        text.push_str(&bar(&step, found, width - HEADINGS - NUMBERS));
        for line in lines(&step, width - HEADINGS) {
            text.push_str(&format!("{:HEADINGS$} {line}\n", ""));
        }
    }
    Some(text)
}

fn bar(step: &Step, found: usize, width: usize) -> String {
    // A step with any image has a bar, however short.
    let cells = |images: usize| (images * width).div_ceil(found).min(width);
    let (kept, reached) = (cells(step.images), cells(step.before));
    let (kept, lost) = if step.images < step.before && kept == reached && kept > 1 {
        (kept - 1, 1)
    } else {
        (kept, reached.saturating_sub(kept))
    };
    format!(
        "{:>HEADINGS$} {}{} {} ({})\n",
        step.heading,
        "\u{2588}".repeat(kept),
        "\u{2591}".repeat(lost),
        step.images,
        percent(step.images, found)
    )
}
