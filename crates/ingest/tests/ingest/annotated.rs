//! Annotated recordings, read by the mcap library itself.

use std::collections::BTreeMap;
use std::path::PathBuf;

use aim_batch_ingest::{
    AnnotateError, Annotating, ImageNotes, LogLevel, LogNote, MarkNote, SessionReader, annotate_session, annotated_key,
};
use foxglove::messages::{FrameTransform, ImageAnnotations, Log, SceneUpdate};
use model::{Camera, Feature, FrameReason, FrameRow, Pose, UtcNs, View};
use prost::Message as _;

use crate::support::{NOON_S, Study, acceleration_packet, jpeg, range_packet, samples};

const NOON: f64 = NOON_S as f64;
const SECOND: i64 = 1_000_000_000;

/// Two images, 3 and 9 s after noon.
fn study() -> Study {
    let study = Study::new("aim2-packets");
    study.write("SENSORS/ACC0.BIN", &[acceleration_packet(NOON), acceleration_packet(NOON + 8.0)].concat());
    study.write("SENSORS/RNG0.BIN", &range_packet(NOON, 480));
    study.write("IMAGES/20250601T120003.000Z.JPG", &jpeg(32, 24, 20));
    study.write("IMAGES/20250601T120009.000Z.JPG", &jpeg(32, 24, 200));
    study
}

fn camera(study: &Study) -> Camera {
    study.source.camera_spec.camera().unwrap()
}

/// Annotates: the first image has a pose and a mark, the second none.
fn annotated(study: &Study, key: &str) -> Result<PathBuf, AnnotateError> {
    let (out, camera) = (study.dir.path().join("out/P01.annotated.mcap"), camera(study));
    let frame = |reason| FrameRow { range_mm: Some(480.0), ..FrameRow::without_numbers("s", "P01", "i.jpg", reason) };
    let (selected, moving) = (frame(FrameReason::Selected), frame(FrameReason::NoRange));
    let log = [(9, "late"), (1, "early")].map(|(second, text)| LogNote {
        time: UtcNs((NOON_S + second) * SECOND),
        level: LogLevel::Error,
        about: "session",
        text: text.to_owned(),
        file: String::new(),
    });
    let log = [log[1].clone(), log[0].clone()];
    let (recording, raters) = (study.out(), ["A".to_owned()]);
    let what = Annotating { recording: &recording, out: &out, key, camera: &camera, raters: &raters, log: &log };
    annotate_session(&what, |image, bytes| {
        assert!(bytes.starts_with(&[0xff, 0xd8]));
        let is_first = image.time == UtcNs((NOON_S + 3) * SECOND);
        let mark = MarkNote {
            object: "plate".to_owned(),
            rater: "A".to_owned(),
            feature: Feature::Rim,
            closed: true,
            points_px: vec![[10.0, 10.0], [20.0, 10.0], [15.0, 15.0]],
            plane_z_mm: Some(20.0),
        };
        Some(ImageNotes {
            frame: if is_first { &selected } else { &moving },
            view: is_first.then(|| View::new(camera, Pose::new(1.0, 0.0, 480.0).unwrap())),
            marks: if is_first { vec![mark] } else { Vec::new() },
            sizes: Vec::new(),
            drawn_jpeg: None,
        })
    })?;
    Ok(out)
}

/// Topic -> messages with their times, in file order.
fn messages(path: &PathBuf) -> BTreeMap<String, Vec<(i64, Vec<u8>)>> {
    let bytes = std::fs::read(path).unwrap();
    let mut found: BTreeMap<String, Vec<(i64, Vec<u8>)>> = BTreeMap::new();
    for message in mcap::MessageStream::new(&bytes).unwrap() {
        let message = message.unwrap();
        let of_topic = found.entry(message.channel.topic.clone()).or_default();
        of_topic.push((i64::try_from(message.log_time).unwrap(), message.data.to_vec()));
    }
    found
}

