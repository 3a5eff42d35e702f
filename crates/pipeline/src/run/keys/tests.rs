//! Every key of study.toml, changed one by one: the stages whose keys it belongs to run again, and no others.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeSet;
use std::path::Path;

use serde_json::{Value, json};

use super::{MeasureParts, signals_key};
use crate::run::plan::RunContext;
use crate::session::Prepared;
use crate::study::{MarksSource, Study, StudySpec};

/// The stages that run again: the ingest of the card and all that follows, the signals and all that follows, the search for rims and the
/// measuring, the measuring alone, or nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum From {
    Ingest,
    Signals,
    Search,
    Measure,
    Nothing,
}

/// Each key as a JSON pointer, another value that it may have, and what then runs again.
fn changes() -> Vec<(&'static str, Value, From)> {
    vec![
        ("/name", json!("other"), From::Measure),
        ("/statement", json!("other"), From::Nothing),
        ("/time_zone", json!("Europe/Berlin"), From::Ingest),
        ("/device_profile", json!("pupil-neon"), From::Ingest),
        ("/camera", json!("aim2-corrected"), From::Ingest), // its pictures have another size
        ("/marks/camera", json!("aim2-corrected"), From::Search),
        ("/marks/frame", json!("shown"), From::Search),
        ("/marks/source", json!("auto"), From::Measure),
        ("/marks/min_confidence", json!(0.6), From::Search),
        ("/marks/min_diameter_mm", json!(120.0), From::Search),
        ("/marks/shapes", json!(["circle", "rectangle"]), From::Search),
        ("/mount/pitch_offset_deg", json!(20.0), From::Search),
        ("/time/image_lag_s", json!(0.5), From::Signals),
        ("/time/estimate_lag", json!(true), From::Signals),
        ("/signals/gravity_cutoff_hz", json!(0.3), From::Signals),
        ("/signals/gravity_calibration", json!("apply"), From::Signals),
        ("/signals/range_window_s", json!(0.9), From::Signals),
        ("/signals/range_min_mm", json!(40.0), From::Signals),
        ("/signals/range_max_mm", json!(1500.0), From::Signals),
        ("/signals/range_update_s", json!(0.03), From::Signals),
        ("/signals/gravity_tolerance_mg", json!(140.0), From::Search),
        ("/signals/stillness_max_mg", json!(40.0), From::Search),
        ("/signals/range_cone", json!("tilted_plane"), From::Search),
        ("/select/target_pitch_deg", json!(50.0), From::Search),
        ("/select/pitch_tolerance_deg", json!(6.0), From::Search),
        ("/select/best_images", json!(3), From::Search),
        ("/measure/methods", json!(["ray"]), From::Measure),
        ("/uncertainty/pitch_deg", json!(1.1), From::Search),
        ("/uncertainty/tilt_deg", json!(1.1), From::Search),
        ("/uncertainty/mount_deg", json!(1.1), From::Search),
        ("/uncertainty/range_pct", json!(1.1), From::Search),
        ("/uncertainty/range_offset_mm", json!(1.1), From::Search),
        ("/uncertainty/focal_pct", json!(1.1), From::Search),
        ("/uncertainty/principal_px", json!(1.1), From::Search),
        ("/uncertainty/distortion_px", json!(1.1), From::Search),
        ("/uncertainty/turn_noise_deg", json!(1.1), From::Search),
        ("/uncertainty/motion_share", json!(0.4), From::Search),
        ("/uncertainty/range_noise_mm", json!(1.1), From::Search),
        ("/uncertainty/mark_px", json!(1.1), From::Search),
        ("/tables", json!([]), From::Nothing),
    ]
}

/// It names the layout of the file, and has no other value.
const FIXED: &str = "/schema_version";

fn bench(adjust: impl FnOnce(&mut StudySpec)) -> Study {
    let dir = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data-samples/published-bench");
    Study::load(&dir, |spec| {
        spec.marks.source = MarksSource::Both;
        adjust(spec);
    })
    .unwrap()
}

/// The fingerprint of the card, and the keys of signals, search and measuring, of the first session.
fn keys(study: &Study) -> [String; 4] {
    let dir = &study.sessions[0];
    let context = RunContext::new(study, "program").unwrap();
    let prepared = Prepared::new(study, dir, "program").unwrap();
    // The contents of a card do not change here, so the rest of the key of ingest stands for all of it.
    let ingest = context.fingerprinter.fingerprint(&prepared.source).unwrap().hex();
    let signals = signals_key(study, "program", &ingest).unwrap();
    let parts = MeasureParts::new(study, dir, &prepared, "program", &signals, "objects");
    let (search, measure) = (parts.search_key(dir).unwrap().unwrap(), parts.key(dir).unwrap());
    [ingest, signals, search, measure]
}

#[test]
fn every_key_of_study_toml_runs_the_right_stages_again() {
    let before = bench(|_| ());
    let keys_before = keys(&before);
    for (pointer, value, expected) in changes() {
        let after = bench(|spec| {
            let mut json = serde_json::to_value(&*spec).unwrap();
            *json.pointer_mut(pointer).unwrap() = value;
            *spec = serde_json::from_value(json).unwrap();
        });
        assert_ne!(after.spec, before.spec, "{pointer} has that value already");
        let changed: Vec<bool> = keys(&after).iter().zip(&keys_before).map(|(after, before)| after != before).collect();
        let expected: Vec<bool> =
            [From::Ingest, From::Signals, From::Search, From::Measure].map(|stage| stage >= expected).to_vec();
        assert_eq!(changed, expected, "{pointer}: whether ingest, signals, search and measure run again");
    }
}

#[test]
fn every_key_of_study_toml_is_tried() {
    let mut keys = BTreeSet::new();
    collect_keys(&serde_json::to_value(&bench(|_| ()).spec).unwrap(), String::new(), &mut keys);
    let tried = changes().into_iter().map(|(pointer, ..)| pointer.to_owned()).chain([FIXED.to_owned()]);
    assert_eq!(tried.collect::<BTreeSet<_>>(), keys);
}

/// The pointers of everything in a JSON value that is no object.
fn collect_keys(value: &Value, pointer: String, keys: &mut BTreeSet<String>) {
    match value {
        Value::Object(fields) => {
            fields.iter().for_each(|(name, value)| collect_keys(value, format!("{pointer}/{name}"), keys));
        }
        _ => {
            keys.insert(pointer);
        }
    }
}
