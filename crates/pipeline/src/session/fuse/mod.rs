//! Step *fuse*: makes one size from the images of a session.
//!
//! - Input: the [`Measurement`]s of single images and the marked objects behind them ([`Marked`]), and `[select]` and
//!   `[measure]` of study.toml.
//! - Output: one row per object, rater, quantity and method, and one of all raters together; ranks and weights are set in
//!   the measurements.

mod joint;
#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, BTreeSet};

use model::{Doubt, ErrorStats, Fused, Level, Method, Quantity, ResultRow, Share, SizeSigma, fuse as fuse_shares};

use super::found::fused_sigma;
use super::marked::Marked;
use super::measurement::Measurement;
use super::row::{doubt_codes, error_pct, with_sigma};
use crate::study::Study;

/// The rater in rows of level consensus.
const ALL_RATERS: &str = "all";

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
    let mut of_all: BTreeMap<Key<'_>, Vec<Row>> = BTreeMap::new();
    let mut weights = Vec::new();
    for ((object, rater, quantity, method), group) in groups(measurements, most, true) {
        if method == Method::Best {
            continue; // the best of the fused sizes is taken below
        }
        let fused = row_of(measurements, &group, Level::Fused);
        weights.extend(fused.iter().flat_map(|row| group.iter().copied().zip(row.weights.iter().copied())));
        of_rater.entry((object, rater, quantity)).or_default().extend(fused);
    }
    for ((object, rater, quantity, method), group) in groups(measurements, most, false) {
        let raters: BTreeSet<&str> = group.iter().map(|&i| measurements[i].row.rater.as_str()).collect();
        if raters.len() > 1 && method != Method::Best {
            of_all.entry((object, rater, quantity)).or_default().extend(row_of(measurements, &group, Level::Consensus));
        }
    }
    if asked.contains(&Method::Joint) || asked.contains(&Method::Best) {
        for row in joint::rows(marked, measurements) {
            let key = marked.iter().find(|m| m.marks.object == row.row.object && m.rater == row.row.rater);
            let Some(key) = key else { continue };
            of_rater.entry((&key.marks.object, key.rater, row.row.quantity)).or_default().push(row);
        }
    }
    let rows = of_rater.into_values().chain(of_all.into_values()).flat_map(|rows| asked_for(rows, asked)).collect();
    for (i, weight) in weights {
        measurements[i].row.weight = Some(weight);
    }
    rows
}

/// A fused row with all by which the best is chosen.
struct Row {
    row: ResultRow,
    sigma: SizeSigma,
    doubts: Vec<Doubt>,
    weights: Vec<f64>,
}

/// The rows of the methods that were asked for, in the order of the methods, followed by the best of all of them if that was
/// asked for.
fn asked_for(mut rows: Vec<Row>, asked: &[Method]) -> Vec<ResultRow> {
    rows.sort_by_key(|row| row.row.method);
    let surest = rows
        .iter()
        .min_by(|a, b| a.doubts.len().cmp(&b.doubts.len()).then(a.sigma.total_mm.total_cmp(&b.sigma.total_mm)));
    let best = surest.filter(|_| asked.contains(&Method::Best));
    let best = best.map(|best| ResultRow { method: Method::Best, ..best.row.clone() });
    rows.into_iter().map(|row| row.row).filter(|row| asked.contains(&row.method)).chain(best).collect()
}

/// Sets the ranks of the selected images for each size, the surest first; equally sure ones keep their order.
fn rank(measurements: &mut [Measurement]) {
    for (_, mut group) in groups_owned(measurements) {
        let key = |i: &usize| {
            let m = &measurements[*i];
            m.row.sigma_mm.unwrap_or(f64::INFINITY) * m.penalty.sqrt()
        };
        group.sort_by(|a, b| key(a).total_cmp(&key(b)));
        for (rank, i) in (1..).zip(group) {
            measurements[i].row.rank = Some(rank);
        }
    }
}

