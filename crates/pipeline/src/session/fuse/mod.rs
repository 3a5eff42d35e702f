//! Step *fuse*: makes one size from the images of a session.
//!
//! - Input: the [`Measurement`]s of single images and the marked objects behind them ([`Marked`]), and `[select]` and
//!   `[measure]` of study.toml.
//! - Output: one row per object, rater, quantity and method, and one of all raters together; ranks and weights are set in
//!   the measurements.

mod consensus;
mod disagreement;
mod joint;
#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, BTreeSet};

use model::{
    Doubt, ErrorStats, Fused, Level, Method, Part, Quantity, ResultRow, Share, SizeSigma, Verdict, fuse as fuse_shares,
    median, parts_of_sum,
};

pub(super) use disagreement::problems as disagreements;

use super::found::fused_sigma;
use super::marked::Marked;
use super::measurement::Measurement;
use super::row::{doubt_codes, error_pct, with_sigma};
use crate::study::Study;

/// Object, rater and quantity of one fused row.
type Key<'a> = (&'a str, &'a str, Quantity);

/// The fused rows by object, rater, quantity and method, followed by those of all raters. Ranks and weights are set in
/// `measurements`.
///
/// Weights are robust inverse variances; errors that the images share do not average out ([`model::fuse`]).
pub(super) fn fuse(study: &Study, marked: &[Marked<'_>], measurements: &mut [Measurement]) -> Vec<ResultRow> {
    rank(measurements);
    let asked = &study.spec.measure.methods;
    let most = study.spec.select.best_images.map_or(u32::MAX, |n| u32::try_from(n.get()).unwrap_or(u32::MAX));
    let mut of_rater: BTreeMap<Key<'_>, Vec<Row>> = BTreeMap::new();
    let mut weights = Vec::new();
    for ((object, rater, quantity, method), group) in groups(measurements, most) {
        if method == Method::Best {
            continue; // the best of the fused sizes is taken below
        }
        let fused = row_of(measurements, &group);
        weights.extend(fused.iter().flat_map(|row| group.iter().copied().zip(row.weights.iter().copied())));
        of_rater.entry((object, rater, quantity)).or_default().extend(fused);
    }
    if asked.contains(&Method::Joint) || asked.contains(&Method::Best) {
        for row in joint::rows(marked, measurements) {
            let key = marked.iter().find(|m| m.marks.object == row.row.object && m.rater == row.row.rater);
            let Some(key) = key else { continue };
            of_rater.entry((&key.marks.object, key.rater, row.row.quantity)).or_default().push(row);
        }
    }
    let of_all = consensus::rows(&of_rater);
    let rows = of_rater.into_values().chain(of_all).flat_map(|rows| asked_for(rows, asked)).collect();
    for (i, weight) in weights {
        measurements[i].row.weight = Some(weight);
    }
    rows
}

/// A fused row with all by which the best is chosen, and from which a consensus is made.
#[derive(Clone)]
struct Row {
    row: ResultRow,
    sigma: SizeSigma,
    doubts: Vec<Doubt>,
    /// The weights of the measurements that were fused.
    weights: Vec<f64>,
    /// The parts of the size from each picture.
    parts: Vec<Part>,
    /// For each measurement the weight and the part (mm) of its uncertainty that all images share; see [`fused_sigma`].
    shared: Vec<(f64, f64)>,
}

/// The rows of the methods that were asked for, in the order of the methods, followed by the best of all of them if that was
/// asked for and no row is of method 'best' already.
fn asked_for(mut rows: Vec<Row>, asked: &[Method]) -> Vec<ResultRow> {
    rows.sort_by_key(|row| row.row.method);
    let has_best = rows.iter().any(|row| row.row.method == Method::Best);
    let best = if has_best || !asked.contains(&Method::Best) { None } else { best_row(&rows) };
    let best = best.map(|best| ResultRow { method: Method::Best, ..best.row.clone() });
    rows.into_iter().map(|row| row.row).filter(|row| asked.contains(&row.method)).chain(best).collect()
}

/// The row with the fewest doubts, and among several of those the surest, if all were of one size.
fn best_row(rows: &[Row]) -> Option<&Row> {
    let size_mm = |row: &Row| row.row.predicted_mm.unwrap_or_default();
    let middle_mm = median(rows.iter().map(size_mm).collect());
    let sigma = |row: &Row| row.sigma.total_at(size_mm(row), middle_mm);
    rows.iter().min_by(|a, b| a.doubts.len().cmp(&b.doubts.len()).then(sigma(a).total_cmp(&sigma(b))))
}

/// Sets the ranks of the selected images for each size, the surest first; equally sure ones keep their order. The
/// uncertainties are compared as if all images had given the same size.
fn rank(measurements: &mut [Measurement]) {
    for (_, mut group) in groups_owned(measurements) {
        let size_mm = |i: &usize| measurements[*i].row.predicted_mm.unwrap_or_default();
        let middle_mm = median(group.iter().map(size_mm).collect());
        let key = |i: &usize| {
            let m = &measurements[*i];
            let sigma_mm = m.estimate.as_ref().map(|estimate| estimate.sigma.total_at(size_mm(i), middle_mm));
            sigma_mm.unwrap_or(f64::INFINITY) * m.penalty.sqrt()
        };
        group.sort_by(|a, b| key(a).total_cmp(&key(b)));
        for (rank, i) in (1..).zip(group) {
            measurements[i].row.rank = Some(rank);
        }
    }
}

type Groups<'a> = BTreeMap<(&'a str, &'a str, Quantity, Method), Vec<usize>>;

/// The numbers of the measurements that go into one row: those of selected images whose rank is at most `most`.
fn groups(measurements: &[Measurement], most: u32) -> Groups<'_> {
    let mut groups = Groups::new();
    for (i, m) in measurements.iter().enumerate() {
        if m.row.selected && m.estimate.is_some() && m.row.rank.is_none_or(|rank| rank <= most) {
            groups.entry((&m.row.object, &m.row.rater, m.row.quantity, m.row.method)).or_default().push(i);
        }
    }
    groups
}