#[test]
fn the_recording_is_in_it_and_what_is_known_beside_each_image() {
    let study = study();
    let (summary, mut recording) = study.ingest();
    let out = annotated(&study, "key").unwrap();
    let mut reader = SessionReader::open(&out).unwrap();
    assert_eq!(reader.metadata(), recording.metadata());
    assert_eq!(samples(&mut reader), samples(&mut recording));
    assert_eq!(reader.images().unwrap(), recording.images().unwrap());
    for image in recording.images().unwrap() {
        assert_eq!(reader.image_bytes(&image.file).unwrap(), recording.image_bytes(&image.file).unwrap());
    }
    let found = messages(&out);
    let times: Vec<i64> = [3, 9].map(|second| (NOON_S + second) * SECOND).into();
    for topic in ["/camera/image", "/camera/calibration", "/camera/annotations", "/frame"] {
        assert_eq!(found[topic].iter().map(|(time, _)| *time).collect::<Vec<_>>(), times, "{topic}");
    }
    assert_eq!(found["/imu/acceleration"], messages(&study.out())["/imu/acceleration"]);
    assert_eq!(summary.images, 2);
}

#[test]
fn overlays_transforms_and_log_say_what_was_given() {
    let study = study();
    study.ingest();
    let found = messages(&annotated(&study, "key").unwrap());
    let overlays: Vec<_> =
        found["/camera/annotations"].iter().map(|(_, data)| ImageAnnotations::decode(&data[..]).unwrap()).collect();
    let [marked, empty] = overlays.as_slice() else { panic!("one for each image") };
    let corner = &marked.points[0].points[0];
    assert_eq!([corner.x.to_bits(), corner.y.to_bits()], [10.5_f64.to_bits(); 2], "from the corner of the first pixel");
    assert_eq!(marked.texts[0].text, "plate");
    assert!(empty.points.is_empty() && empty.texts.is_empty(), "or the marks of the image before would stay");
    let [(_, transform)] = found["/tf"].as_slice() else { panic!("only where there is a pose") };
    let transform = FrameTransform::decode(&transform[..]).unwrap();
    assert!((transform.translation.unwrap().z - 0.48 * 1.0_f64.sin()).abs() < 1e-12);
    let scene = SceneUpdate::decode(&found["/scene"][0].1[..]).unwrap();
    assert_eq!(scene.entities.len(), 2, "the table and the plate");
    assert!(scene.entities[1].lines[0].points.iter().all(|point| (point.z - 0.02).abs() < 1e-12));
    let log: Vec<String> = found["/log"].iter().map(|(_, data)| Log::decode(&data[..]).unwrap().message).collect();
    assert!(log[0] == "early" && log[1].starts_with("selected: ") && log[2] == "late", "{log:?}");
    assert!(log[3].starts_with("no_range: "), "{log:?}");
}

#[test]
fn equal_input_gives_equal_bytes_and_the_key_is_kept() {
    let study = study();
    study.ingest();
    let out = annotated(&study, "one").unwrap();
    let bytes = std::fs::read(&out).unwrap();
    annotated(&study, "one").unwrap();
    assert!(std::fs::read(&out).unwrap() == bytes);
    assert_eq!(annotated_key(&out).as_deref(), Some("one"));
    assert_eq!(annotated_key(&study.out()), None, "a recording without notes");
    std::fs::write(&out, &bytes[..bytes.len() - 40]).unwrap();
    assert_eq!(annotated_key(&out), None, "not whole");
}

#[test]
fn what_cannot_be_done_leaves_no_file() {
    let study = study();
    study.ingest();
    let (out, camera) = (study.dir.path().join("out/P01.annotated.mcap"), camera(&study));
    let recording = study.out();
    let what = Annotating { recording: &recording, out: &out, key: "", camera: &camera, raters: &[], log: &[] };
    assert!(matches!(annotate_session(&what, |_, _| None), Err(AnnotateError::Stopped)));
    let mut bytes = std::fs::read(&recording).unwrap();
    let at = bytes.windows(2).position(|two| two == [0xff, 0xd8]).unwrap();
    bytes[at + 100] ^= 1; // a picture's
    std::fs::write(&recording, bytes).unwrap();
    let error = annotated(&study, "").unwrap_err();
    assert!(matches!(&error, AnnotateError::Read(_)) && error.to_string().contains("P01.mcap"), "{error}");
    let names: Vec<_> = std::fs::read_dir(out.parent().unwrap()).unwrap().map(|e| e.unwrap().file_name()).collect();
    assert_eq!(names, ["P01.mcap"]);
}
