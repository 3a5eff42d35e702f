//! The tables `error_by_pitch` and `error_by_height`: errors by the pitch and the height of the camera.

use std::collections::{BTreeMap, BTreeSet};

use model::{ErrorStats, Kind, Level, Method, Quantity, ResultRow};

use super::errors::row_error_pct;
use crate::parquet::Results;
use crate::table::{Cell, Column, Format, RowKind, Table, TableRow};

/// Borders of the bands of pitch in degrees. Each band holds its lower border, and the last one both. The paper's pitches of
/// 40, 55 and 70 degrees lie near the middle of their bands.
const PITCH_BORDERS_DEG: [f64; 6] = [0.0, 30.0, 47.5, 62.5, 75.0, 90.0];

/// Width of a band of measured heights, in mm.
const HEIGHT_BAND_MM: f64 = 100.0;

const STATISTIC: &str = "Error: 100 (predicted - original) / original, signed, of every image. Bias: mean; SD: sample SD \
                         (n - 1); MAE: mean absolute error; RMS: root mean square; worst: the largest absolute error. \
                         'across' takes diameter, width and length together.";

/// A band: its borders in 1/1000 of a unit (integers, so that they sort and compare), and whether its value is nominal or
/// measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Band {
    basis: Option<&'static str>,
    from: i64,
    to: i64,
}

/// The properties that the errors of one row of the table have in common. Without a quantity, it stands for diameter, width
/// and length together.
type Key = (Kind, std::cmp::Reverse<bool>, Option<Quantity>, Method, Band);

/// The errors by kind, quantity, method and band of the *measured* pitch, from rows of single images with a true size.
#[must_use]
pub fn error_by_pitch(results: &Results) -> Table {
    let columns = [("pitch_from_deg", "pitch from"), ("pitch_to_deg", "pitch to")]
        .map(|(name, heading)| Column::key(name).numbers("deg").headed(heading).formatted(Format::Decimals(1)));
    table(results, "error_by_pitch", "Error by measured pitch", None, columns, pitch_band)
}

/// The errors by kind, quantity, method and height of the camera above the table. It is the nominal height where a session has
/// one (`basis` nominal), and else a band of 10 cm of the measured height, which is range times sine of pitch (`basis` measured).
#[must_use]
pub fn error_by_height(results: &Results) -> Table {
    let columns = [("height_from_cm", "height from"), ("height_to_cm", "height to")]
        .map(|(name, heading)| Column::key(name).numbers("cm").headed(heading).formatted(Format::Decimals(1)));
    let basis = Column::key("basis").headed("height is");
    table(
        results,
        "error_by_height",
        "Error by height of the camera above the table",
        Some(basis),
        columns,
        height_band,
    )
}

fn pitch_band(row: &ResultRow) -> Option<Band> {
    let pitch_deg = row.pitch_deg?;
    let (last, inner) = PITCH_BORDERS_DEG.split_last()?;
    let from = inner.iter().rposition(|border| pitch_deg >= *border).filter(|_| pitch_deg <= *last)?;
    Some(Band { basis: None, from: thousandths(PITCH_BORDERS_DEG[from]), to: thousandths(PITCH_BORDERS_DEG[from + 1]) })
}

fn height_band(row: &ResultRow) -> Option<Band> {
    if let Some(nominal_mm) = row.setup_height_mm {
        let height = thousandths(nominal_mm / 10.0);
        return Some(Band { basis: Some("nominal"), from: height, to: height });
    }
    let height_mm = row.range_mm? * row.pitch_deg?.to_radians().sin();
    let from_mm = (height_mm / HEIGHT_BAND_MM).floor() * HEIGHT_BAND_MM;
    let [from, to] = [from_mm, from_mm + HEIGHT_BAND_MM].map(|border| thousandths(border / 10.0));
    height_mm.is_finite().then_some(Band { basis: Some("measured"), from, to })
}

/// The borders of a row's band of measured pitch, in degrees; none where the row has no pitch in [0, 90].
pub(crate) fn pitch_band_deg(row: &ResultRow) -> Option<[f64; 2]> {
    pitch_band(row).map(Band::borders)
}

/// The borders of a row's band of the height of the camera, in cm. They are equal where the height is nominal.
pub(crate) fn height_band_cm(row: &ResultRow) -> Option<[f64; 2]> {
    height_band(row).map(Band::borders)
}

impl Band {
    #[expect(clippy::cast_precision_loss, reason = "borders are far below 2^53")]
    fn borders(self) -> [f64; 2] {
        [self.from, self.to].map(|border| border as f64 / 1e3)
    }
}

