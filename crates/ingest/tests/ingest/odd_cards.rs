//! Odd names and odd files on a card: used where they can be, said where they are not.

use model::{Problem, Severity};

use crate::support::{NOON_S, Study, acceleration_packet, jpeg, png, range_packet};

/// A card of the profile aim2-packets with one picture; nothing is wrong with it.
fn card() -> Study {
    let study = Study::new("aim2-packets");
    study.write("SENSORS/ACC.BIN", &acceleration_packet(NOON_S as f64));
    study.write("SENSORS/RNG.BIN", &range_packet(NOON_S as f64, 400));
    study.write("IMAGES/20250601T120000Z.JPG", &jpeg(32, 24, 9));
    study.write("session.toml", b"participant = \"P01\"");
    study
}

/// The one problem of a card, and how many images were used.
fn only_problem(study: &Study) -> (Problem, u64) {
    let (summary, _) = study.ingest();
    let [problem] = &summary.problems[..] else { panic!("{:?}", summary.problems) };
    (problem.clone(), summary.images)
}

#[test]
fn what_systems_lay_beside_the_data_is_passed_over() {
    let study = card();
    for name in [
        ".DS_Store",
        "Thumbs.db",
        "IMAGES/._20250601T120000Z.JPG",
        "System Volume Information/IndexerVolumeGuid",
        "$RECYCLE.BIN/$R1.JPG",
        ".Trashes/501/20250601T120001Z.JPG",
    ] {
        study.write(name, b"\0\x05\x16\x07");
    }
    let (summary, _) = study.ingest();
    assert_eq!((summary.images, summary.problems), (1, vec![]));
}

#[test]
fn files_that_no_pattern_fits_are_counted() {
    let study = card();
    for i in 0..5 {
        study.write(&format!("LOGS/{i}.TXT"), &[b'a'; 300]);
    }
    let (problem, images) = only_problem(&study);
    assert_eq!((problem.code.code(), problem.severity, images), ("unread_files", Severity::Note, 1));
    assert_eq!(problem.place, "cards/P01");
    let expected =
        "5 files (1.5 kB) fit no pattern of the profile and stay unread: LOGS/0.TXT, LOGS/1.TXT, LOGS/2.TXT, ...";
    assert_eq!(problem.fact, expected);
    assert!(problem.remedy.starts_with("if they are recordings,"), "{}", problem.remedy);
}

#[test]
fn pictures_and_sensor_files_with_another_extension_are_named_in_the_remedy() {
    let study = card();
    study.write("SENSORS/acc1.bin", b"?");
    study.write("IMAGES/20250601T120001Z.jpeg", &jpeg(32, 24, 9));
    study.write("IMAGES/20250601T120002Z.PNG", &png(32, 24));
    study.write("IMAGES/20250601T120003Z.DAT", &jpeg(32, 24, 9));
    study.write("IMAGES/20250601T120004Z.TMP", b"no picture");
    let (problem, _) = only_problem(&study);
    assert_eq!(
        problem.remedy,
        "add patterns to the device profile, or rename the files: \
         2 with another extension of pictures than the patterns (IMAGES/20250601T120001Z.jpeg); \
         1 with the first bytes of a JPEG or PNG picture (IMAGES/20250601T120003Z.DAT); \
         1 with only upper and lower case unlike a pattern (SENSORS/acc1.bin)"
    );
}

#[cfg(target_os = "linux")]
mod linux {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    use std::os::unix::net::UnixListener;

    use super::*;

    fn write(study: &Study, name: &[u8], bytes: &[u8]) {
        std::fs::write(study.source.card_dir.join(OsStr::from_bytes(name)), bytes).unwrap();
    }

    #[test]
    fn a_name_that_is_not_utf8_is_used_with_its_bytes_escaped() {
        let study = card();
        // The time of the profile stands in the name alone, so these have none; what counts is that they are told apart.
        for (name, shade) in [(&b"IMAGES/\xff.JPG"[..], 1), (b"IMAGES/\\xff.JPG", 2), (b"IMAGES/\xc3\xa9\x0a.JPG", 3)] {
            write(&study, name, &jpeg(32, 24, shade));
        }
        let (summary, reader) = study.ingest();
        let note = &summary.problems[0];
        assert_eq!((note.code.code(), note.severity), ("name_not_utf8", Severity::Note));
        assert_eq!(note.place, "cards/P01/IMAGES/\\xff.JPG");
        let names: Vec<&str> = reader.metadata().inputs_sha256.keys().map(String::as_str).take(4).collect();
        let expected =
            ["IMAGES/20250601T120000Z.JPG", "IMAGES/\\\\xff.JPG", "IMAGES/\\xff.JPG", "IMAGES/\u{e9}\\x0a.JPG"];
        assert_eq!(names, expected);
    }

    #[test]
    fn a_picture_in_a_folder_whose_name_is_not_utf8_comes_back() {
        let mut study = card();
        study.source.profile.images.as_mut().unwrap().files = vec!["IMAGES/*.JPG".to_owned(), "B*/*.JPG".to_owned()];
        std::fs::create_dir(study.source.card_dir.join(OsStr::from_bytes(b"B\xfc"))).unwrap();
        write(&study, b"B\xfc/20250601T120005Z.JPG", &jpeg(32, 24, 77));
        let (summary, mut reader) = study.ingest();
        assert_eq!((summary.images, summary.problems.len()), (2, 1));
        assert_eq!(reader.image_bytes("B\\xfc/20250601T120005Z.JPG").unwrap(), jpeg(32, 24, 77));
    }

    #[test]
    fn names_that_differ_only_in_case_are_both_used() {
        let study = card();
        study.write("IMAGES/20250601T120000Z.jpg", &jpeg(32, 24, 50));
        let (problem, images) = only_problem(&study);
        assert_eq!((problem.code.code(), problem.severity, images), ("names_differ_in_case", Severity::Note, 2));
        assert!(problem.fact.contains("IMAGES/20250601T120000Z.JPG, IMAGES/20250601T120000Z.jpg; all are used"));
    }

    #[test]
    fn a_socket_is_not_opened() {
        let study = card();
        let _other = UnixListener::bind(study.source.card_dir.join("a.socket")).unwrap();
        let (problem, images) = only_problem(&study);
        assert_eq!((problem.code.code(), problem.severity, images), ("not_a_file", Severity::Note, 1));
        let _picture = UnixListener::bind(study.source.card_dir.join("IMAGES/20250601T120001Z.JPG")).unwrap();
        let (summary, _) = study.ingest();
        assert_eq!(summary.problems[0].place, "cards/P01/IMAGES/20250601T120001Z.JPG");
        assert_eq!(summary.problems[0].severity, Severity::Loss, "the profile asks for a file of that name");
    }
}
