//! Cards as they are when something went wrong: what can be used is used, what is lost is said.

use aim_batch_ingest::{DroppedImage, IngestError, NoProgress, ingest_session};
use model::{FrameReason, UtcNs};

use crate::support::{NOON_S, Study, acceleration_packet, jpeg, range_packet, samples};

const NOON: f64 = NOON_S as f64;

fn sensors(study: &Study) {
    study.write("SENSORS/ACC.BIN", &acceleration_packet(NOON));
    study.write("SENSORS/RNG.BIN", &range_packet(NOON, 400));
}

#[test]
fn images_that_cannot_be_used_are_listed_with_their_reason() {
    let study = Study::new("aim2-packets");
    sensors(&study);
    let good = jpeg(32, 24, 9);
    study.write("IMAGES/20250601T120000Z.JPG", &good);
    study.write("IMAGES/20250601T120001Z.JPG", b"");
    study.write("IMAGES/20250601T120002Z.JPG", b"GIF89a....");
    study.write("IMAGES/20250601T120003Z.JPG", &good[..12]);
    study.write("IMAGES/20250601T120004Z.JPG", &jpeg(24, 32, 9));
    study.write("IMAGES/DSC1.JPG", &good);
    let (summary, mut reader) = study.ingest();
    assert_eq!(summary.images, 1);
    assert_eq!(reader.images().unwrap().len(), 1);
    assert_eq!(reader.metadata().dropped_images, summary.dropped_images);
    let second = |s: i64| Some(UtcNs((NOON_S + s) * 1_000_000_000));
    let facts: Vec<_> = summary.dropped_images.iter().map(|d| (d.reason, d.time, d.width_px, d.height_px)).collect();
    assert_eq!(
        facts,
        [
            (FrameReason::EmptyImage, second(1), None, None),
            (FrameReason::NotAnImage, second(2), None, None),
            (FrameReason::NotAnImage, second(3), None, None),
            (FrameReason::WrongSize, second(4), Some(24), Some(32)),
            (FrameReason::NoTime, None, Some(32), Some(24)),
        ]
    );
    let DroppedImage { detail, bytes, .. } = &summary.dropped_images[3];
    assert_eq!(detail, "camera 'small' takes 32 x 24 px, this one is 24 x 32 px");
    assert!(*bytes > 0);
    let codes: Vec<_> = summary.problems.iter().map(|p| (p.code.code(), p.place.as_str())).collect();
    assert_eq!(
        codes,
        [
            ("empty_image", "cards/P01/IMAGES/20250601T120001Z.JPG"),
            ("not_an_image", "cards/P01/IMAGES/20250601T120002Z.JPG"),
            ("wrong_size", "cards/P01/IMAGES/20250601T120004Z.JPG"),
            ("no_time", "cards/P01/IMAGES/DSC1.JPG"),
        ]
    );
    let fact = &summary.problems[1].fact;
    assert!(fact.starts_with("2 images (22 bytes) cannot be used; first: begins with 47 49 46 38"), "{fact}");
    assert_eq!(summary.problems[0].fact, "1 image (0 bytes) cannot be used; 0 bytes");
    assert_eq!(summary.files, 8, "dropped images are inputs too");
}

#[test]
fn of_a_truncated_sensor_file_all_whole_samples_are_used() {
    let study = Study::new("aim2-packets");
    sensors(&study);
    let two = [acceleration_packet(NOON), acceleration_packet(NOON + 8.0)].concat();
    study.write("SENSORS/ACC.BIN", &two[..two.len() - 2044 - 100]); // without the optical sensor, and 50 samples of z
    let (summary, mut reader) = study.ingest();
    assert_eq!(summary.counts.acceleration, 1022 + 972);
    assert_eq!(samples(&mut reader).len(), 1022 + 972 + 1022);
    let problem = &summary.problems[0];
    assert_eq!((problem.code.code(), problem.place.as_str()), ("truncated_packet", "cards/P01/SENSORS/ACC.BIN"));
    assert!(
        problem.fact.contains("inside the packet at byte 8184: expected 8184 bytes, got 6040, of which 972 samples"),
        "{}",
        problem.fact
    );
    assert!(!problem.remedy.is_empty());
}

