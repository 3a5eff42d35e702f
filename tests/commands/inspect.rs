//! `inspect` says what is in a recording.

use std::path::Path;
use std::process::Output;

use serde_json::Value;

use crate::support::{
    Shot, StudyFolder, assert_exit, published_bench, real_data, run, small_camera, small_picture, stderr, stdout,
};

const OBJECTS: &str = "object,kind,shape\nplate,plate,circle\n";

fn inspect(path: &Path, more: &[&str]) -> Output {
    run([&["inspect", path.to_str().unwrap()], more].concat())
}

/// Facts of the only session, or of the one with that name.
fn facts(output: &Output, session: Option<&str>) -> Value {
    let document: Value = serde_json::from_str(&stdout(output)).unwrap();
    let sessions = document["sessions"].as_array().unwrap().clone();
    let found = sessions.into_iter().find(|found| session.is_none_or(|name| found["session"] == name)).unwrap();
    found["facts"].clone()
}

fn shot(pitch_deg: f64, range_mm: f64) -> Shot {
    Shot { picture: small_picture(), extension: "jpg", pitch_deg, roll_deg: 0.0, range_mm, marks: None }
}

#[track_caller]
fn assert_near(found: &Value, expected: f64, tolerance: f64) {
    assert!((found.as_f64().unwrap() - expected).abs() <= tolerance, "{found}, expected {expected}");
}

#[test]
fn the_published_bench_fits_80_columns_and_has_its_numbers() {
    let output = inspect(&published_bench(), &[]);
    assert_exit(&output, 0);
    let text = stdout(&output);
    let too_long: Vec<&str> = text.lines().filter(|line| line.chars().count() > 80).collect();
    assert!(too_long.is_empty() && text.contains('█'), "{too_long:#?}");
    assert!(!text.contains('\u{1b}') && text.matches("\n  acceleration  ").count() == 12, "{text}");

    let facts = facts(&inspect(&published_bench(), &["--json"]), Some("bench-35cm-55deg"));
    assert_eq!((&facts["profile"]["name"], &facts["mount_pitch_deg"]), (&"aim2-packets".into(), &21.0.into()));
    let acceleration = &facts["acceleration"];
    assert_near(&acceleration["clock"]["measured_rate_hz"], 127.77, 0.01);
    assert_near(&acceleration["length_median_mg"], 1000.0, 20.0);
    let seconds: u64 =
        acceleration["pitch_deg"]["counts"].as_array().unwrap().iter().map(|n| n.as_u64().unwrap()).sum();
    assert_near(&facts["recorded"]["duration_s"], seconds as f64, 2.0);
    // The axis points 55 degrees down at 580 mm.
    let most = |histogram: &Value| {
        let counts: Vec<u64> = histogram["counts"].as_array().unwrap().iter().map(|n| n.as_u64().unwrap()).collect();
        (0..counts.len()).max_by_key(|bin| counts[*bin]).unwrap()
    };
    assert!([10, 11].contains(&most(&acceleration["pitch_deg"])), "{acceleration}");
    assert_eq!(most(&facts["range"]["range_mm"]), 5);
    assert_eq!(facts["extra"][0]["name"], "optical");
    assert_eq!(facts["images"]["dropped"], serde_json::json!([]));
}

#[test]
fn numbers_of_a_small_session_by_hand() {
    let study = StudyFolder::new(
        "time_zone = \"America/Chicago\"\n[mount]\npitch_offset_deg = 10.0\n",
        OBJECTS,
        &small_camera(),
    );
    study.session("s", &[shot(42.0, 512.0), shot(42.0, 8190.0), Shot { picture: Vec::new(), ..shot(-30.0, 2500.0) }]);
    let output = inspect(study.path(), &["--json"]);
    assert_exit(&output, 0);
    let facts = facts(&output, None);
    // 6 s of samples around each of three images that are 10 s apart: two gaps of 4 s.
    let clock = &facts["acceleration"]["clock"];
    assert_eq!((&clock["samples"], &clock["gaps"]["count"]), (&Value::from(3 * 385), &Value::from(2)));
    assert_near(&clock["gaps"]["total_s"], 8.0, 1e-6);
    assert_near(&clock["measured_rate_hz"], 64.0, 1e-3);
    assert_eq!(clock["recorded"]["from"], "2023-12-31T18:00:07-06:00");
    assert_eq!(clock["gaps"]["longest"][0]["from"], "2023-12-31T18:00:13-06:00");
    assert_near(&facts["recorded"]["duration_s"], 26.0, 1e-9);
    // Mount offset of the study, not of the profile: 52 degrees; the last shot looks up.
    assert_near(&facts["mount_pitch_deg"], 10.0, 1e-9);
    let pitch = &facts["acceleration"]["pitch_deg"];
    assert_eq!((&pitch["counts"][10], &pitch["below"], &pitch["above"]), (&14.into(), &7.into(), &0.into()));
    let range = &facts["range"];
    assert_eq!((&range["range_mm"]["counts"][5], &range["no_target_samples"]), (&385.into(), &385.into()));
    assert_eq!(range["range_mm"]["above"], 385);
    assert_eq!((&facts["images"]["count"], &facts["images"]["median_period_s"]), (&2.into(), &10.0.into()));
    assert_eq!(facts["images"]["dropped"], serde_json::json!([{"reason": "empty_image", "count": 1, "bytes": 0}]));
    assert_eq!(facts["local_time_changes"], serde_json::json!([]));
    let text = stdout(&inspect(study.path(), &[]));
    assert!(text.contains("2 gaps longer than") && text.contains("no target   385 samples"), "{text}");
}

