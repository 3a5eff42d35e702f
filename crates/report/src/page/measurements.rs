//! The data of the page's table of all measurements, which sorts, filters and opens pictures.

use model::results::RESULT_COLUMNS;
use model::{Level, ResultRow};

use super::data::{Datum, Grid, GridColumn, GridKind, Words, rounded};

/// The source of a column's cells: the kind of cell, its decimals, and its value in a row.
enum Source {
    Text(fn(&ResultRow) -> &str),
    Number(usize, fn(&ResultRow) -> Option<f64>),
    Count(fn(&ResultRow) -> Option<u32>),
    Magnitude(usize, fn(&ResultRow) -> Option<f64>),
    Time(fn(&ResultRow) -> Option<i64>),
    Flag(fn(&ResultRow) -> bool),
}

/// A column: its name in results.parquet, its heading, whether only the view of a single row shows it, and its cells.
type Spec = (&'static str, &'static str, bool, Source);

const NS_PER_MS: i64 = 1_000_000;

/// The columns that stay even where they are empty throughout, since the script finds pictures by them.
const NEEDED: [&str; 4] = ["session", "object", "image", "level"];

fn specs() -> Vec<Spec> {
    use Source::{Count, Flag, Magnitude, Number, Text, Time};
    vec![
        ("session", "session", false, Text(|row| &row.session)),
        ("object", "object", false, Text(|row| &row.object)),
        ("image", "image", false, Text(|row| row.image.as_deref().unwrap_or(""))),
        ("level", "level", false, Text(|row| row.level.code())),
        ("rater", "rater", false, Text(|row| &row.rater)),
        ("quantity", "quantity", false, Text(|row| row.quantity.code())),
        ("method", "method", false, Text(|row| row.method.code())),
        ("predicted_mm", "size (mm)", false, Number(1, |row| row.predicted_mm)),
        ("sigma_mm", "sigma (mm)", false, Number(2, |row| row.sigma_mm)),
        ("truth_mm", "true size (mm)", false, Number(1, |row| row.truth_mm)),
        ("error_pct", "error (%)", false, Magnitude(2, |row| row.error_pct)),
        ("pitch_deg", "pitch (\u{b0})", false, Number(2, |row| row.pitch_deg)),
        ("range_mm", "range (mm)", false, Number(1, |row| row.range_mm)),
        ("selected", "selected", false, Flag(|row| row.selected)),
        ("confidence", "confidence", false, Number(3, |row| row.confidence)),
        ("flags", "flags", false, Text(|row| &row.flags)),
        ("doubts", "doubts", false, Text(|row| &row.doubts)),
        ("participant", "participant", true, Text(|row| row.participant.as_deref().unwrap_or(""))),
        ("kind", "kind", true, Text(|row| row.kind.code())),
        ("shape", "shape", true, Text(|row| row.shape.code())),
        ("setup_height_mm", "setup height (mm)", true, Number(1, |row| row.setup_height_mm)),
        ("setup_pitch_deg", "setup pitch (\u{b0})", true, Number(1, |row| row.setup_pitch_deg)),
        ("time_utc", "time (UTC)", true, Time(|row| row.time_utc.map(|time| time.0.div_euclid(NS_PER_MS)))),
        ("roll_deg", "roll (\u{b0})", true, Number(2, |row| row.roll_deg)),
        ("method_used", "method taken", true, Text(|row| row.method_used.map_or("", model::Method::code))),
        ("plane_z_mm", "height of the plane (mm)", true, Number(1, |row| row.plane_z_mm)),
        ("sigma_pitch_mm", "sigma from pitch (mm)", true, Number(2, |row| row.sigma_pitch_mm)),
        ("sigma_roll_mm", "sigma from roll (mm)", true, Number(2, |row| row.sigma_roll_mm)),
        ("sigma_range_mm", "sigma from range (mm)", true, Number(2, |row| row.sigma_range_mm)),
        ("sigma_marks_mm", "sigma from marks (mm)", true, Number(2, |row| row.sigma_marks_mm)),
        ("sigma_camera_mm", "sigma from camera (mm)", true, Number(2, |row| row.sigma_camera_mm)),
        ("sigma_mount_mm", "sigma from mount (mm)", true, Number(2, |row| row.sigma_mount_mm)),
        ("sigma_disagreement_mm", "sigma from disagreement (mm)", true, Number(2, |row| row.sigma_disagreement_mm)),
        ("sigma_common_mm", "sigma in common (mm)", true, Number(2, |row| row.sigma_common_mm)),
        ("frames", "images behind it", true, Count(|row| (row.level != Level::Frame).then_some(row.frames))),
        ("spread_mm", "spread (mm)", true, Number(2, |row| row.spread_mm)),
        ("wall_slope", "wall slope", true, Number(3, |row| row.wall_slope)),
        ("rank", "rank", true, Count(|row| row.rank)),
        ("weight", "weight", true, Number(3, |row| row.weight)),
        ("chi_squared", "chi-square", true, Number(2, |row| row.chi_squared)),
        ("chi_squared_degrees", "its degrees of freedom", true, Count(|row| row.chi_squared_degrees)),
        ("consistency", "consistency", true, Text(|row| row.consistency.map_or("", model::Verdict::code))),
    ]
}

