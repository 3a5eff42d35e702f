//! The figure `sizes`: fused sizes with their intervals, object by object.

use std::collections::BTreeMap;

use model::{Level, Method, Quantity, ResultRow};

use super::Attempt;
use super::coverage::K_95;
use super::drawing::{Anchor, Colour, Drawing, Paint, Text, short};
use super::grid::PAGE;
use super::legend::{self, Entry, Sample};
use super::marks::Look;
use super::panel::Panel;
use super::sample;
use super::scale::{Scale, extremes, is_drawable, padded};
use super::words::{counted, estimated_width, fitted, listed, named, number};
use crate::parquet::Results;

const NAME: &str = "sizes";
const TITLE: &str = "Sizes with their uncertainties";

/// Greatest number of panels.
const MOST_PANELS: usize = 24;
/// Greatest number of sizes in a panel.
const MOST_ROWS: usize = 16;

/// Greatest width of names, in units of the page.
const NAMES: f64 = 146.0;
const GAP: f64 = 16.0;
const COLUMN: f64 = 0.5 * (PAGE - GAP);
const LINE: f64 = 15.0;
const HEADING: f64 = 24.0;
const BELOW: f64 = 28.0;

const TRUTH: Paint = Paint::line(Colour::Ink, 1.2).dashed("6 3");

/// A fused size that can be drawn.
struct Size<'a> {
    row: &'a ResultRow,
    predicted_mm: f64,
    /// Half of the width of the 95 % interval; none without an uncertainty.
    half_mm: Option<f64>,
}

/// The sizes of one quantity of one object.
struct Block<'a> {
    object: &'a str,
    quantity: Quantity,
    sizes: Vec<Size<'a>>,
}

/// Draws the fused sizes of every object and quantity by one method, with 95 % intervals.
pub(super) fn draw(results: &Results) -> Attempt {
    let fused = || results.rows.iter().filter(|row| row.level == Level::Fused && row.predicted_mm.is_some());
    // The method is the program's own choice (best), or else the first that there is.
    let method =
        fused().map(|row| row.method).max_by_key(|method| (*method == Method::Best, std::cmp::Reverse(*method)));
    let Some(method) = method else { return Attempt::left_out(NAME, TITLE, "no size is fused from selected images") };
    let blocks = blocks(fused().filter(|row| row.method == method));
    let all = blocks.iter().map(|block| block.sizes.len()).sum();
    let shown = &blocks[..blocks.len().min(MOST_PANELS)];
    let entries = legend_entries(shown);
    let names = names_width(shown);
    let top = 10.0 + legend::height(&entries, PAGE - names);
    let places = places(shown, top);
    let height = places.iter().map(|(_, bottom)| bottom + BELOW).fold(top, f64::max) + 24.0;
    let mut drawing = Drawing::new(PAGE, height);
    legend::draw(&mut drawing, &entries, [names, 4.0], PAGE - names);
    for (index, (block, place)) in shown.iter().zip(&places).enumerate() {
        let left = if index % 2 == 0 { 0.0 } else { COLUMN + GAP };
        draw_block(&mut drawing, block, [left + names, left + COLUMN - 8.0], *place);
    }
    drawing.text(Text::new(0.5 * PAGE, height - 6.0, Anchor::Middle, "size (mm)"));
    Attempt::drawn(NAME, TITLE, [caption(method, all, &blocks), alt(shown)], drawing)
}

fn blocks<'a>(rows: impl Iterator<Item = &'a ResultRow>) -> Vec<Block<'a>> {
    let mut blocks: BTreeMap<(&str, Quantity), Vec<Size<'a>>> = BTreeMap::new();
    for row in rows {
        let Some(predicted_mm) = row.predicted_mm.filter(|size| is_drawable(*size)) else { continue };
        let half_mm = row.sigma_mm.map(|sigma| K_95 * sigma).filter(|half| is_drawable(*half));
        blocks.entry((&row.object, row.quantity)).or_default().push(Size { row, predicted_mm, half_mm });
    }
    let block = |((object, quantity), sizes)| Block { object, quantity, sizes };
    blocks.into_iter().map(block).collect()
}

/// Width of the longest name, in units of the page.
fn names_width(blocks: &[Block<'_>]) -> f64 {
    let names = blocks.iter().flat_map(|block| block.shown().iter().map(|size| block.name(size.row)));
    names.map(|name| estimated_width(&name, 10.5) + 12.0).fold(60.0, f64::max).min(NAMES)
}

impl Block<'_> {
    /// The name of a size: its session, and its rater where the block has several.
    fn name(&self, row: &ResultRow) -> String {
        let several = self.shown().iter().any(|size| size.row.rater != self.sizes[0].row.rater);
        if several { format!("{}, {}", named(&row.session), named(&row.rater)) } else { named(&row.session) }
    }

    fn shown(&self) -> &[Size<'_>] {
        &self.sizes[..self.sizes.len().min(MOST_ROWS)]
    }

    /// Height of the block's panel, in units of the page.
    #[expect(clippy::cast_precision_loss, reason = "a handful of lines")]
    fn height(&self) -> f64 {
        LINE * self.shown().len() as f64 + 6.0
    }
}