#[test]
fn a_file_of_ingest_is_read_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let mcap = folder.path().join("x.mcap");
    let card = published_bench().join("cards/bench-35cm-55deg");
    let devices = published_bench().join("devices");
    let camera = ["--camera", "bench-camera", "--devices", devices.to_str().unwrap(), "--time-zone", "America/Chicago"];
    let arguments = [&["ingest", card.to_str().unwrap(), "-o", mcap.to_str().unwrap()][..], &camera].concat();
    assert_exit(&run(arguments), 0);
    let output = inspect(&mcap, &["--json"]);
    assert_exit(&output, 0);
    let (file, study) =
        (facts(&output, None), facts(&inspect(&published_bench(), &["--json"]), Some("bench-35cm-55deg")));
    assert_eq!((&file["file"]["is_survey"], &study["file"]["is_survey"]), (&false.into(), &true.into()));
    for key in ["acceleration", "range", "extra", "images", "recorded", "problems"] {
        assert_eq!(file[key], study[key], "{key}");
    }
    // Cut short: a damaged file, not another thing.
    let bytes = std::fs::read(&mcap).unwrap();
    std::fs::write(&mcap, &bytes[..bytes.len() / 2]).unwrap();
    let output = inspect(&mcap, &[]);
    assert_exit(&output, 1);
    assert!(stderr(&output).contains("ends early") && stdout(&output).is_empty(), "{}", stderr(&output));
}

#[test]
fn what_is_no_recording_is_refused_with_what_was_expected() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("x.mcap");
    let refused = |path: &Path, code: i32, fact: &str| {
        let output = inspect(path, &[]);
        assert_exit(&output, code);
        assert!(stderr(&output).contains(fact) && stdout(&output).is_empty(), "{}", stderr(&output));
    };
    refused(&file, 2, "cannot open");
    std::fs::write(&file, "no MCAP file").unwrap();
    refused(&file, 2, "expected an MCAP file or the folder of a study, got neither");
    refused(folder.path(), 2, "there is no study.toml in it");
    std::fs::write(&file, other_mcap()).unwrap();
    refused(&file, 1, "an MCAP file, but not a file of this program");
    assert!(!stderr(&inspect(&file, &[])).contains("delete"));
}

/// The smallest MCAP file: header, data end, footer, with a summary that has nothing in it.
fn other_mcap() -> Vec<u8> {
    let magic = b"\x89MCAP0\r\n";
    let record = |opcode: u8, body: &[u8]| [&[opcode], &(body.len() as u64).to_le_bytes()[..], body].concat();
    let header = record(0x01, &[0; 8]);
    let data_end = record(0x0f, &[0; 4]);
    let summary_start = (magic.len() + header.len() + data_end.len()) as u64;
    let footer = record(0x02, &[&summary_start.to_le_bytes()[..], &[0; 8], &[0; 4]].concat());
    [&magic[..], &header, &data_end, &footer, magic].concat()
}

#[test]
fn a_session_that_cannot_be_used_is_told_and_the_others_shown() {
    let study = StudyFolder::new("", OBJECTS, &small_camera());
    study.session("good", &[shot(55.0, 500.0)]);
    std::fs::create_dir_all(study.path().join("cards/empty")).unwrap();
    let output = inspect(study.path(), &[]);
    assert_exit(&output, 3);
    let text = stdout(&output);
    assert!(text.contains("empty\n  nothing can be used [ingest] card_does_not_fit_profile"), "{text}");
    assert!(text.contains("\ngood\n  profile       csv 1\n"), "{text}");
    std::fs::remove_dir_all(study.path().join("cards/good")).unwrap();
    assert_exit(&inspect(study.path(), &["--json"]), 1);
}

