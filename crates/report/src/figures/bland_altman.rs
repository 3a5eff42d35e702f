//! The figure `bland_altman`: errors against true sizes, as Bland and Altman (1986) draw agreement.

use model::Level;
use model::validation::ErrorSummary;

use super::drawing::{Anchor, Colour, Drawing, Paint, Text};
use super::grid::{Axis, Grid, draw_count};
use super::legend::{Entry, Sample};
use super::marks::{self, Drawn, Look, Mark, Symbol};
use super::panel::Panel;
use super::sample::{self, Dimension, Erring, Sorted, bulk, erring};
use super::scale::padded;
use super::words::{counted, listed, number, signed};
use super::{Attempt, NO_TRUTH};
use crate::parquet::Results;

const NAME: &str = "bland_altman";
const TITLE: &str = "Agreement of predicted and true sizes";

const ZERO: Paint = Paint::line(Colour::Ink, 0.8).faint(0.5);
const BIAS: Paint = Paint::line(Colour::Ink, 1.8);
const LIMIT: Paint = Paint::line(Colour::Ink, 1.2).dashed("6 3");

/// Draws the errors of fused sizes against the true sizes, or of the sizes of single images where no size is fused.
pub(super) fn draw(results: &Results) -> Attempt {
    let fused = Sorted::new(erring(&results.rows, Level::Fused));
    let (sorted, level) = if fused.is_empty() {
        (Sorted::new(erring(&results.rows, Level::Frame)), Level::Frame)
    } else {
        (fused, Level::Fused)
    };
    let Some([low, high]) = padded(sorted.all().map(|erring| erring.truth_mm), 0.06) else {
        return Attempt::left_out(NAME, TITLE, NO_TRUTH);
    };
    // There must be room at the right for the values of bias and limits.
    let x = [low, high + 0.3 * (high - low)];
    let axes = sorted.dimensions.iter().map(|dimension| (dimension.name(), Axis::linear(domain(&sorted, *dimension))));
    let grid = Grid {
        columns: sorted.method_names(),
        rows: axes.collect(),
        x: Axis::linear(x),
        x_label: "true size (mm)",
        y_label: "predicted \u{2212} true (mm)",
        height: if sorted.dimensions.len() > 2 { 118.0 } else { 190.0 },
        legend: legend(&sorted),
    };
    let (mut drawing, panels) = grid.draw();
    let cells = sorted.dimensions.len() * sorted.methods.len();
    let (mut drawn, mut beyond) = (Drawn::default(), 0);
    for (dimension, row) in sorted.dimensions.iter().zip(&panels) {
        for (method, panel) in sorted.methods.iter().zip(row) {
            let rows = sorted.cell(*dimension, *method);
            panel.level(&mut drawing, "zero", ZERO, 0.0);
            beyond += rows.iter().filter(|erring| !panel.y.holds(erring.error_mm)).count();
            let marks = rows.iter().map(|erring| mark(panel, *erring)).collect();
            let most = [marks::MOST_MARKS / cells, marks::MOST_TITLES / cells];
            drawn.add(marks::draw(&mut drawing, marks, most, Erring::title));
            draw_agreement(&mut drawing, panel, rows);
            draw_count(&mut drawing, panel, rows.len());
        }
    }
    Attempt::drawn(NAME, TITLE, [caption(&sorted, level, beyond) + &drawn.remark(), alt(&sorted)], drawing)
}

/// The domain of errors in mm, which holds the limits of agreement of every method as well.
fn domain(sorted: &Sorted<'_>, dimension: Dimension) -> [f64; 2] {
    let errors: Vec<f64> = sorted.of_dimension(dimension).map(|erring| erring.error_mm).collect();
    let limits = sorted.methods.iter().filter_map(|method| summary(sorted.cell(dimension, *method))?.limits).flatten();
    let of_errors = bulk(&errors).unwrap_or([-1.0, 1.0]);
    padded(limits.chain(of_errors), 0.14).unwrap_or(of_errors)
}

