//! The figures `error_by_pitch` and `error_by_height`: errors against the pitch, and against the height of the camera.

use std::collections::BTreeMap;

use model::{ErrorStats, Level, Method, ResultRow};

use super::drawing::{Colour, Drawing, Paint};
use super::grid::{Axis, Grid, draw_count};
use super::legend::{Entry, Sample};
use super::marks::{self, Drawn, Look, Mark, Symbol};
use super::panel::Panel;
use super::sample::{self, Dimension, Erring, Sorted, bulk, erring};
use super::scale::{is_drawable, padded};
use super::settings::Window;
use super::words::{counted, listed, signed};
use super::{Attempt, NO_TRUTH};
use crate::parquet::Results;
use crate::tables::{height_band_cm, pitch_band_deg};

const ZERO: Paint = Paint::line(Colour::Ink, 1.0);
const WINDOW: Paint = Paint::line(Colour::Ink, 1.0).dashed("2 3");
const MEAN: Paint = Paint::line(Colour::Ink, 2.2);
const SPREAD: Paint = Paint::area(Colour::Ink, 0.14);

/// The pitch or the height, over which errors are drawn.
struct Against {
    name: &'static str,
    title: &'static str,
    x_label: &'static str,
    what: &'static str,
    /// The pitch or height of a row.
    value: fn(&ResultRow) -> Option<f64>,
    /// The borders of the row's band, as in the table of the same name. They are equal where the value is nominal.
    band: fn(&ResultRow) -> Option<[f64; 2]>,
}

/// Draws the errors of single images by pitch.
pub(super) fn by_pitch(results: &Results) -> Attempt {
    let against = Against {
        name: "error_by_pitch",
        title: "Error by measured pitch",
        x_label: "pitch (deg)",
        what: "measured pitch of the camera",
        value: |row| row.pitch_deg,
        band: pitch_band_deg,
    };
    draw(&against, results, Window::from_results(results))
}

/// Draws the errors of single images by the measured height of the camera above the table.
pub(super) fn by_height(results: &Results) -> Attempt {
    let against = Against {
        name: "error_by_height",
        title: "Error by height of the camera above the table",
        x_label: "height of the camera (cm)",
        what: "measured height of the camera above the table (range times sine of pitch)",
        value: |row| Some(row.range_mm? / 10.0 * row.pitch_deg?.to_radians().sin()),
        band: height_band_cm,
    };
    draw(&against, results, None)
}

fn draw(against: &Against, results: &Results, window: Option<Window>) -> Attempt {
    let value = |row: &ResultRow| (against.value)(row).filter(|value| is_drawable(*value));
    let sorted = Sorted::new(erring(&results.rows, Level::Frame).filter(|erring| value(erring.row).is_some()));
    let x = padded(sorted.all().filter_map(|erring| value(erring.row)), 0.06);
    let Some(x) = x.filter(|_| !sorted.is_empty()) else {
        return Attempt::left_out(against.name, against.title, NO_TRUTH);
    };
    let axes = sorted.dimensions.iter().map(|dimension| {
        let errors: Vec<f64> = sorted.of_dimension(*dimension).map(Erring::error_pct).collect();
        (dimension.name(), Axis::linear(bulk(&errors).unwrap_or([-1.0, 1.0])))
    });
    let grid = Grid {
        columns: sorted.method_names(),
        rows: axes.collect(),
        x: Axis::linear(x),
        x_label: against.x_label,
        y_label: "error (%)",
        height: if sorted.dimensions.len() > 2 { 118.0 } else { 190.0 },
        legend: legend(&sorted, window),
    };
    let (mut drawing, panels) = grid.draw();
    let most = marks::MOST_MARKS / (sorted.dimensions.len() * sorted.methods.len());
    let titles = marks::MOST_TITLES / (sorted.dimensions.len() * sorted.methods.len());
    let (mut drawn, mut beyond) = (Drawn::default(), 0);
    for (dimension, row) in sorted.dimensions.iter().zip(&panels) {
        for (method, panel) in sorted.methods.iter().zip(row) {
            let rows = sorted.cell(*dimension, *method);
            window.iter().for_each(|window| window.draw_upright(&mut drawing, panel, WINDOW));
            panel.level(&mut drawing, "zero", ZERO, 0.0);
            draw_bands(&mut drawing, panel, rows, against);
            beyond += rows.iter().filter(|erring| !panel.y.holds(erring.error_pct())).count();
            let marks = rows.iter().filter_map(|erring| Some(mark(panel, *erring, value(erring.row)?))).collect();
            drawn.add(marks::draw(&mut drawing, marks, [most, titles], Erring::title));
            draw_count(&mut drawing, panel, rows.len());
        }
    }
    let captions = [caption(against, &sorted, window, beyond) + &drawn.remark(), alt(against, &sorted)];
    Attempt::drawn(against.name, against.title, captions, drawing)
}