/// A card of one file from a real logger, through the built-in profile.
fn real_facts(set: &str, file: &str, profile: &str) -> Option<Value> {
    let log = real_data(set)?.join(file);
    let folder = tempfile::tempdir().unwrap();
    let (card, mcap) = (folder.path().join("card"), folder.path().join("x.mcap"));
    std::fs::create_dir(&card).unwrap();
    std::fs::copy(log, card.join(file)).unwrap();
    let (card, mcap_text) = (card.to_str().unwrap(), mcap.to_str().unwrap());
    let output = run(["ingest", card, "-o", mcap_text, "--profile", profile]);
    assert_exit(&output, 3); // there is no range sensor, and no camera
    let output = inspect(&mcap, &["--json"]);
    assert_exit(&output, 0);
    println!("{}", stdout(&inspect(&mcap, &[])));
    Some(facts(&output, None))
}

/// A still export of Pupil's glasses whose IMU looks 30 degrees down: the scene camera of Neon looks 12 degrees further down.
fn pupil_facts(profile: &str, header: &str, row: impl Fn(i64, [f64; 3]) -> String, g: [f64; 3]) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let (card, mcap) = (folder.path().join("card"), folder.path().join("x.mcap"));
    std::fs::create_dir(&card).unwrap();
    let rows: String = (0..2200).map(|i| row(1_748_779_200_000_000_000 + i * 9_090_909, g)).collect();
    std::fs::write(card.join("imu.csv"), format!("{header}\n{rows}")).unwrap();
    let output = run(["ingest", card.to_str().unwrap(), "-o", mcap.to_str().unwrap(), "--profile", profile]);
    assert_exit(&output, 3); // there is no range sensor, and no camera
    let output = inspect(&mcap, &["--json"]);
    assert_exit(&output, 0);
    facts(&output, None)
}

#[test]
fn every_export_of_pupil_s_glasses_is_read_and_has_the_camera_s_pitch() {
    let cloud = |gyro: &str, g: &str, rest: &str| {
        let axes = |name: &str, unit: &str| ["x", "y", "z"].map(|axis| format!("{name} {axis} [{unit}]")).join(",");
        format!("section id,recording id,timestamp [ns],{},{},{rest}", axes("gyro", gyro), axes("acceleration", g))
    };
    let of_cloud = |ns: i64, [x, y, z]: [f64; 3]| format!("s,r,{ns},0.1,-0.1,0,{x},{y},{z},0,-30\n");
    let of_native = |ns: i64, [x, y, z]: [f64; 3]| format!("{ns},0.1,-0.1,0,{x},{y},{z}\n");
    let (sin, cos) = 30_f64.to_radians().sin_cos();
    let native = |z: &str| format!("timestamp_ns,gyro_x,gyro_y,gyro_z(deg/s),accel_x,accel_y,{z}");
    let neon = [0.0, -sin, cos]; // x right, y forward, z up
    let neon_exports = [
        pupil_facts("pupil-neon", &cloud("deg/s", "g", "roll [deg],pitch [deg]"), of_cloud, neon),
        pupil_facts("pupil-neon", &cloud("deg/s", "G", "roll,pitch"), of_cloud, neon),
        pupil_facts("pupil-neon", &native("accel_z(g)"), of_native, neon),
        pupil_facts("pupil-neon", &native("accel_z"), of_native, neon),
    ];
    let invisible = [0.0, -cos, -sin]; // x right, y down, z forward
    let invisible = pupil_facts("pupil-invisible", &cloud("deg/s", "G", "roll,pitch"), of_cloud, invisible);
    let seen = neon_exports.iter().map(|facts| (facts, 42)).chain([(&invisible, 30)]);
    for (facts, pitch_deg) in seen {
        assert_eq!(
            (&facts["acceleration"]["clock"]["samples"], facts["extra"].as_array().unwrap().len()),
            (&2200.into(), 3)
        );
        let pitch = &facts["acceleration"]["pitch_deg"];
        let counts: Vec<u64> = pitch["counts"].as_array().unwrap().iter().map(|n| n.as_u64().unwrap()).collect();
        let most = (0..counts.len()).max_by_key(|bin| counts[*bin]).unwrap();
        let from_deg = pitch["from"].as_f64().unwrap() + most as f64 * pitch["bin_width"].as_f64().unwrap();
        assert!((from_deg..from_deg + pitch["bin_width"].as_f64().unwrap()).contains(&f64::from(pitch_deg)), "{pitch}");
    }
}