/// All groups by rater, with names of their own, so that the measurements can be changed.
fn groups_owned(measurements: &[Measurement]) -> BTreeMap<(String, String, Quantity, Method), Vec<usize>> {
    let owned = |((object, rater, quantity, method), group): ((&str, &str, Quantity, Method), Vec<usize>)| {
        ((object.to_owned(), rater.to_owned(), quantity, method), group)
    };
    groups(measurements, u32::MAX).into_iter().map(owned).collect()
}

fn share(measurement: &Measurement) -> Option<Share> {
    let estimate = measurement.estimate.as_ref()?;
    let part = Part { sensitivity: estimate.sensitivity, inputs: measurement.inputs, picture: measurement.picture };
    Some(Share::of_picture(estimate.measured.predicted_mm, part, measurement.penalty))
}

/// The sizes that become one, with the rows that they come from.
struct Members<'a> {
    rows: Vec<&'a ResultRow>,
    shares: Vec<Share>,
    doubts: BTreeSet<Doubt>,
    /// For each row, weight and shared part of what it was made from; see [`Row::shared`].
    shared: Vec<Vec<(f64, f64)>>,
}

fn row_of(measurements: &[Measurement], group: &[usize]) -> Option<Row> {
    let of_group: Vec<&Measurement> = group.iter().map(|&i| &measurements[i]).collect();
    let estimates = of_group.iter().filter_map(|m| m.estimate.as_ref());
    let members = Members {
        rows: of_group.iter().map(|m| &m.row).collect(),
        shares: of_group.iter().filter_map(|m| share(m)).collect(),
        doubts: estimates.flat_map(|estimate| estimate.doubts.iter().copied()).collect(),
        shared: of_group.iter().map(|m| vec![(1.0, m.shared_mm)]).collect(),
    };
    members.fused(Level::Fused, |row| format!("outlier:{}", in_flag(row.image.as_deref().unwrap_or_default())))
}

