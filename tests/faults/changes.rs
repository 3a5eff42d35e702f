//! A run does again only what has changed since the run before.

use std::fs::{File, FileTimes};

use super::Bench;
use super::bench::flip_byte;
use crate::support::{assert_exit, stderr, stdout};

const ALL: u64 = Bench::SESSIONS as u64;

/// Files of a study that was just made may change unseen within the step of a file system's clock.
fn settle() {
    std::thread::sleep(std::time::Duration::from_millis(2_100));
}

#[test]
fn a_second_run_does_nothing_and_says_so() {
    let bench = Bench::new();
    settle();
    let first = bench.run();
    assert_exit(&first, 0);
    let files = bench.files();
    let written = std::fs::metadata(bench.out()).unwrap().modified().unwrap();
    let run_json = std::fs::read(bench.out().with_file_name("run.json")).unwrap();
    let second = bench.run();
    assert_exit(&second, 0);
    let said = stderr(&second);
    assert!(said.contains("nothing to do") && said.contains("ingest kept, signals kept, measure kept"), "{said}");
    assert_eq!(stdout(&second), stdout(&first), "the same tables");
    assert_eq!(bench.files(), files);
    assert_eq!(std::fs::metadata(bench.out()).unwrap().modified().unwrap(), written);
    assert_eq!(std::fs::read(bench.out().with_file_name("run.json")).unwrap(), run_json);
}

#[test]
fn a_changed_threshold_selects_again_and_reads_no_sample() {
    let bench = Bench::new();
    bench.run_well();
    bench.edit("study.toml", |text| format!("{text}\n[select]\npitch_tolerance_deg = 3.0\n"));
    assert_eq!(bench.run_well(), bench.undisturbed());
    assert_eq!(bench.done(), [0, 0, ALL]);
    assert_exit(&bench.run_with(&["--target-pitch", "40"]), 0);
    assert_eq!(bench.done(), [0, 0, ALL], "likewise on the command line");
}

#[test]
fn a_changed_filter_reads_samples_and_no_card() {
    let bench = Bench::new();
    bench.run_well();
    bench.edit("study.toml", |text| format!("{text}\n[signals]\ngravity_cutoff_hz = 0.5\n"));
    assert_eq!(bench.run_well(), bench.undisturbed());
    assert_eq!(bench.done(), [0, ALL, ALL]);
}

#[test]
fn a_changed_camera_measures_again_and_reads_no_card() {
    let bench = Bench::new();
    settle();
    bench.run_well();
    let camera = std::fs::read_dir(bench.study().join("devices")).unwrap().next().unwrap().unwrap().file_name();
    let camera = format!("devices/{}", camera.to_str().unwrap());
    bench.edit(&camera, |text| text.replacen("focal_mm = 2.4", "focal_mm = 2.41", 1));
    assert_eq!(bench.run_well(), bench.undisturbed());
    assert_eq!(bench.done(), [0, 0, ALL]);
    let said = bench.status(&[]);
    assert!(said.contains("6 recordings have the calibration of an earlier camera"), "{said}");
    assert_exit(&bench.run_with(&["--force"]), 0);
    assert!(!bench.status(&[]).contains("earlier camera"));
}

#[test]
fn changed_marks_objects_and_session_files_measure_again_what_they_concern() {
    let bench = Bench::new();
    bench.run_well();
    let marks = std::fs::read_dir(bench.study().join("marks/R1/S00002")).unwrap().next().unwrap().unwrap().path();
    std::fs::remove_file(marks).unwrap();
    assert_eq!(bench.run_well(), bench.undisturbed());
    assert_eq!(bench.done(), [0, 0, 1]);
    bench.edit("cards/S00003/session.toml", |text| text.replacen("participant = \"", "participant = \"x", 1));
    assert_eq!(bench.run_well(), bench.undisturbed());
    assert_eq!(bench.done(), [0, 0, 1]);
    bench.edit("objects.csv", |text| text.replacen("circle,2", "circle,3", 1));
    assert_eq!(bench.run_well(), bench.undisturbed());
    assert_eq!(bench.done(), [0, 0, ALL]);
}

