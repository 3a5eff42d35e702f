//! The figure `calibration`: errors against the uncertainties that were predicted for them.

use super::coverage::{Claimed, Claims, K_95, level_name};
use super::drawing::{Colour, Drawing, Paint};
use super::grid::{Axis, Grid, draw_count};
use super::legend::{Entry, Sample};
use super::marks::{self, Drawn, Look, Mark, Symbol};
use super::panel::Panel;
use super::sample;
use super::words::{counted, listed, named, number};
use super::{Attempt, NO_TRUTH};
use crate::parquet::Results;

const NAME: &str = "calibration";
const TITLE: &str = "Predicted uncertainty and actual error";

const ONE: Paint = Paint::line(Colour::Ink, 1.4);
const TWO: Paint = Paint::line(Colour::Ink, 1.2).dashed("6 3");
const BINNED: Paint = Paint::line(Colour::Ink, 1.2).dashed("1.5 2.5");
const BIN: Look = Look::filled(Symbol::Diamond, Colour::Ink);

/// Least number of sizes in a bin.
const BIN_AT_LEAST: usize = 8;
/// Greatest number of bins.
const MOST_BINS: usize = 6;
/// The axis of errors begins at the smallest predicted uncertainty over this number. Smaller errors stand at the edge.
const BELOW: f64 = 50.0;

/// Draws absolute errors against predicted standard uncertainties, both on logarithmic axes.
pub(super) fn draw(results: &Results) -> Attempt {
    let claims = Claims::from_results(results);
    let Some((x, y)) = domains(&claims) else { return Attempt::left_out(NAME, TITLE, NO_TRUTH) };
    let kinds: std::collections::BTreeSet<_> = claims.all().iter().map(|claimed| claimed.row.kind).collect();
    let mut legend: Vec<Entry> =
        kinds.into_iter().map(|kind| Entry::new(Sample::Mark(sample::look(kind, false)), kind.code())).collect();
    legend.push(Entry::new(Sample::Mark(BIN), "RMS error of a bin"));
    legend.push(Entry::new(Sample::Line(ONE), "error = sigma"));
    legend.push(Entry::new(Sample::Line(TWO), "1.96 sigma"));
    let axis = Axis::logarithmic(y);
    let grid = Grid {
        columns: claims.method_names(),
        rows: claims.levels.iter().map(|level| (level_name(*level).to_owned(), axis.clone())).collect(),
        x: Axis::logarithmic(x),
        x_label: "predicted standard uncertainty (mm)",
        y_label: "absolute error (mm)",
        height: 180.0,
        legend,
    };
    let (mut drawing, panels) = grid.draw();
    let cells = claims.levels.len() * claims.methods.len();
    let mut drawn = Drawn::default();
    for (level, row) in claims.levels.iter().zip(&panels) {
        for (method, panel) in claims.methods.iter().zip(row) {
            let rows = claims.cell(*level, *method);
            let marks = rows.iter().map(|claimed| mark(panel, claimed)).collect();
            draw_lines(&mut drawing, panel, x);
            let most = [marks::MOST_MARKS / cells, marks::MOST_TITLES / cells];
            drawn.add(marks::draw(&mut drawing, marks, most, |claimed| title(claimed)));
            draw_bins(&mut drawing, panel, &bins(&rows));
            draw_count(&mut drawing, panel, rows.len());
        }
    }
    Attempt::drawn(NAME, TITLE, [caption(&claims) + &drawn.remark(), alt(&claims)], drawing)
}

/// The domains of uncertainties and of errors, in mm; none where there are no sizes.
fn domains(claims: &Claims<'_>) -> Option<([f64; 2], [f64; 2])> {
    let all = claims.all();
    let fold = |values: &mut dyn Iterator<Item = f64>| {
        values.fold([f64::INFINITY, 0.0_f64], |[low, high], value| [low.min(value), high.max(value)])
    };
    let [low, high] = fold(&mut all.iter().map(|claimed| claimed.sigma_mm));
    let [_, worst] = fold(&mut all.iter().map(|claimed| claimed.error_mm));
    let x = [low / 1.3, high * 1.3];
    (!all.is_empty()).then_some((x, [low / BELOW, 1.5 * worst.max(K_95 * high)]))
}

