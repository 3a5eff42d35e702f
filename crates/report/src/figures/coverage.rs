//! The figure `coverage`: whether intervals of the stated uncertainties hold the truth as often as they claim to.

use model::{Level, Method, ResultRow};

use super::drawing::{Anchor, Colour, Drawing, Paint, Text, short};
use super::grid::{Axis, Grid, draw_count};
use super::legend::{Entry, Sample};
use super::marks::{Look, Symbol};
use super::panel::Panel;
use super::sample::erring;
use super::scale::is_drawable;
use super::words::{listed, number};
use super::{Attempt, NO_TRUTH};
use crate::parquet::Results;

const NAME: &str = "coverage";
const TITLE: &str = "Coverage of the predicted uncertainties";

const CLAIM: Paint = Paint::line(Colour::Ink, 1.4).dashed("6 3");
const OBSERVED: Paint = Paint::line(Colour::Blue, 1.8);
const INTERVAL: Paint = Paint::line(Colour::Blue, 1.2);
const POINT: Look = Look::filled(Symbol::Diamond, Colour::Blue);

/// Number of SDs within which 95 % of a Gaussian lie.
pub(super) const K_95: f64 = 1.959_963_984_540_054;
/// A smaller uncertainty (below a nanometre) counts as none, since its square may be zero.
const LEAST_SIGMA_MM: f64 = 1e-6;
/// Number of steps of the curve per standard uncertainty.
const STEPS: u32 = 20;
/// Number of standard uncertainties at which the curve ends.
const LAST: u32 = 3;

/// An absolute error and the standard uncertainty that was predicted for it, both in mm.
pub(super) struct Claimed<'a> {
    pub(super) row: &'a ResultRow,
    pub(super) error_mm: f64,
    pub(super) sigma_mm: f64,
}

/// The sizes that have a truth and an uncertainty, and no doubt about their method: by level (rows) and method (columns).
pub(super) struct Claims<'a> {
    pub(super) levels: Vec<Level>,
    pub(super) methods: Vec<Method>,
    all: Vec<Claimed<'a>>,
}

impl<'a> Claims<'a> {
    pub(super) fn from_results(results: &'a Results) -> Self {
        let of_level = |level| {
            erring(&results.rows, level).filter(|erring| erring.row.doubts.is_empty()).filter_map(|erring| {
                let sigma_mm = erring.row.sigma_mm.filter(|sigma| *sigma >= LEAST_SIGMA_MM && is_drawable(*sigma))?;
                Some(Claimed { row: erring.row, error_mm: erring.error_mm.abs(), sigma_mm })
            })
        };
        let all: Vec<Claimed<'_>> = [Level::Frame, Level::Fused].into_iter().flat_map(of_level).collect();
        let has = |is: &dyn Fn(&ResultRow) -> bool| all.iter().any(|claimed| is(claimed.row));
        let levels = Level::ALL.iter().copied().filter(|level| has(&|row| row.level == *level)).collect();
        let methods = Method::ALL.iter().copied().filter(|method| has(&|row| row.method == *method)).collect();
        Self { levels, methods, all }
    }

    pub(super) fn cell(&self, level: Level, method: Method) -> Vec<&Claimed<'a>> {
        self.all.iter().filter(|claimed| claimed.row.level == level && claimed.row.method == method).collect()
    }

    pub(super) fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    pub(super) fn all(&self) -> &[Claimed<'a>] {
        &self.all
    }

    pub(super) fn count(&self) -> usize {
        self.all.len()
    }

    pub(super) fn method_names(&self) -> Vec<String> {
        self.methods.iter().map(|method| method.code().to_owned()).collect()
    }
}

/// The name of a level, for people.
pub(super) const fn level_name(level: Level) -> &'static str {
    match level {
        Level::Frame => "single images",
        Level::Fused => "fused",
        Level::Consensus => "consensus",
    }
}

/// Draws the observed and the claimed coverage of every method.
pub(super) fn draw(results: &Results) -> Attempt {
    let claims = Claims::from_results(results);
    if claims.is_empty() {
        return Attempt::left_out(NAME, TITLE, NO_TRUTH);
    }
    let axis = Axis::linear([0.0, 100.0]);
    let grid = Grid {
        columns: claims.method_names(),
        rows: claims.levels.iter().map(|level| (level_name(*level).to_owned(), axis.clone())).collect(),
        x: Axis::linear([0.0, f64::from(LAST)]),
        x_label: "k, in predicted standard uncertainties",
        y_label: "errors within k sigma (%)",
        height: 170.0,
        legend: vec![
            Entry::new(Sample::Line(OBSERVED), "observed"),
            Entry::new(Sample::Mark(POINT), "at k = 1 and 1.96, with 95 % interval"),
            Entry::new(Sample::Line(CLAIM), "claimed (Gaussian)"),
        ],
    };
    let (mut drawing, panels) = grid.draw();
    for (level, row) in claims.levels.iter().zip(&panels) {
        for (method, panel) in claims.methods.iter().zip(row) {
            let errors: Vec<f64> =
                claims.cell(*level, *method).iter().map(|claimed| claimed.error_mm / claimed.sigma_mm).collect();
            draw_coverage(&mut drawing, panel, &errors);
            draw_count(&mut drawing, panel, errors.len());
        }
    }
    Attempt::drawn(NAME, TITLE, [caption(&claims), alt(&claims)], drawing)
}