#[test]
fn a_changed_picture_is_seen_even_with_its_old_size_and_time() {
    let bench = Bench::new();
    settle();
    bench.run_well();
    let picture = bench.card_file("S00004", "IMAGES");
    let time = std::fs::metadata(&picture).unwrap().modified().unwrap();
    let mut bytes = std::fs::read(&picture).unwrap();
    let last = bytes.len() - 20;
    bytes[last] ^= 0x01; // within the compressed data
    std::fs::write(&picture, bytes).unwrap();
    File::options().write(true).open(&picture).unwrap().set_times(FileTimes::new().set_modified(time)).unwrap();
    let output = bench.run();
    assert!([Some(0), Some(3)].contains(&output.status.code()), "{}", stderr(&output));
    assert_eq!(bench.files(), bench.undisturbed());
    assert_eq!(bench.done()[0], 1);
}

#[test]
fn a_file_that_nobody_reads_is_told_of_when_it_comes_and_not_when_it_went() {
    let bench = Bench::new();
    settle();
    let before = bench.run_well();
    let extra = bench.study().join("cards/S00002/notes.bin");
    std::fs::write(&extra, b"something").unwrap();
    let with = bench.run_well();
    assert_ne!(with, before, "a note more");
    assert_eq!(with, bench.undisturbed());
    std::fs::remove_file(extra).unwrap();
    assert_eq!(bench.run_well(), before);
}

#[cfg(unix)]
#[test]
fn pipes_among_cards_and_marks_are_told_and_not_waited_for() {
    let bench = Bench::new();
    settle();
    let before = bench.run_well();
    let pipes = ["cards/S00002/IMAGES/pipe.jpg", "marks/R1/S00003/pipe.json"].map(|place| bench.study().join(place));
    for pipe in &pipes {
        assert!(std::process::Command::new("mkfifo").arg(pipe).status().unwrap().success());
    }
    assert_exit(&bench.run(), 3);
    let losses = bench.losses();
    let expected = [("S00002", "not_a_file"), ("S00003", "marks_unreadable")];
    assert_eq!(losses, expected.map(|(session, code)| (session.to_owned(), vec![code.to_owned()])));
    assert_eq!(bench.files(), bench.undisturbed());
    pipes.iter().for_each(|pipe| std::fs::remove_file(pipe).unwrap());
    assert_eq!(bench.run_well(), before);
}

#[cfg(unix)]
#[test]
fn a_link_to_a_disk_that_is_not_there_is_a_session_that_failed() {
    let bench = Bench::new();
    let card = bench.study().join("cards/S00003");
    std::fs::remove_dir_all(&card).unwrap();
    std::fs::remove_dir_all(bench.study().join("marks/R1/S00003")).unwrap();
    std::os::unix::fs::symlink("/no/such/disk", card).unwrap();
    assert_exit(&bench.run(), 3);
    assert_eq!(bench.losses(), [("S00003".to_owned(), vec!["missing_card".to_owned()])]);
}

#[cfg(target_os = "linux")]
#[test]
fn odd_names_of_sessions_stay_apart_and_one_too_long_concerns_itself_only() {
    use std::os::unix::ffi::OsStrExt as _;
    let bench = Bench::new();
    let cards = bench.study().join("cards");
    for (card, name) in [("S00004", &b"X\xff"[..]), ("S00005", b"X\xfe"), ("S00006", &[b'N'; 253])] {
        std::fs::rename(cards.join(card), cards.join(std::ffi::OsStr::from_bytes(name))).unwrap();
        std::fs::remove_dir_all(bench.study().join("marks/R1").join(card)).unwrap();
    }
    assert_exit(&bench.run(), 3);
    let long = "N".repeat(253);
    let names: Vec<String> = bench.statuses().into_iter().map(|status| status.session).collect();
    assert_eq!(names, [long.as_str(), "S00001", "S00002", "S00003", "X\\xfe", "X\\xff"]);
    assert_eq!(bench.losses(), [(long, vec!["mcap_not_written".to_owned()])]);
}

#[test]
fn files_that_were_only_touched_change_nothing() {
    let bench = Bench::new();
    settle();
    let before = bench.run_well();
    let now = FileTimes::new().set_modified(std::time::SystemTime::now());
    File::options().write(true).open(bench.card_file("S00004", "IMAGES")).unwrap().set_times(now).unwrap();
    let output = bench.run();
    assert_exit(&output, 0);
    assert!(stderr(&output).contains("nothing to do"), "{}", stderr(&output));
    assert_eq!(bench.files(), before);
}

