//! Damaged pictures on a card: said with their facts; the others and their bytes stay as they are.

use aim_batch_ingest::{IngestSummary, NoProgress, Profile, SessionReader, ingest_session};
use model::{FrameReason, Problem, Severity};

use crate::support::{NOON_S, Study, acceleration_packet, jpeg_with_exif, noisy_jpeg, png, range_packet};

const SECOND: &str = "IMAGES/20250601T120001Z.JPG";

/// A card with three pictures, the second of which is `second`.
fn card(second: &[u8]) -> Study {
    let mut study = Study::new("aim2-packets");
    study.source.camera_spec.width_px = 128;
    study.source.camera_spec.height_px = 96;
    study.write("SENSORS/ACC.BIN", &acceleration_packet(NOON_S as f64));
    study.write("SENSORS/RNG.BIN", &range_packet(NOON_S as f64, 400));
    study.write("IMAGES/20250601T120000Z.JPG", &noisy_jpeg(128, 96));
    study.write(SECOND, second);
    study.write("IMAGES/20250601T120002Z.JPG", &noisy_jpeg(128, 96));
    study
}

fn assert_others_unchanged(reader: &mut SessionReader) {
    for name in ["IMAGES/20250601T120000Z.JPG", "IMAGES/20250601T120002Z.JPG"] {
        assert_eq!(reader.image_bytes(name).unwrap(), noisy_jpeg(128, 96), "{name}");
    }
}

/// The one problem of a card whose second picture cannot be used.
fn only_loss(second: &[u8], reason: FrameReason) -> Problem {
    let (summary, mut reader) = card(second).ingest();
    assert_others_unchanged(&mut reader);
    let IngestSummary { images, dropped_images, problems, .. } = summary;
    assert_eq!((images, dropped_images.len()), (2, 1));
    assert_eq!((dropped_images[0].reason, dropped_images[0].file.as_str()), (reason, SECOND));
    assert_eq!(dropped_images[0].bytes, second.len() as u64);
    assert!(dropped_images[0].time.is_some(), "its name still says when it was taken");
    let [problem] = &problems[..] else { panic!("{problems:?}") };
    assert_eq!((problem.code.code(), problem.severity), (reason.code(), Severity::Loss));
    assert_eq!(problem.place, format!("cards/P01/{SECOND}"));
    assert!(!problem.remedy.is_empty());
    problem.clone()
}

#[test]
fn a_picture_that_is_cut_off_is_damaged() {
    let picture = noisy_jpeg(128, 96);
    let problem = only_loss(&picture[..picture.len() - 700], FrameReason::DamagedImage);
    let bytes = picture.len() - 700;
    assert!(
        problem
            .fact
            .ends_with(&format!("cannot be used; the file ends after {bytes} bytes without the end marker (ff d9)")),
        "{}",
        problem.fact
    );
}

#[test]
fn a_block_of_zeros_in_a_picture_is_damage() {
    let mut picture = noisy_jpeg(128, 96);
    let at = picture.len() - 5000;
    picture[at..at + 4500].fill(0);
    let problem = only_loss(&picture, FrameReason::DamagedImage);
    assert!(problem.fact.contains(" zero bytes in the picture's data, from byte "), "{}", problem.fact);
}

#[test]
fn a_png_with_one_wrong_bit_is_damaged() {
    let mut picture = png(128, 96);
    let at = picture.len() - 30;
    picture[at] ^= 4;
    let problem = only_loss(&picture, FrameReason::DamagedImage);
    assert!(problem.fact.contains("the checksum of the PNG chunk IDAT"), "{}", problem.fact);
}

#[test]
fn damage_goes_before_a_wrong_size() {
    let picture = noisy_jpeg(320, 240);
    only_loss(&picture[..picture.len() - 10], FrameReason::DamagedImage);
    only_loss(&picture, FrameReason::WrongSize);
}

/// The note of a card whose second picture is used as it is.
fn only_note(second: &[u8]) -> Problem {
    let (summary, mut reader) = card(second).ingest();
    assert_others_unchanged(&mut reader);
    assert_eq!(reader.image_bytes(SECOND).unwrap(), second, "the file's bytes, unchanged");
    assert_eq!((summary.images, summary.dropped_images.len()), (3, 0));
    let [problem] = &summary.problems[..] else { panic!("{:?}", summary.problems) };
    assert_eq!((problem.severity, problem.place.as_str()), (Severity::Note, &*format!("cards/P01/{SECOND}")));
    problem.clone()
}

#[test]
fn bytes_behind_a_picture_are_a_note_and_stay() {
    let problem = only_note(&[noisy_jpeg(128, 96), vec![7; 1500]].concat());
    assert_eq!(problem.code.code(), "bytes_after_image");
    assert!(problem.fact.starts_with("1.5 kB behind the end marker of 1 image,"), "{}", problem.fact);
}

#[test]
fn a_multi_picture_file_is_all_right() {
    let picture = noisy_jpeg(128, 96);
    let both = [&picture[..2], b"\xff\xe2\0\x06MPF\0", &picture[2..], &picture].concat();
    let (summary, mut reader) = card(&both).ingest();
    assert_eq!((summary.images, summary.problems), (3, vec![]));
    assert_eq!(reader.image_bytes(SECOND).unwrap(), both);
}