/// The values of k at which the curves are drawn.
fn curve() -> impl Iterator<Item = f64> {
    (0..=STEPS * LAST).map(|step| f64::from(step) / f64::from(STEPS))
}

/// Number of the errors within k, where errors are in units of their standard uncertainties.
fn within(errors: &[f64], k: f64) -> usize {
    errors.iter().filter(|error| **error <= k).count()
}

#[expect(clippy::cast_precision_loss, reason = "a count of sizes is far below 2^53")]
fn share_pct(errors: &[f64], k: f64) -> f64 {
    100.0 * within(errors, k) as f64 / errors.len() as f64
}

fn draw_coverage(drawing: &mut Drawing, panel: &Panel, errors: &[f64]) {
    drawing.path("claimed", CLAIM, panel.line(curve().map(|k| [k, 100.0 * within_gaussian(k)])));
    if errors.is_empty() {
        return;
    }
    drawing.path("observed", OBSERVED, panel.line(curve().map(|k| [k, share_pct(errors, k)])));
    for k in [1.0, K_95] {
        let share = share_pct(errors, k);
        let [low, high] = wilson(within(errors, k), errors.len()).map(|share| panel.y.place(100.0 * share));
        let (x, y) = (panel.x.place(k), panel.y.place(share));
        let whisker = |y: f64| format!("M{},{}h8", short(x - 4.0), short(y));
        let bar = format!("M{},{}V{}", short(x), short(low), short(high));
        drawing.path("interval", INTERVAL, bar + &whisker(low) + &whisker(high));
        drawing.path("share", POINT.paint, POINT.symbol.path(x, y));
        let below = low.max(y) + 13.0;
        let label =
            Text::new(x + 6.0, below.min(panel.bottom() - 4.0), Anchor::Start, format!("{} %", number(share, 0)));
        drawing.text(label.small());
    }
}

/// The 95 % interval, from 0 to 1, of a share of `hits` in `n` > 0, by Wilson's score (J. Am. Stat. Assoc. 22, 1927).
#[expect(clippy::cast_precision_loss, reason = "a count of sizes is far below 2^53")]
pub(super) fn wilson(hits: usize, n: usize) -> [f64; 2] {
    let (p, n, z2) = (hits as f64 / n as f64, n as f64, K_95 * K_95);
    let middle = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
    let half = K_95 / (1.0 + z2 / n) * (p * (1.0 - p) / n + z2 / (4.0 * n * n)).sqrt();
    [(middle - half).max(0.0), (middle + half).min(1.0)]
}

/// The share of a Gaussian within k > 0 SDs, erf(k / sqrt 2), with an error below 1e-9, by Simpson's rule with steps of at
/// most 1/100 SD.
fn within_gaussian(k: f64) -> f64 {
    let density = |x: f64| (-0.5 * x * x).exp() * (2.0 / std::f64::consts::PI).sqrt();
    let steps = 400_u32;
    let h = k / f64::from(steps);
    let inner: f64 = (1..steps).map(|i| if i % 2 == 1 { 4.0 } else { 2.0 } * density(f64::from(i) * h)).sum();
    h / 3.0 * (density(0.0) + inner + density(k))
}

fn caption(claims: &Claims<'_>) -> String {
    format!(
        "Share of sizes whose absolute error is at most k predicted standard uncertainties (sigma_mm), observed (solid) and \
         as a Gaussian has it (dashed), for {} sizes with a true size and no assumption in doubt (column doubts), by method \
         (columns) and level (rows). Diamonds: k = 1 (claimed: 68.3 %) and k = 1.96 (95 %), with Wilson's 95 % interval of a \
         binomial share; it takes sizes as independent, which those of one image or object are not, so it is too short.",
        claims.count(),
    )
}

fn alt(claims: &Claims<'_>) -> String {
    let words = |level: Level, method: Method| {
        let errors: Vec<f64> =
            claims.cell(level, method).iter().map(|claimed| claimed.error_mm / claimed.sigma_mm).collect();
        let [one, two] = [1.0, K_95].map(|k| number(share_pct(&errors, k), 0));
        (!errors.is_empty()).then(|| format!("{method}, {}: {one} and {two} %", level_name(level)))
    };
    let all: Vec<String> = claims
        .levels
        .iter()
        .flat_map(|level| claims.methods.iter().filter_map(move |method| words(*level, *method)))
        .collect();
    format!("Curves of observed against claimed coverage. Within 1 and 1.96 standard uncertainties: {}.", listed(&all))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_and_intervals_are_those_of_tables() {
        for (k, share) in [(0.5, 0.382_924_923), (1.0, 0.682_689_492), (K_95, 0.95), (3.0, 0.997_300_204)] {
            assert!((within_gaussian(k) - share).abs() < 1e-9, "{k}");
        }
        // scipy 1.15: binomtest(8, 10).proportion_ci(method='wilson').
        let [low, high] = wilson(8, 10);
        assert!((low - 0.490_162_5).abs() < 1e-6 && (high - 0.943_317_8).abs() < 1e-6, "{low} {high}");
        assert!(wilson(0, 4)[0] < 1e-12 && wilson(4, 4)[1] > 1.0 - 1e-12);
    }
}