#[test]
fn a_card_that_is_damaged_between_two_runs_is_told_and_mended_when_it_is_copied_again() {
    let bench = Bench::new();
    let whole = bench.run_well();
    let sensor = bench.card_file("S00005", "SENSORS");
    let kept = std::fs::read(&sensor).unwrap();
    std::fs::write(&sensor, &kept[..kept.len() / 3]).unwrap();
    assert_exit(&bench.run(), 3);
    assert_eq!(bench.losses().iter().map(|(session, _)| session.as_str()).collect::<Vec<_>>(), ["S00005"]);
    assert_eq!(bench.files(), bench.undisturbed());
    std::fs::write(&sensor, kept).unwrap();
    assert_eq!(bench.run_well(), whole);
}

#[test]
fn a_clock_set_back_between_two_runs_concerns_its_session_only() {
    let bench = Bench::new();
    bench.run_well();
    let sensor = bench.card_file("S00002", "SENSORS");
    let mut bytes = std::fs::read(&sensor).unwrap();
    let packet = 8 + 4 * 2 * 1022; // a stamp, and four channels of int16
    let middle = bytes.len() / packet / 2;
    for packet in bytes.chunks_exact_mut(packet).skip(middle) {
        let stamp = f64::from_le_bytes(*packet.first_chunk().unwrap()) - 30.0;
        packet[..8].copy_from_slice(&stamp.to_le_bytes());
    }
    std::fs::write(&sensor, bytes).unwrap();
    assert_exit(&bench.run(), 3);
    let losses = bench.losses();
    assert_eq!(losses.len(), 1, "{losses:?}");
    assert_eq!(losses[0].0, "S00002");
    assert_eq!(bench.files(), bench.undisturbed());
    assert_eq!(bench.done()[0], 1);
}

#[test]
fn a_removed_session_disappears_and_comes_back_without_being_read() {
    let bench = Bench::new();
    settle();
    let all = bench.run_well();
    let (card, away) = (bench.study().join("cards/S00003"), bench.path("card"));
    let (marks, marks_away) = (bench.study().join("marks/R1/S00003"), bench.path("marks"));
    std::fs::rename(&card, &away).unwrap();
    std::fs::rename(&marks, &marks_away).unwrap();
    assert_eq!(bench.run_well(), bench.undisturbed());
    assert!(bench.statuses().iter().all(|status| status.session != "S00003"));
    let state =
        crate::support::run(["status".as_ref(), bench.study().as_os_str(), "--out".as_ref(), bench.out().as_os_str()]);
    assert!(stdout(&state).contains("no longer in the study: S00003"), "{}", stdout(&state));
    std::fs::rename(&away, &card).unwrap();
    std::fs::rename(&marks_away, &marks).unwrap();
    assert_eq!(bench.run_well(), all);
    assert_eq!(bench.done()[1], 0, "its recording and readings were kept");
    std::fs::remove_dir_all(card).unwrap();
    std::fs::remove_dir_all(marks).unwrap();
    assert_exit(&bench.run_with(&["--prune"]), 0);
    assert!(!bench.mcap("S00003").exists() && bench.mcap("S00002").exists());
}

#[test]
fn force_does_everything_again() {
    let bench = Bench::new();
    let before = bench.run_well();
    assert_exit(&bench.run_with(&["--force"]), 0);
    assert_eq!(bench.files(), before);
    bench.edit("study.toml", |text| format!("{text}\n[select]\npitch_tolerance_deg = 3.0\n"));
    assert_exit(&bench.run_with(&["--force"]), 0);
    assert_eq!(bench.done(), [ALL, ALL, ALL]);
}

#[test]
fn status_tells_what_a_run_would_do() {
    let bench = Bench::new();
    settle();
    assert!(
        bench.status(&[]).contains("(none yet)")
            && bench.status(&[]).contains("6 sessions: 0 up to date, 6 to do (6 to ingest, ")
    );
    bench.run_well();
    assert!(bench.status(&[]).contains("6 sessions: 6 up to date, 0 to do (0 to ingest, 0 B"), "{}", bench.status(&[]));
    flip_byte(&bench.card_file("S00001", "IMAGES"));
    bench.edit("cards/S00002/session.toml", |text| text.replacen("participant = \"", "participant = \"x", 1));
    let said = bench.status(&[]);
    assert!(said.contains("4 up to date, 2 to do (1 to ingest, "), "{said}");
    assert!(said.contains("S00001  to do: ingest ("), "{said}");
    assert!(said.contains("S00002  to do: measure; "), "{said}");
    let json: serde_json::Value = serde_json::from_str(&bench.status(&["--json"])).unwrap();
    assert_eq!(json["sessions"][1]["measure_is_current"], false);
    assert_eq!(json["sessions"][1]["ingest_is_current"], true);
    assert_eq!(json["sessions"][2]["status"]["images"], 6);
}
