//! One size per object, rater, quantity and method from the selected frames of a session.

use std::collections::BTreeMap;

use model::{ErrorStats, Level, Method, Quantity, ResultRow};

use super::rows::error_pct;

/// Fused rows, by object, rater, quantity and method.
///
/// The value is the mean over the selected frames. Pitch, roll, range and camera errors are common to the frames of a
/// session (one mount, one sensor, one calibration), so their parts are averaged and do not shrink with the number of
/// frames; only the marks' part does.
pub(super) fn fuse(rows: &[ResultRow]) -> Vec<ResultRow> {
    let mut groups: BTreeMap<(&str, &str, Quantity, Method), Vec<&ResultRow>> = BTreeMap::new();
    for row in rows.iter().filter(|row| row.selected && row.predicted_mm.is_some()) {
        groups.entry((&row.object, &row.rater, row.quantity, row.method)).or_default().push(row);
    }
    groups.into_values().filter_map(|frames| fuse_group(&frames)).collect()
}

fn fuse_group(frames: &[&ResultRow]) -> Option<ResultRow> {
    let first = *frames.first()?;
    let predicted: Vec<f64> = frames.iter().filter_map(|row| row.predicted_mm).collect();
    let stats = ErrorStats::of(&predicted)?;
    let mean = |value: fn(&ResultRow) -> Option<f64>| {
        let values: Option<Vec<f64>> = frames.iter().map(|row| value(row)).collect();
        ErrorStats::of(&values?).map(|stats| stats.mean)
    };
    #[expect(clippy::cast_precision_loss, reason = "a count of frames is far below 2^53")]
    let frame_count = frames.len() as f64;
    let sigma_marks_mm = mean(|row| row.sigma_marks_mm.map(|s| s * s)).map(|variance| (variance / frame_count).sqrt());
    let common = [
        mean(|row| row.sigma_pitch_mm),
        mean(|row| row.sigma_roll_mm),
        mean(|row| row.sigma_range_mm),
        mean(|row| row.sigma_camera_mm),
    ];
    let variance: Option<f64> = common.iter().chain([&sigma_marks_mm]).map(|part| part.map(|s| s * s)).sum();
    let [sigma_pitch_mm, sigma_roll_mm, sigma_range_mm, sigma_camera_mm] = common;
    Some(ResultRow {
        image: None,
        time_utc: None,
        pitch_deg: mean(|row| row.pitch_deg),
        roll_deg: mean(|row| row.roll_deg),
        range_mm: mean(|row| row.range_mm),
        level: Level::Fused,
        predicted_mm: Some(stats.mean),
        sigma_mm: variance.map(f64::sqrt),
        sigma_pitch_mm,
        sigma_roll_mm,
        sigma_range_mm,
        sigma_marks_mm,
        sigma_camera_mm,
        plane_z_mm: mean(|row| row.plane_z_mm),
        error_pct: error_pct(Some(stats.mean), first.truth_mm),
        frames: u32::try_from(frames.len()).unwrap_or(u32::MAX),
        spread_mm: stats.sample_sd,
        ..first.clone()
    })
}