fn mark<'a>(panel: &Panel, claimed: &'a Claimed<'a>) -> Mark<&'a Claimed<'a>> {
    Mark {
        x: panel.x.place(claimed.sigma_mm),
        y: panel.y.place(claimed.error_mm),
        look: sample::look(claimed.row.kind, false),
        weight: claimed.error_mm / claimed.sigma_mm,
        of: claimed,
    }
}

fn title(claimed: &Claimed<'_>) -> String {
    let Claimed { row, error_mm, sigma_mm } = claimed;
    let image = row.image.as_deref().map(|image| format!(", {}", named(image))).unwrap_or_default();
    format!(
        "{}, {}, {}, {}{image}: error {error_mm:.2} mm, sigma {sigma_mm:.2} mm",
        named(&row.object),
        row.quantity,
        named(&row.session),
        named(&row.rater),
    )
}

fn draw_lines(drawing: &mut Drawing, panel: &Panel, [low, high]: [f64; 2]) {
    drawing.path("claimed", ONE, panel.line([[low, low], [high, high]]));
    drawing.path("claimed", TWO, panel.line([[low, K_95 * low], [high, K_95 * high]]));
}

/// The RMS of the predicted uncertainties and the RMS of the errors in each bin, in mm. A bin holds sizes with similar
/// uncertainties, and all bins hold about the same number.
fn bins(rows: &[&Claimed<'_>]) -> Vec<[f64; 2]> {
    let mut rows: Vec<[f64; 2]> = rows.iter().map(|claimed| [claimed.sigma_mm, claimed.error_mm]).collect();
    rows.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let many = (rows.len() / BIN_AT_LEAST).min(MOST_BINS);
    #[expect(clippy::cast_precision_loss, reason = "a count of sizes is far below 2^53")]
    let rms =
        |bin: &[[f64; 2]], of: usize| (bin.iter().map(|pair| pair[of].powi(2)).sum::<f64>() / bin.len() as f64).sqrt();
    let bin = |index: usize| &rows[index * rows.len() / many..(index + 1) * rows.len() / many];
    (0..many).map(|index| [rms(bin(index), 0), rms(bin(index), 1)]).collect()
}

fn draw_bins(drawing: &mut Drawing, panel: &Panel, bins: &[[f64; 2]]) {
    drawing.path("bins", BINNED, panel.line(bins.iter().copied()));
    let symbols = bins.iter().map(|[sigma, error]| BIN.symbol.path(panel.x.place(*sigma), panel.y.place(*error)));
    drawing.path("bins", BIN.paint, symbols.collect());
}

fn caption(claims: &Claims<'_>) -> String {
    format!(
        "Absolute error against the predicted standard uncertainty (sigma_mm), both in mm on logarithmic scales: {} with a \
         true size and no assumption in doubt, by method (columns) and level (rows). Diamonds: root mean square of the \
         errors against that of the uncertainties, in up to {MOST_BINS} bins of equally many sizes, at least {BIN_AT_LEAST} \
         each; on the solid line they are as large as predicted, above it larger. About 1 in 20 marks is to lie above the \
         dashed line. Errors below 1/{BELOW} of the smallest uncertainty stand at the lower edge.",
        counted(claims.count(), "size"),
    )
}

fn alt(claims: &Claims<'_>) -> String {
    let level = claims.levels[0];
    let ratio = |method: &model::Method| {
        let rows = claims.cell(level, *method);
        let sum = |of: fn(&Claimed<'_>) -> f64| rows.iter().map(|claimed| of(claimed).powi(2)).sum::<f64>();
        let ratio = (sum(|claimed| claimed.error_mm) / sum(|claimed| claimed.sigma_mm)).sqrt();
        (!rows.is_empty()).then(|| format!("{method} {}", number(ratio, 2)))
    };
    let all: Vec<String> = claims.methods.iter().filter_map(ratio).collect();
    format!(
        "Scatter plots of absolute error against predicted uncertainty. Root mean square error over root mean square \
         uncertainty, {}: {}.",
        level_name(level),
        listed(&all)
    )
}