fn summary(rows: &[Erring<'_>]) -> Option<ErrorSummary> {
    ErrorSummary::from_errors(&rows.iter().map(|erring| erring.error_mm).collect::<Vec<_>>())
}

fn mark<'a>(panel: &Panel, erring: Erring<'a>) -> Mark<Erring<'a>> {
    let mut look = sample::look(erring.row.kind, true);
    if !panel.y.holds(erring.error_mm) {
        look = Look { symbol: if erring.error_mm > 0.0 { Symbol::Above } else { Symbol::Below }, ..look };
    }
    let (x, y) = (panel.x.place(erring.truth_mm), panel.y.place(erring.error_mm));
    Mark { x, y, look, weight: erring.error_mm.abs(), of: erring }
}

/// Draws the lines of bias and limits, with their values at the right.
fn draw_agreement(drawing: &mut Drawing, panel: &Panel, rows: &[Erring<'_>]) {
    let Some(summary) = summary(rows) else { return };
    panel.level(drawing, "bias", BIAS, summary.bias);
    let Some([low, high]) = summary.limits else { return };
    for limit in [low, high] {
        panel.level(drawing, "limit", LIMIT, limit);
    }
    let mut taken: Vec<f64> = Vec::new();
    for value in [summary.bias, low, high] {
        // A label that would lie on another one is left out, since the table accuracy has the numbers.
        let y = panel.y.place(value) - 3.0;
        let is_free = taken.iter().all(|taken| (taken - y).abs() >= 11.0) && y - 8.0 >= panel.top();
        if panel.y.holds(value) && is_free {
            drawing.text(Text::new(panel.right() - 2.0, y, Anchor::End, signed(value, 1)).small());
            taken.push(y);
        }
    }
}

fn legend(sorted: &Sorted<'_>) -> Vec<Entry> {
    let kinds = sorted.kinds().into_iter();
    let mut entries: Vec<Entry> =
        kinds.map(|kind| Entry::new(Sample::Mark(sample::look(kind, true)), kind.code())).collect();
    entries.push(Entry::new(Sample::Line(BIAS), "bias"));
    entries.push(Entry::new(Sample::Line(LIMIT), "limits of agreement, bias \u{2213} 1.96 SD"));
    entries
}

fn caption(sorted: &Sorted<'_>, level: Level, beyond: usize) -> String {
    let (rows, of) = match level {
        Level::Fused => ("fused size", "one mark for each session, object, rater and quantity"),
        _ => ("size", "one mark for each image, object, rater and quantity, since no size is fused"),
    };
    let mut text = format!(
        "Predicted less true size against the true size (the reference), in mm: {}, {of}; across: diameter, width and \
         length. Solid: bias, the mean. Dashed: limits of agreement, bias \u{2213} 1.96 sample SD (Bland and Altman 1986), with \
         their values in mm; sizes of one object are not independent of each other. Rows have scales of their own.",
        counted(sorted.count(), rows),
    );
    if beyond > 0 {
        text.push_str(&format!(" {} beyond a scale: arrow heads at its edge.", counted(beyond, "difference")));
    }
    text
}

fn alt(sorted: &Sorted<'_>) -> String {
    let method = sorted.methods[sorted.methods.len() - 1];
    let words = |dimension: &Dimension| {
        let summary = summary(sorted.cell(*dimension, method))?;
        let limits = summary.limits.map(|[low, high]| format!(" ({} to {})", number(low, 1), number(high, 1)));
        Some(format!("{} {} mm{}", dimension.name(), signed(summary.bias, 1), limits.unwrap_or_default()))
    };
    let all: Vec<String> = sorted.dimensions.iter().filter_map(words).collect();
    format!(
        "Plots of predicted less true size against true size. Bias and limits of agreement of method {method}: {}.",
        listed(&all)
    )
}