#[test]
fn missing_files_are_said_and_the_rest_is_used() {
    let study = Study::new("aim2-packets");
    study.write("IMAGES/20250601T120000Z.JPG", &jpeg(32, 24, 9));
    study.write("SENSORS/acc.bin", &acceleration_packet(NOON));
    study.write("SENSORS/RNG.BIN", b"");
    let expected = [
        ("no_files", "cards/P01"),
        ("no_samples", "cards/P01/SENSORS/RNG.BIN"),
        ("unread_files", "cards/P01/SENSORS/acc.bin"),
    ];
    assert_eq!(study.problems(), expected.map(|(code, place)| (code.to_owned(), place.to_owned())));
}

#[test]
fn a_csv_without_its_columns_is_said_and_the_rest_is_used() {
    let study = Study::new("csv");
    study.write("accel.csv", b"time_s,x,y,z\n1,0,-1,0\n");
    study.write("range.csv", b"time_s,range_mm\n1,500\n");
    let (summary, mut reader) = study.ingest();
    assert_eq!(samples(&mut reader).len(), 1);
    let fact = &summary.problems[0].fact;
    assert_eq!(fact, "the first line has no column 'x_g'; it has: time_s, x, y, z");
}

#[test]
fn no_card_and_a_card_that_does_not_fit_are_errors_that_leave_no_file() {
    let mut study = Study::new("aim2-packets");
    study.write("DCIM/1.RAW", b"?");
    let error = ingest_session(&study.source, &study.out(), &NoProgress).unwrap_err();
    assert!(matches!(error, IngestError::NothingFits { files: 1, .. }), "{error}");
    assert!(error.to_string().contains("SENSORS/ACC*.BIN"), "{error}");
    assert_eq!(std::fs::read_dir(study.out().parent().unwrap()).unwrap().count(), 0);

    study.source.card_dir.push("nowhere");
    let error = ingest_session(&study.source, &study.out(), &NoProgress).unwrap_err();
    assert!(matches!(error, IngestError::NoCard { .. }), "{error}");
    assert!(error.to_string().contains("session 'P01': no SD card in"), "{error}");
}

#[cfg(unix)]
#[test]
fn links_are_followed_within_the_card_only() {
    use std::os::unix::fs::symlink;
    let study = Study::new("aim2-packets");
    sensors(&study);
    let outside = study.dir.path().join("outside");
    std::fs::create_dir(&outside).unwrap();
    std::fs::write(outside.join("20250601T120001Z.JPG"), jpeg(32, 24, 9)).unwrap();
    study.write("IMAGES/20250601T120000Z.JPG", &jpeg(32, 24, 9));
    let images = study.source.card_dir.join("IMAGES");
    symlink(outside.join("20250601T120001Z.JPG"), images.join("20250601T120001Z.JPG")).unwrap();
    symlink("20250601T120000Z.JPG", images.join("20250601T120002Z.JPG")).unwrap();
    symlink("nowhere", images.join("20250601T120003Z.JPG")).unwrap();
    symlink(&outside, study.source.card_dir.join("MORE")).unwrap();
    symlink("..", images.join("loop")).unwrap();
    let (summary, _) = study.ingest();
    assert_eq!(summary.images, 2, "the image and the link to it");
    let mut problems = study.problems();
    problems.sort();
    let expected = [
        ("link_leaves_card", "cards/P01/IMAGES/20250601T120001Z.JPG"),
        ("link_leaves_card", "cards/P01/MORE"),
        ("unreadable_file", "cards/P01/IMAGES/20250601T120003Z.JPG"),
        ("unreadable_file", "cards/P01/IMAGES/loop"),
    ];
    assert_eq!(problems, expected.map(|(code, place)| (code.to_owned(), place.to_owned())));
}

#[test]
fn an_output_that_cannot_be_written_says_so() {
    let study = Study::new("aim2-packets");
    sensors(&study);
    std::fs::write(study.dir.path().join("out"), b"a file where a folder should be").unwrap();
    let error = ingest_session(&study.source, &study.out(), &NoProgress).unwrap_err();
    assert!(matches!(error, IngestError::Write { .. }), "{error}");
}