/// Upper and lower edge of every panel. Two panels stand beside each other.
fn places(blocks: &[Block<'_>], top: f64) -> Vec<(f64, f64)> {
    let mut upper = top;
    let mut places = Vec::new();
    for pair in blocks.chunks(2) {
        let tallest = pair.iter().map(Block::height).fold(0.0, f64::max);
        places.extend(pair.iter().map(|block| (upper + HEADING, upper + HEADING + block.height())));
        upper += HEADING + tallest + BELOW;
    }
    places
}

fn truth(size: &Size<'_>) -> Option<f64> {
    size.row.truth_mm.filter(|truth| is_drawable(*truth))
}

fn draw_block(drawing: &mut Drawing, block: &Block<'_>, [left, right]: [f64; 2], (top, bottom): (f64, f64)) {
    let ends = |size: &Size<'_>| {
        let half = size.half_mm.unwrap_or_default();
        [Some(size.predicted_mm - half), Some(size.predicted_mm + half), truth(size)].into_iter().flatten()
    };
    let Some(domain) = padded(block.shown().iter().flat_map(ends), 0.06) else { return };
    let panel = Panel { x: Scale::linear(domain, [left, right]), y: Scale::linear([0.0, 1.0], [bottom, top]) };
    let object = fitted(block.object, right - left - 70.0, 10.5);
    let heading = Text::new(panel.left(), top - 7.0, Anchor::Start, format!("{object}, {}", block.quantity)).small();
    drawing.text(heading.bold().standing_for(&format!("{}, {}", named(block.object), block.quantity)));
    for (index, size) in block.shown().iter().enumerate() {
        #[expect(clippy::cast_precision_loss, reason = "a handful of lines")]
        let y = top + 3.0 + LINE * (index as f64 + 0.5);
        draw_size(drawing, &panel, size, y);
        let name = block.name(size.row);
        let text = Text::new(panel.left() - 7.0, y + 3.8, Anchor::End, fitted(&name, NAMES - 10.0, 10.5));
        drawing.text(text.small().standing_for(&name));
    }
    panel.x_ticks(drawing, &panel.x.ticks(4), true);
    panel.frame(drawing);
}

fn draw_size(drawing: &mut Drawing, panel: &Panel, size: &Size<'_>, y: f64) {
    let look = sample::look(size.row.kind, true);
    if let Some(half) = size.half_mm {
        let [low, high] = [size.predicted_mm - half, size.predicted_mm + half].map(|end| short(panel.x.place(end)));
        let whisker = |x: &str| format!("M{x},{}v7", short(y - 3.5));
        let bar = format!("M{low},{}H{high}", short(y));
        drawing.path("interval", interval(look), bar + &whisker(&low) + &whisker(&high));
    }
    if let Some(truth) = truth(size) {
        drawing.path("truth", TRUTH, format!("M{},{}v{LINE}", short(panel.x.place(truth)), short(y - 0.5 * LINE)));
    }
    drawing.path("marks", look.paint, look.symbol.path(panel.x.place(size.predicted_mm), y));
}

const fn interval(look: Look) -> Paint {
    Paint::line(look.paint.stroke, 1.4)
}

fn legend_entries(blocks: &[Block<'_>]) -> Vec<Entry> {
    let rows = || blocks.iter().flat_map(|block| &block.sizes);
    let kinds: std::collections::BTreeSet<_> = rows().map(|size| size.row.kind).collect();
    let mut entries: Vec<Entry> =
        kinds.into_iter().map(|kind| Entry::new(Sample::Mark(sample::look(kind, true)), kind.code())).collect();
    if rows().any(|size| size.half_mm.is_some()) {
        entries.push(Entry::new(Sample::Line(Paint::line(Colour::Ink, 1.4)), "95 % interval"));
    }
    if rows().any(|size| truth(size).is_some()) {
        entries.push(Entry::new(Sample::Line(TRUTH), "true size"));
    }
    entries
}

fn caption(method: Method, all: usize, blocks: &[Block<'_>]) -> String {
    let mut text = format!(
        "Fused sizes of each object and quantity by session (and rater, where there are several), method {method}, with \
         their 95 % intervals, predicted_mm \u{2213} 1.96 sigma_mm, which hold what the program knows of (docs/uncertainty.md). \
         Panels have scales of their own. {} in {}.",
        counted(all, "size"),
        counted(blocks.len(), "panel"),
    );
    if blocks.len() > MOST_PANELS {
        text.push_str(&format!(" The first {MOST_PANELS} of them by name are drawn; table sizes has all."));
    }
    if blocks.iter().any(|block| block.sizes.len() > MOST_ROWS) {
        text.push_str(&format!(
            " Of more than {MOST_ROWS} sizes of one quantity the first are drawn; table sizes has all."
        ));
    }
    text
}

fn alt(blocks: &[Block<'_>]) -> String {
    let words = |block: &Block<'_>| {
        let [low, high] = extremes(block.sizes.iter().map(|size| size.predicted_mm)).unwrap_or_default();
        let object = fitted(block.object, 240.0, 12.0);
        format!("{object} {} {} to {} mm", block.quantity, number(low, 0), number(high, 0))
    };
    let all: Vec<String> = blocks.iter().take(8).map(words).collect();
    let more = if blocks.len() > 8 { ", and others" } else { "" };
    format!("Sizes with intervals: {}{more}.", listed(&all))
}