#[test]
fn a_picture_of_the_other_encoding_is_read_and_noted() {
    let problem = only_note(&png(128, 96));
    assert_eq!(problem.code.code(), "wrong_extension");
    assert!(problem.fact.contains("1 image ("), "{}", problem.fact);
}

#[test]
fn a_file_that_is_too_large_for_a_picture_is_not_read() {
    let study = card(b"");
    let file = std::fs::File::create(study.source.card_dir.join(SECOND)).unwrap();
    file.set_len(10_000_000_000).unwrap();
    let (summary, mut reader) = study.ingest();
    assert_others_unchanged(&mut reader);
    assert_eq!(reader.metadata().inputs_sha256[SECOND], "too_large:10000000000");
    assert_eq!(summary.dropped_images[0].reason, FrameReason::NotAnImage);
    let expected =
        "1 image (10.0 GB) cannot be used; 10.0 GB is larger than the largest picture, 64 MiB; it is not read";
    assert_eq!(summary.problems[0].fact, expected);
    assert_eq!(aim_batch_ingest::inputs_key(&study.source).unwrap(), summary.key, "nor for the key");
}

#[test]
fn what_is_lost_is_counted() {
    let picture = noisy_jpeg(128, 96);
    let study = card(&picture[..4000]);
    study.write("IMAGES/20250601T120003Z.JPG", &picture[..5000]);
    let (summary, _) = study.ingest();
    let fact = &summary.problems[0].fact;
    assert!(fact.starts_with("2 images (9.0 kB) cannot be used; first: the file ends after 4000 bytes"), "{fact}");
}

/// A study whose images take their time from name and EXIF.
fn with_both_times(tolerance_s: f64) -> Study {
    let mut study = Study::new("csv");
    let text = toml::to_string(&study.source.profile).unwrap();
    let both = text
        .replace("from = \"name\"", &format!("from = \"both\"\ntolerance_s = {tolerance_s:?}").replace("NaN", "nan"));
    study.source.profile = toml::from_str::<Profile>(&both).unwrap();
    study.write("accel.csv", b"time_s,x_g,y_g,z_g\n1748779200,0,-1,0\n");
    study.write("range.csv", b"time_s,range_mm\n1748779200,500\n");
    study
}

#[test]
fn times_that_disagree_drop_the_image_and_one_alone_is_noted() {
    let study = with_both_times(2.0);
    let exif = |time| jpeg_with_exif(Some(time), None, None);
    study.write("images/20250601T120000Z.jpg", &exif("2025:06:01 12:00:02"));
    study.write("images/20250601T120010Z.jpg", &exif("2025:06:01 11:00:10"));
    study.write("images/20250601T120020Z.jpg", &jpeg_with_exif(None, None, None));
    study.write("images/DSC1.jpg", &exif("2025:06:01 12:00:30"));
    study.write("images/DSC2.jpg", &jpeg_with_exif(None, None, None));
    let (summary, mut reader) = study.ingest();
    let times: Vec<i64> = reader.images().unwrap().iter().map(|i| i.time.0 / 1_000_000_000 - NOON_S).collect();
    assert_eq!(times, [0, 20, 30]);
    let dropped: Vec<_> = summary.dropped_images.iter().map(|d| (d.file.as_str(), d.reason, d.time)).collect();
    let disagree = ("images/20250601T120010Z.jpg", FrameReason::TimesDisagree, None);
    assert_eq!(dropped, [disagree, ("images/DSC2.jpg", FrameReason::NoTime, None)]);
    assert_eq!(
        summary.dropped_images[0].detail,
        "the name says 2025-06-01T12:00:10Z, EXIF says 2025-06-01T11:00:10Z: 3600 s apart, more than 2 s"
    );
    let codes: Vec<_> = summary.problems.iter().map(|p| (p.code.code(), p.severity)).collect();
    let (loss, note) = (Severity::Loss, Severity::Note);
    assert_eq!(codes, [("no_time", loss), ("times_disagree", loss), ("time_from_one_source", note)]);
    assert!(summary.problems[2].fact.contains("2 images ("), "{}", summary.problems[2].fact);
}

#[test]
fn a_tolerance_that_is_no_time_is_refused() {
    for tolerance_s in [-1.0, f64::NAN] {
        let study = with_both_times(tolerance_s);
        let error = ingest_session(&study.source, &study.out(), &NoProgress).unwrap_err().to_string();
        assert!(error.contains("images.time.tolerance_s"), "{error}");
    }
}

#[test]
fn images_of_two_days_are_a_note() {
    let study = card(&noisy_jpeg(128, 96));
    study.write("IMAGES/20250602T080000Z.JPG", &noisy_jpeg(128, 96));
    let (summary, _) = study.ingest();
    assert_eq!(summary.images, 4);
    let [problem] = &summary.problems[..] else { panic!("{:?}", summary.problems) };
    assert_eq!((problem.code.code(), problem.severity), ("two_recordings", Severity::Note));
    assert!(problem.fact.contains("2025-06-01T12:00:00Z to 2025-06-01T12:00:02Z (3 images)"), "{}", problem.fact);
}