/// The rows in the order of the results, without the columns that are empty throughout.
pub(super) fn grid(rows: &[ResultRow]) -> Grid {
    let mut words = Words::default();
    let specs = specs().into_iter().filter(|spec| NEEDED.contains(&spec.0) || rows.iter().any(|row| has(spec, row)));
    let specs: Vec<Spec> = specs.collect();
    let cells = |row: &ResultRow, words: &mut Words| specs.iter().map(|spec| datum(spec, row, words)).collect();
    let rows = rows.iter().map(|row| cells(row, &mut words)).collect();
    Grid { columns: specs.iter().map(column).collect(), rows, words: words.into_list() }
}

fn has((_, _, _, source): &Spec, row: &ResultRow) -> bool {
    match source {
        Source::Text(text) => !text(row).is_empty(),
        Source::Number(_, number) | Source::Magnitude(_, number) => number(row).is_some(),
        Source::Count(count) => count(row).is_some(),
        Source::Time(time) => time(row).is_some(),
        Source::Flag(_) => true,
    }
}

fn datum((_, _, _, source): &Spec, row: &ResultRow, words: &mut Words) -> Datum {
    match source {
        Source::Text(text) => words.place(text(row)),
        Source::Number(decimals, number) | Source::Magnitude(decimals, number) => rounded(number(row), *decimals),
        Source::Count(count) => count(row).map_or(Datum::Nothing(()), |count| Datum::Whole(i64::from(count))),
        Source::Time(time) => time(row).map_or(Datum::Nothing(()), Datum::Whole),
        Source::Flag(flag) => Datum::Whole(i64::from(flag(row))),
    }
}

fn column((name, heading, detail, source): &Spec) -> GridColumn {
    let (kind, decimals) = match source {
        Source::Text(_) => (GridKind::Text, 0),
        Source::Number(decimals, _) => (GridKind::Number, *decimals),
        Source::Count(_) => (GridKind::Number, 0),
        Source::Magnitude(decimals, _) => (GridKind::Magnitude, *decimals),
        Source::Time(_) => (GridKind::Time, 0),
        Source::Flag(_) => (GridKind::Flag, 0),
    };
    let meaning = RESULT_COLUMNS.iter().find(|column| column.name == *name).map_or("", |column| column.meaning);
    GridColumn { name: (*name).to_owned(), heading: (*heading).to_owned(), meaning, kind, decimals, detail: *detail }
}

#[cfg(test)]
mod tests {
    use super::{RESULT_COLUMNS, specs};

    /// A column that is renamed in the results would lose its meaning here.
    #[test]
    fn every_column_is_one_of_the_results() {
        for (name, ..) in specs() {
            assert!(RESULT_COLUMNS.iter().any(|column| column.name == name), "{name}");
        }
    }
}