fn mark<'a>(panel: &Panel, erring: Erring<'a>, x: f64) -> Mark<Erring<'a>> {
    let error = erring.error_pct();
    let mut look = sample::look(erring.row.kind, erring.row.selected);
    let [lower, upper] = panel.y.range();
    let y = panel.y.place(error);
    if !panel.y.holds(error) {
        look =
            Look { symbol: if (y - upper).abs() < (y - lower).abs() { Symbol::Above } else { Symbol::Below }, ..look };
    }
    Mark { x: panel.x.place(x), y, look, weight: error.abs(), of: erring }
}

/// Draws the mean and the SD of the errors in every band.
fn draw_bands(drawing: &mut Drawing, panel: &Panel, rows: &[Erring<'_>], against: &Against) {
    let mut bands: BTreeMap<[i64; 2], ([f64; 2], Vec<f64>)> = BTreeMap::new();
    for erring in rows {
        let Some(band) = (against.band)(erring.row) else { continue };
        #[expect(clippy::cast_possible_truncation, reason = "borders of bands are small numbers")]
        let key = band.map(|border| (border * 1e3).round() as i64);
        bands.entry(key).or_insert((band, Vec::new())).1.push(erring.error_pct());
    }
    let (mut means, mut spreads) = (String::new(), String::new());
    for (band, errors) in bands.values() {
        let Some(stats) = ErrorStats::from_errors(errors) else { continue };
        // A nominal value has no width, but the bar of its mean needs some to be seen.
        let [from, to] = *band;
        let ends = if to > from { [from, to] } else { [from - 2.0, from + 2.0] };
        if panel.y.holds(stats.mean) {
            means.push_str(&panel.line(ends.map(|x| [x, stats.mean])));
        }
        if let Some(sd) = stats.sample_sd {
            spreads.push_str(&panel.rectangle(ends, [stats.mean - sd, stats.mean + sd]));
        }
    }
    drawing.path("spread", SPREAD, spreads);
    drawing.path("mean", MEAN, means);
}

fn legend(sorted: &Sorted<'_>, window: Option<Window>) -> Vec<Entry> {
    let mut entries: Vec<Entry> = sorted
        .kinds()
        .into_iter()
        .map(|kind| Entry::new(Sample::Mark(sample::look(kind, true)), format!("{kind}, image selected")))
        .collect();
    if let Some(kind) = sorted.kinds().into_iter().next() {
        entries.push(Entry::new(Sample::Mark(sample::look(kind, false)), "hollow: not selected"));
    }
    entries.push(Entry::new(Sample::Line(MEAN), "mean of band"));
    entries.push(Entry::new(Sample::Area(SPREAD), "\u{b1} SD"));
    entries.extend(window.map(|_| Entry::new(Sample::Line(WINDOW), "target window")));
    entries
}

fn caption(against: &Against, sorted: &Sorted<'_>, window: Option<Window>, beyond: usize) -> String {
    let table = against.name;
    let mut text = format!(
        "Error, 100 (predicted \u{2212} true) / true, in per cent, against the {}: {} of single images, one mark each, by \
         what was measured (rows; across: diameter, width and length) and method (columns). Bars: mean and sample SD \
         (n \u{2212} 1) of each band of table {table}. Rows have scales of their own.",
        against.what,
        counted(sorted.count(), "size"),
    );
    if let Some(window) = window {
        text.push_str(&format!(" Dashed: the window of pitch in which images are selected, {}.", window.name()));
    }
    if beyond > 0 {
        text.push_str(&format!(" {} beyond a scale: arrow heads at its edge.", counted(beyond, "error")));
    }
    text
}

fn alt(against: &Against, sorted: &Sorted<'_>) -> String {
    let method = if sorted.methods.contains(&Method::Best) { Method::Best } else { sorted.methods[0] };
    let bias = |dimension: &Dimension| {
        let errors: Vec<f64> = sorted.cell(*dimension, method).iter().map(Erring::error_pct).collect();
        ErrorStats::from_errors(&errors).map(|stats| format!("{} {} %", dimension.name(), signed(stats.mean, 1)))
    };
    let biases: Vec<String> = sorted.dimensions.iter().filter_map(bias).collect();
    format!(
        "Scatter plots of the error in per cent against the {}. Mean errors of method {method}: {}.",
        against.what,
        listed(&biases)
    )
}