#[test]
fn real_glasses() {
    let Some(facts) = real_facts("imu_neon_glasses", "demo_recording_ps1.csv", "pupil-neon") else { return };
    let clock = &facts["acceleration"]["clock"];
    assert_eq!(clock["samples"], 969);
    assert_near(&clock["measured_rate_hz"], 104.0, 0.5);
    assert_near(&clock["longest_step_s"], 0.018_68, 0.000_005);
    assert_eq!(facts["extra"].as_array().unwrap().len(), 3);
}

#[test]
fn a_real_logger() {
    let Some(facts) = real_facts("imu_axivity_adxl345", "ax3_testfile.cwa", "axivity-cwa") else { return };
    let clock = &facts["acceleration"]["clock"];
    assert_eq!(clock["samples"], 17_400);
    assert_near(&clock["measured_rate_hz"], 98.86, 0.005);
}

/// A range sensor's log without times: two lines above the name of its column, one hour long.
const TIMELESS: &str = "schema_version = 1\nname = \"tof\"\nversion = \"1\"\nmount_pitch_deg = 0.0\n\
                        [clock]\nanchor = { from = \"session\" }\n\
                        [range]\nfiles = [\"*.csv\"]\nrate_hz = 50.0\nmm_per_count = 1.0\n\
                        [range.csv]\ntime = { rows_over_s = 3600.0 }\nrange = \"d\"\nskip_lines = 2\n";

#[test]
fn a_real_range_sensor() {
    let Some(set) = real_data("tof_vl53l0x") else { return };
    let folder = tempfile::tempdir().unwrap();
    let [card, devices, mcap] = ["card", "devices", "x.mcap"].map(|name| folder.path().join(name));
    std::fs::create_dir(&card).unwrap();
    std::fs::create_dir(&devices).unwrap();
    std::fs::copy(set.join("static_tof_dist_data_1_h.csv"), card.join("tof.csv")).unwrap();
    std::fs::write(devices.join("tof.toml"), TIMELESS).unwrap();
    let [card, devices, mcap_text] = [&card, &devices, &mcap].map(|path| path.to_str().unwrap());
    let output = run([
        "ingest",
        card,
        "-o",
        mcap_text,
        "--profile",
        "tof",
        "--devices",
        devices,
        "--clock-zero",
        "2024-01-01T00:00:00Z",
    ]);
    assert_exit(&output, 3); // there is nothing but a range sensor
    assert!(stderr(&output).contains("55.62 Hz, the device profile says 50 Hz"), "{}", stderr(&output));
    let output = inspect(&mcap, &["--json"]);
    let range = &facts(&output, None)["range"];
    assert_eq!(range["clock"]["samples"], 200_244);
    assert_near(&range["clock"]["measured_rate_hz"], 55.6, 0.05);
    assert_near(&range["mean_mm"], 75.5, 0.05);
    assert_near(&range["sd_mm"], 2.15, 0.005);
    assert_eq!((range["least_mm"].as_f64(), range["greatest_mm"].as_f64()), (Some(65.0), Some(84.0)));
    assert!(range["repeated_samples"].as_u64().unwrap() > 10_000, "{range}");
}

/// The range is the median of the readings that are ranges, whatever a driver writes for those that are none.
#[test]
fn readings_without_a_target_are_no_loss() {
    for none in ["None", "65535", "-1", "8191", "inf"] {
        let study = StudyFolder::new("", OBJECTS, &small_camera());
        study.session("s", &[shot(55.0, 512.0)]);
        let path = study.path().join("cards/s/range.csv");
        let text = std::fs::read_to_string(&path).unwrap();
        let other = |(i, line): (usize, &str)| match i % 3 {
            1 => format!("{},{none}\n", line.split(',').next().unwrap()),
            _ => format!("{line}\n"),
        };
        std::fs::write(&path, text.lines().enumerate().map(other).collect::<String>()).unwrap();
        let out = study.path().join("out/results.parquet");
        let output = run(["run", study.path().to_str().unwrap(), "--out", out.to_str().unwrap()]);
        assert_exit(&output, 0);
        let frames = report::read_frames(&out.with_file_name("frames.parquet")).unwrap();
        assert_eq!(frames[0].range_mm, Some(512.0), "{none}");
    }
}