/// The name of a row's band of pitch.
pub(super) fn pitch_name(row: &ResultRow) -> Option<String> {
    pitch_band(row).map(|band| band_name(band, "deg"))
}

/// The name of a row's band of the height of the camera.
pub(super) fn height_name(row: &ResultRow) -> Option<String> {
    height_band(row).map(|band| band_name(band, "cm"))
}

#[expect(clippy::cast_precision_loss, reason = "borders are far below 2^53")]
fn band_name(band: Band, unit: &str) -> String {
    // Names are sorted as text, so they have three digits before the point.
    let border = |thousandths: i64| format!("{:05.1}", thousandths as f64 / 1e3);
    if band.from == band.to {
        format!("{} {unit}", border(band.from))
    } else {
        format!("{}-{} {unit}", border(band.from), border(band.to))
    }
}

#[expect(clippy::cast_possible_truncation, reason = "the float-to-integer cast saturates, far beyond any height")]
fn thousandths(value: f64) -> i64 {
    (value * 1e3).round() as i64
}

#[expect(clippy::cast_precision_loss, reason = "borders are far below 2^53")]
fn band_cell(thousandths: i64) -> Cell {
    Cell::Number(thousandths as f64 / 1e3)
}

fn table(
    results: &Results,
    stem: &str,
    title: &str,
    basis: Option<Column>,
    borders: [Column; 2],
    band_of: impl Fn(&ResultRow) -> Option<Band>,
) -> Table {
    let mut columns: Vec<Column> = ["kind", "quantity", "method"].map(|name| Column::key(name).headed(name)).into();
    columns.extend(basis);
    columns.extend(borders);
    columns.push(Column::result("n", "").headed("n"));
    for (name, heading) in [
        ("bias_pct", "bias"),
        ("sd_pct", "SD"),
        ("mean_absolute_pct", "MAE"),
        ("rms_pct", "RMS"),
        ("worst_pct", "worst"),
    ] {
        columns.push(Column::result(name, "%").headed(heading));
    }
    let rows: Vec<TableRow> =
        errors(results, band_of).iter().filter_map(|(key, errors)| band_row(key, errors)).collect();
    let empty = "No size of a single image has a true size to compare with.".to_owned();
    Table {
        stem: stem.to_owned(),
        label: None,
        title: title.to_owned(),
        statistic: STATISTIC.to_owned(),
        columns,
        remarks: if rows.is_empty() { vec![empty] } else { Vec::new() },
        rows,
        footnotes: Vec::new(),
        statement: results.metadata.statement.clone(),
    }
}

/// The errors in per cent for every row of the table.
fn errors(results: &Results, band_of: impl Fn(&ResultRow) -> Option<Band>) -> BTreeMap<Key, Vec<f64>> {
    let frames = || results.rows.iter().filter(|row| row.level == Level::Frame);
    let measured = || frames().filter_map(|row| Some((row, band_of(row)?, row_error_pct(row)?)));
    let horizontal: BTreeSet<(Kind, Method, Quantity)> = measured()
        .filter(|(row, ..)| row.quantity != Quantity::Height)
        .map(|(row, ..)| (row.kind, row.method, row.quantity))
        .collect();
    let mut errors: BTreeMap<Key, Vec<f64>> = BTreeMap::new();
    for (row, band, error) in measured() {
        let key = |quantity: Option<Quantity>| -> Key {
            (row.kind, std::cmp::Reverse(quantity.is_some()), quantity, row.method, band)
        };
        errors.entry(key(Some(row.quantity))).or_default().push(error);
        let several =
            horizontal.iter().filter(|(kind, method, _)| (*kind, *method) == (row.kind, row.method)).count() > 1;
        if several && row.quantity != Quantity::Height {
            errors.entry(key(None)).or_default().push(error);
        }
    }
    errors
}

fn band_row((kind, _, quantity, method, band): &Key, errors: &[f64]) -> Option<TableRow> {
    let stats = ErrorStats::from_errors(errors)?;
    let mut cells =
        vec![Cell::text(kind.code()), Cell::text(quantity.map_or("across", Quantity::code)), Cell::text(method.code())];
    cells.extend(band.basis.map(Cell::text));
    cells.extend([band_cell(band.from), band_cell(band.to), Cell::Count(stats.n)]);
    let numbers = [Some(stats.mean), stats.sample_sd, Some(stats.mean_absolute), Some(stats.rms), Some(stats.worst)];
    cells.extend(numbers.map(Cell::number));
    Some(TableRow { kind: RowKind::Row, label: None, cells, marks: Vec::new() })
}