/// A name as a part of a code in `flags`, where commas are between codes.
fn in_flag(name: &str) -> String {
    name.replace(',', "_")
}

impl Members<'_> {
    /// The row of all of them together; `outlier_flag` gives the flag that names a row which is off.
    fn fused(self, level: Level, outlier_flag: impl Fn(&ResultRow) -> String) -> Option<Row> {
        let fused = fuse_shares(&self.shares)?;
        let weighted =
            |(shared, w): (&Vec<(f64, f64)>, &f64)| shared.iter().map(|(v, mm)| (v * w, *mm)).collect::<Vec<_>>();
        let shared: Vec<(f64, f64)> = self.shared.iter().zip(&fused.weights).flat_map(weighted).collect();
        let mark_px = self.shares.first()?.parts.first()?.inputs.mark_px;
        let sigma = fused_sigma(&fused.sigma, shared.iter().copied(), mark_px);
        let fused = Fused { sigma, ..fused };
        let doubts: Vec<Doubt> = self.doubts.into_iter().collect();
        let inconsistent = fused.consistency.is_some_and(|c| c.verdict == Verdict::Inconsistent);
        let flags: BTreeSet<String> = self
            .rows
            .iter()
            .flat_map(|row| row.flags.split(','))
            .filter(|flag| !flag.is_empty())
            .map(str::to_owned)
            .chain(fused.outliers.iter().map(|&i| outlier_flag(self.rows[i])))
            .chain(inconsistent.then(|| Verdict::Inconsistent.code().to_owned()))
            .collect();
        let flags = flags.into_iter().collect::<Vec<_>>().join(",");
        let row = ResultRow { flags, ..fused_row(&self.rows, &fused, level, &doubts)? };
        let parts = parts_of_sum(&self.shares, &fused.weights);
        Some(Row { row, sigma: fused.sigma, doubts, weights: fused.weights, parts, shared })
    }
}

/// The row of the size that was fused from `rows`, without flags.
fn fused_row(rows: &[&ResultRow], fused: &Fused, level: Level, doubts: &[Doubt]) -> Option<ResultRow> {
    let first = *rows.first()?;
    let mean = |value: fn(&ResultRow) -> Option<f64>| {
        let values: Option<Vec<f64>> = rows.iter().map(|row| value(row)).collect();
        ErrorStats::from_errors(&values?).map(|stats| stats.mean)
    };
    let images: BTreeSet<&Option<String>> = rows.iter().map(|row| &row.image).collect();
    let row = ResultRow {
        image: None,
        time_utc: None,
        pitch_deg: mean(|row| row.pitch_deg),
        roll_deg: mean(|row| row.roll_deg),
        range_mm: mean(|row| row.range_mm),
        level,
        predicted_mm: Some(fused.value_mm),
        plane_z_mm: mean(|row| row.plane_z_mm),
        error_pct: error_pct(Some(fused.value_mm), first.truth_mm),
        selected: true,
        frames: u32::try_from(images.len()).unwrap_or(u32::MAX),
        spread_mm: fused.spread_mm,
        doubts: doubt_codes(doubts),
        wall_slope: mean(|row| row.wall_slope),
        rank: None,
        weight: None,
        chi_squared: fused.consistency.map(|c| c.chi_squared),
        chi_squared_degrees: fused.consistency.map(|c| u32::try_from(c.degrees).unwrap_or(u32::MAX)),
        consistency: fused.consistency.map(|c| c.verdict),
        confidence: mean(|row| row.confidence),
        ..first.clone()
    };
    Some(with_sigma(row, &fused.sigma))
}
