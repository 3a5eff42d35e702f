//! Clocks.

use model::FrameReason::{AmbiguousTime, NoAcceleration, Selected};

use super::study::{DamagedStudy, IMAGES, stem};

const ACC: &str = "S/ACC0.BIN";
const RNG: &str = "S/RNG0.BIN";

#[test]
fn set_back_while_recording() {
    let study = DamagedStudy::new();
    for file in [ACC, RNG] {
        study.corrupt(file, |file| file.shift_clock(35, -22.0));
    }
    let told = study.run();
    assert_eq!(told.exit, 3);
    assert!(told.losses().contains(&"ambiguous_time"), "{:?}", told.losses());
    assert!(told.notes().contains(&"clock_set"), "{:?}", told.notes());
    assert!(told.fact("clock_set").contains("by -22.0 s"), "{}", told.fact("clock_set"));
    // The clock shows 13 s to 35 s twice, and nothing after 38 s.
    assert_eq!(told.reasons, [Selected, AmbiguousTime, AmbiguousTime, NoAcceleration, NoAcceleration]);
    assert!(told.frames[1].pitch_deg.is_none());
}

#[test]
fn set_forward_while_recording_is_no_gap_where_packets_are_numbered() {
    let study = DamagedStudy::new();
    study.corrupt(ACC, |file| file.shift_clock(45, 3600.0));
    let told = study.run();
    assert_eq!(told.notes(), ["clock_set"]);
    assert!(told.fact("clock_set").contains("by +3600.0 s"), "{}", told.fact("clock_set"));
    assert_eq!(told.reasons, [Selected, Selected, Selected, Selected, NoAcceleration]);
}

/// One damaged stamp must not make the rest of the session ambiguous.
#[test]
fn wrong_for_one_packet() {
    for (seconds, code) in
        [(86_400.0 * 3.0, "bad_stamp"), (3600.0, "misplaced_packets"), (-3600.0, "misplaced_packets")]
    {
        let study = DamagedStudy::new();
        study.corrupt(ACC, |file| file.shift_clock(35, seconds).shift_clock(36, -seconds));
        let told = study.run();
        assert_eq!((told.exit, told.losses()), (3, vec![code]), "{seconds} s");
        assert_eq!(told.reasons, [Selected; IMAGES], "{seconds} s");
    }
}

#[test]
fn never_set() {
    // Sensors count from 1970; the images' names say 2024.
    let study = DamagedStudy::new();
    for file in [ACC, RNG] {
        study.corrupt(file, |file| file.shift_clock(0, -1_704_067_200.0 + 5.0));
    }
    let told = study.run();
    assert_eq!(told.exit, 3);
    assert!(told.losses().contains(&"no_image_with_pose"));
    assert_eq!(told.reasons, [NoAcceleration; IMAGES]);
    assert!(told.losses().contains(&"no_common_time"), "{:?}", told.losses());
    let fact = told.fact("no_common_time");
    assert!(fact.contains("accelerometer 1970-01-01") && fact.contains("another epoch"), "{fact}");
}

#[test]
fn a_wrong_zone_is_told_with_both_spans_and_the_hours_between() {
    let study = DamagedStudy::new();
    for file in [ACC, RNG] {
        study.corrupt(file, |file| file.shift_clock(0, -7.0 * 3600.0));
    }
    let told = study.run();
    assert_eq!(told.exit, 3);
    let fact = told.fact("no_common_time");
    assert!(fact.starts_with("images 2024-01-01 00:00:") && fact.contains("accelerometer 2023-12-31 17:00:"), "{fact}");
    assert!(fact.contains("7 h apart") && fact.contains("two zones"), "{fact}");
}

#[test]
fn local_time_with_and_without_the_declaration() {
    // A device that writes Chicago's wall-clock time, in winter six hours behind UTC.
    let study = DamagedStudy::new();
    for file in [ACC, RNG] {
        study.corrupt(file, |file| file.shift_clock(0, -6.0 * 3600.0));
    }
    assert_eq!(study.run().reasons, [NoAcceleration; IMAGES], "read as UTC it fits no image");
    let text = std::fs::read_to_string(study.folder.path().join("devices/unit.toml")).unwrap();
    let local = text.replace("endian =", "stamp = { epoch = \"local\" }\nendian =");
    study.folder.write("devices/local.toml", local);
    study.edit("study.toml", "device_profile = \"unit\"", "device_profile = \"local\"");
    study.edit("study.toml", "schema_version = 1", "schema_version = 1\ntime_zone = \"America/Chicago\"");
    let output = crate::support::run([
        "run",
        study.folder.path().to_str().unwrap(),
        "--out",
        study.folder.path().join("local/results.parquet").to_str().unwrap(),
    ]);
    assert_eq!(output.status.code(), Some(3), "the other session's stamps are UTC, and fit no longer");
    let frames = report::read_frames(&study.folder.path().join("local/frames.parquet")).unwrap();
    let of_bad: Vec<_> = frames.iter().filter(|f| f.session == "bad").map(|f| f.reason).collect();
    assert_eq!(of_bad, [Selected; IMAGES]);
}

#[test]
fn counting_from_the_start_of_the_device_with_an_anchor() {
    let study = DamagedStudy::new();
    for file in [ACC, RNG] {
        study.corrupt(file, |file| file.shift_clock(0, -1_704_067_200.0));
    }
    let text = std::fs::read_to_string(study.folder.path().join("devices/unit.toml")).unwrap();
    let boot = text
        .replace("endian =", "stamp = { epoch = \"boot\" }\nendian =")
        .replace("[acceleration]\n", "[clock]\nanchor = { from = \"session\" }\n\n[acceleration]\n");
    study.folder.write("devices/boot.toml", boot);
    study.edit("study.toml", "device_profile = \"unit\"", "device_profile = \"boot\"");
    let out = study.folder.path().join("boot/results.parquet");
    let run = || {
        let output =
            crate::support::run(["run", study.folder.path().to_str().unwrap(), "--out", out.to_str().unwrap()]);
        let frames = report::read_frames(&out.with_file_name("frames.parquet")).unwrap();
        let reasons: Vec<_> = frames.iter().filter(|f| f.session == "bad").map(|f| f.reason).collect();
        (crate::support::stderr(&output), reasons)
    };
    let (said, reasons) = run();
    assert!(said.contains("samples_without_time") && said.contains("nothing says when that was"), "{said}");
    assert_eq!(reasons, [NoAcceleration; IMAGES]);
    study.write("session.toml", "clock_zero_utc = \"2024-01-01T00:00:00Z\"\n");
    assert_eq!(run().1, [Selected; IMAGES]);
}

#[test]
fn two_recordings_on_one_card() {
    let study = DamagedStudy::new();
    study.write("I/20240102T000010Z.jpg", super::study::picture(9));
    let told = study.run();
    assert_eq!(told.notes(), ["two_recordings"]);
    assert_eq!(told.reasons.len(), IMAGES + 1);
    assert_eq!(told.reasons[IMAGES], NoAcceleration);
    assert!(told.frames[0].image.contains(&stem(10)));
}
