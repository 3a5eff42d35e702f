//! One size per object, rater, quantity and method from the selected frames of a session.

use std::collections::{BTreeMap, BTreeSet};

use model::{ErrorStats, Level, Method, Quantity, ResultRow};

use super::rows::error_pct;

/// Fused rows, by object, rater, quantity and method.
///
/// The value is the mean over the selected frames. Pitch, roll, range and camera errors are common to the frames of a
/// session (one mount, one sensor, one calibration), so their parts do not shrink with the number of frames; only the
/// marks' part does. The parts are averaged without their signs, as if each error pulled all frames the same way: an
/// upper bound.
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
        flags: flags(frames),
        ..first.clone()
    })
}

/// What to know about any of the frames, each code once.
fn flags(frames: &[&ResultRow]) -> String {
    let all = frames.iter().flat_map(|row| row.flags.split(',')).filter(|flag| !flag.is_empty());
    all.collect::<BTreeSet<_>>().into_iter().collect::<Vec<_>>().join(",")
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use model::results::RESULTS_SCHEMA_VERSION;
    use model::{Kind, Shape, UtcNs};

    use super::*;

    fn frame(rater: &str, predicted_mm: Option<f64>, selected: bool) -> ResultRow {
        ResultRow {
            schema_version: RESULTS_SCHEMA_VERSION,
            study: "t".to_owned(),
            session: "s".to_owned(),
            participant: None,
            object: "plate".to_owned(),
            kind: Kind::Plate,
            shape: Shape::Circle,
            setup_height_mm: None,
            setup_pitch_deg: None,
            rater: rater.to_owned(),
            image: Some("a.jpg".to_owned()),
            time_utc: Some(UtcNs(0)),
            pitch_deg: Some(55.0),
            roll_deg: Some(1.0),
            range_mm: Some(500.0),
            quantity: Quantity::Diameter,
            method: Method::Ray,
            level: Level::Frame,
            predicted_mm,
            sigma_mm: Some(0.0),
            sigma_pitch_mm: Some(1.0),
            sigma_roll_mm: Some(0.5),
            sigma_range_mm: Some(6.0),
            sigma_marks_mm: Some(2.0),
            sigma_camera_mm: Some(1.5),
            plane_z_mm: Some(0.0),
            truth_mm: Some(200.0),
            error_pct: None,
            selected,
            frames: 1,
            spread_mm: None,
            flags: String::new(),
        }
    }

    #[test]
    fn the_mean_of_selected_frames_with_what_is_common_kept() {
        let rows = [frame("A", Some(204.0), true), frame("A", Some(208.0), true), frame("A", Some(300.0), false)];
        let fused = fuse(&rows);
        assert_eq!(fused.len(), 1);
        let row = &fused[0];
        assert_eq!((row.predicted_mm, row.error_pct, row.frames), (Some(206.0), Some(3.0), 2));
        assert_eq!((row.level, &row.image, row.time_utc), (Level::Fused, &None, None));
        assert!((row.spread_mm.unwrap() - 8.0_f64.sqrt()).abs() < 1e-12);
        assert!((row.sigma_marks_mm.unwrap() - 2.0 / 2.0_f64.sqrt()).abs() < 1e-12, "marks are independent");
        assert_eq!((row.sigma_range_mm, row.sigma_pitch_mm), (Some(6.0), Some(1.0)), "the pose's errors are common");
        let expected: f64 = 1.0 + 0.25 + 36.0 + 2.0 + 2.25;
        assert!((row.sigma_mm.unwrap() - expected.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn a_flag_of_one_frame_is_one_of_the_fused_size() {
        let flagged = |flags: &str| ResultRow { flags: flags.to_owned(), ..frame("A", Some(200.0), true) };
        let fused = fuse(&[flagged(""), flagged("range_step,mark_outside_picture"), flagged("range_step")]);
        assert_eq!(fused[0].flags, "mark_outside_picture,range_step");
    }

    #[test]
    fn raters_stay_apart_and_a_size_without_value_is_left_out() {
        let rows = [frame("B", Some(190.0), true), frame("A", None, true), frame("A", Some(210.0), true)];
        let fused = fuse(&rows);
        let values: Vec<_> = fused.iter().map(|row| (row.rater.as_str(), row.predicted_mm, row.spread_mm)).collect();
        assert_eq!(values, [("A", Some(210.0), None), ("B", Some(190.0), None)]);
        assert!(fuse(&[frame("A", Some(1.0), false)]).is_empty());
    }
}