type Groups<'a> = BTreeMap<(&'a str, &'a str, Quantity, Method), Vec<usize>>;

/// The numbers of the measurements that go into one row: those of selected images whose rank is at most `most`.
fn groups(measurements: &[Measurement], most: u32, by_rater: bool) -> Groups<'_> {
    let mut groups = Groups::new();
    for (i, m) in measurements.iter().enumerate() {
        if m.row.selected && m.estimate.is_some() && m.row.rank.is_none_or(|rank| rank <= most) {
            let rater = if by_rater { m.row.rater.as_str() } else { ALL_RATERS };
            groups.entry((&m.row.object, rater, m.row.quantity, m.row.method)).or_default().push(i);
        }
    }
    groups
}

/// All groups by rater, with names of their own, so that the measurements can be changed.
fn groups_owned(measurements: &[Measurement]) -> BTreeMap<(String, String, Quantity, Method), Vec<usize>> {
    let owned = |((object, rater, quantity, method), group): ((&str, &str, Quantity, Method), Vec<usize>)| {
        ((object.to_owned(), rater.to_owned(), quantity, method), group)
    };
    groups(measurements, u32::MAX, true).into_iter().map(owned).collect()
}

fn share(measurement: &Measurement) -> Option<Share> {
    let estimate = measurement.estimate.as_ref()?;
    Some(Share {
        value_mm: estimate.measured.predicted_mm,
        sensitivity: estimate.sensitivity,
        inputs: measurement.inputs,
        picture: measurement.picture,
        penalty: measurement.penalty,
    })
}

fn row_of(measurements: &[Measurement], group: &[usize], level: Level) -> Option<Row> {
    let members: Vec<&Measurement> = group.iter().map(|&i| &measurements[i]).collect();
    let shares: Vec<Share> = members.iter().filter_map(|m| share(m)).collect();
    let fused = fuse_shares(&shares)?;
    let shared = fused.weights.iter().copied().zip(members.iter().map(|m| m.shared_mm));
    let sigma = fused_sigma(&fused.sigma, shared, members.first()?.inputs.mark_px);
    let fused = Fused { sigma, ..fused };
    let doubts: BTreeSet<Doubt> =
        members.iter().filter_map(|m| m.estimate.as_ref()).flat_map(|e| e.doubts.iter().copied()).collect();
    let doubts: Vec<Doubt> = doubts.into_iter().collect();
    let rows: Vec<&ResultRow> = members.iter().map(|m| &m.row).collect();
    let row = ResultRow { flags: flags(&rows, &fused, level), ..fused_row(&rows, &fused, level, &doubts)? };
    Some(Row { row, sigma: fused.sigma, doubts, weights: fused.weights })
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
        rater: if level == Level::Consensus { ALL_RATERS.to_owned() } else { first.rater.clone() },
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

/// The flags of any of the rows, each code once, and the outliers: a rater all of whose sizes are off, else the image.
fn flags(rows: &[&ResultRow], fused: &Fused, level: Level) -> String {
    let mut all: BTreeSet<String> =
        rows.iter().flat_map(|row| row.flags.split(',')).filter(|flag| !flag.is_empty()).map(str::to_owned).collect();
    for &i in &fused.outliers {
        let rater = &rows[i].rater;
        let of_rater = || (0..rows.len()).filter(|&other| rows[other].rater == *rater);
        let name = |text: &str| text.replace(',', "_");
        all.insert(if level == Level::Consensus && of_rater().all(|other| fused.outliers.contains(&other)) {
            format!("outlier_rater:{}", name(rater))
        } else if level == Level::Consensus {
            format!("outlier:{}@{}", name(rater), name(rows[i].image.as_deref().unwrap_or_default()))
        } else {
            format!("outlier:{}", name(rows[i].image.as_deref().unwrap_or_default()))
        });
    }
    all.into_iter().collect::<Vec<_>>().join(",")
}
