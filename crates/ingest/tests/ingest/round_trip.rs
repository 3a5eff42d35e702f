//! Card -> MCAP -> reader: exact values, unchanged images, equal bytes.

use aim_batch_ingest::{
    Counts, INGEST_VERSION, ImageEntry, Ingested, NoProgress, Profile, Sample, SessionReader, ingest_if_changed,
    ingest_is_current, inputs_key,
};
use model::{Orientation, UtcNs};

use crate::support::{NOON_S, Study, acceleration_packet, files_in, jpeg, jpeg_with_exif, png, range_packet, samples};

const SECOND: i64 = 1_000_000_000;
const NOON: f64 = NOON_S as f64;

/// Two accelerometer files whose names are not in the order of their times, a hole between packets, two images.
fn packet_study() -> Study {
    let study = Study::new("aim2-packets");
    study.write("SENSORS/ACC0.BIN", &acceleration_packet(NOON + 16.0));
    study.write("SENSORS/ACC1.BIN", &[acceleration_packet(NOON), acceleration_packet(NOON + 8.0)].concat());
    study.write("SENSORS/RNG0.BIN", &range_packet(NOON + 0.001, 8190));
    study.write("IMAGES/20250601T120010.500Z.JPG", &jpeg(32, 24, 20));
    study.write("IMAGES/20250601T120000.000Z.jpg", &jpeg(32, 24, 200));
    study.write("session.toml", b"participant = \"P01\"");
    study
}

#[test]
fn packets_come_back_exactly_and_in_order_of_time() {
    let (summary, mut reader) = packet_study().ingest();
    assert!(summary.problems.is_empty(), "{:?}", summary.problems);
    assert_eq!(summary.counts, Counts { acceleration: 3 * 1022, range: 1022, images: 2, dropped_images: 0 });
    let samples = samples(&mut reader);
    assert_eq!(samples.len(), 4 * 1022);

    let acceleration: Vec<_> = samples.iter().filter(|s| matches!(s, Sample::Acceleration { .. })).collect();
    for (i, sample) in acceleration.iter().enumerate() {
        let (packet, of_packet) = (i as i64 / 1022, i as i64 % 1022);
        // 7.8125 ms at 128 Hz from the stamp on; packets start 8 s apart and last 7.984 s: the hole stays.
        let time = UtcNs((NOON_S + 8 * packet) * SECOND + of_packet * 7_812_500);
        let expected = [10.0 * 0.001, -1000.0 * 0.001, of_packet as f64 * 0.001];
        let Sample::Acceleration { time: found, g } = **sample else { unreachable!() };
        assert_eq!(found, time);
        assert!(g.iter().zip(expected).all(|(g, expected)| (g - expected).abs() < 1e-7), "{g:?} {expected:?}");
    }
    let range: Vec<_> = samples.iter().filter(|s| matches!(s, Sample::Range { .. })).collect();
    let first = range[0].time().0 - (NOON_S * SECOND + 1_000_000);
    assert!(first.abs() < 240, "an f64 stamp of today is 240 ns coarse: off by {first} ns");
    assert!(range.iter().all(|sample| matches!(sample, Sample::Range { mm, .. } if (mm - 8190.0).abs() < 1e-12)));

    let mut count = 0;
    reader.for_each_sample(|_| count += 1).unwrap();
    assert_eq!(count, 4 * 1022, "a second pass gives the same");
}

/// Readers look messages up by the times of their first samples: a window of a second must not seem to be empty while the sensor was on.
#[test]
fn a_window_of_one_second_within_a_packet_has_messages() {
    let study = packet_study();
    study.ingest();
    let bytes = std::fs::read(study.out()).unwrap();
    let times_of = |topic: &str| -> Vec<i64> {
        let messages = mcap::MessageStream::new(&bytes).unwrap().map(Result::unwrap);
        messages.filter(|message| message.channel.topic == topic).map(|message| message.log_time as i64).collect()
    };
    let begins = (NOON_S + 8) * SECOND;
    for (topic, begins) in [("/imu/acceleration", begins), ("/range", NOON_S * SECOND + 1_000_000)] {
        let times = times_of(topic);
        for begin in (0..7).map(|second| begins + second * SECOND) {
            let within = times.iter().filter(|time| (begin - 500..begin + SECOND).contains(time)).count();
            assert!(within >= 1, "{topic}: nothing at {begin}");
        }
    }
    let mut sorted = times_of("/imu/acceleration");
    sorted.sort_unstable();
    assert_eq!(sorted.len(), 3 * 8, "7.984 s are 8 messages");
    assert!(sorted.windows(2).all(|pair| pair[1] - pair[0] <= SECOND + 16_000_000), "packets have holes of 16 ms");
}

#[test]
fn images_are_listed_in_order_of_time_and_come_back_unchanged() {
    let (_, mut reader) = packet_study().ingest();
    let (first, second) = (jpeg(32, 24, 200), jpeg(32, 24, 20));
    let entry = |file: &str, ns: i64, bytes: usize| ImageEntry {
        file: file.to_owned(),
        time: UtcNs(NOON_S * SECOND + ns),
        bytes: bytes as u64,
        width_px: 32,
        height_px: 24,
        orientation: Orientation::Upright,
    };
    let expected = [
        entry("IMAGES/20250601T120000.000Z.jpg", 0, first.len()),
        entry("IMAGES/20250601T120010.500Z.JPG", 10_500_000_000, second.len()),
    ];
    assert_eq!(reader.images().unwrap(), expected);
    assert_eq!(reader.image_bytes(&expected[1].file).unwrap(), second);
    assert_eq!(reader.image_bytes(&expected[0].file).unwrap(), first);
    let error = reader.image_bytes("IMAGES/no.jpg").unwrap_err().to_string();
    assert!(error.ends_with("there is no image 'IMAGES/no.jpg' in this session"), "{error}");
}

#[test]
fn images_of_one_time_are_told_apart() {
    let study = Study::new("csv");
    study.write("images/20250601T120000Z.jpg", &jpeg(32, 24, 50));
    study.write("images/20250601T120000Z.png", &png(32, 24));
    let (summary, mut reader) = study.ingest();
    assert_eq!(summary.images, 2);
    assert_eq!(reader.image_bytes("images/20250601T120000Z.png").unwrap(), png(32, 24));
    assert_eq!(reader.image_bytes("images/20250601T120000Z.jpg").unwrap(), jpeg(32, 24, 50));
}

#[test]
fn metadata_says_what_went_in() {
    let study = packet_study();
    let (summary, reader) = study.ingest();
    let metadata = reader.metadata();
    assert_eq!((metadata.session.as_str(), metadata.program.as_str()), ("P01", "test 1"));
    assert_eq!(metadata.ingest_version, INGEST_VERSION);
    assert_eq!(metadata.profile, study.source.profile);
    assert_eq!(metadata.camera, study.source.camera_spec);
    assert!((metadata.mount_pitch_deg - 21.0).abs() < 1e-12);
    assert_eq!(metadata.counts, summary.counts);
    assert_eq!(metadata.key, summary.key);
    let names: Vec<&str> = metadata.inputs_sha256.keys().map(String::as_str).collect();
    assert_eq!(
        names,
        [
            "IMAGES/20250601T120000.000Z.jpg",
            "IMAGES/20250601T120010.500Z.JPG",
            "SENSORS/ACC0.BIN",
            "SENSORS/ACC1.BIN",
            "SENSORS/RNG0.BIN"
        ],
        "session.toml is no input of ingest"
    );
    let expected = format!("{:x}", <sha2::Sha256 as sha2::Digest>::digest(acceleration_packet(NOON + 16.0)));
    assert_eq!(metadata.inputs_sha256["SENSORS/ACC0.BIN"], expected);
}

#[test]
fn equal_input_gives_equal_bytes_and_nothing_is_left_behind() {
    let (a, b) = (packet_study(), packet_study());
    a.ingest();
    b.ingest();
    assert_eq!(std::fs::read(a.out()).unwrap(), std::fs::read(b.out()).unwrap());
    assert_eq!(files_in(a.out().parent().unwrap()), ["P01.mcap"]);
}

#[test]
fn a_second_run_ingests_only_what_has_changed() {
    let mut study = packet_study();
    let fresh = |study: &Study| {
        let ingested = ingest_if_changed(&study.source, &study.out(), &NoProgress).unwrap();
        matches!(ingested, Ingested::Fresh(_))
    };
    assert!(fresh(&study));
    assert!(!fresh(&study));
    let key = SessionReader::open(&study.out()).unwrap().metadata().key.clone();
    assert_eq!(inputs_key(&study.source).unwrap(), key, "the key of a fresh ingest is that of its inputs");
    assert!(ingest_is_current(&study.out(), &key));

    study.write("session.toml", b"participant = \"P02\"");
    assert!(!fresh(&study), "not an input of ingest");
    study.source.program = "test 2".to_owned();
    assert!(!fresh(&study), "another version of the program, the same ingest");
    study.write("IMAGES/20250601T120000.000Z.jpg", &jpeg(32, 24, 201));
    assert!(fresh(&study), "a changed image");
    study.source.camera_spec.principal_px = [15.0, 12.0];
    assert!(!fresh(&study), "another calibration, on which no sample and no picture depends");
    study.source.camera_spec.width_px = 33;
    assert!(fresh(&study), "pictures of another size are expected");
    study.source.time_zone = jiff::tz::TimeZone::get("America/Chicago").unwrap();
    assert!(fresh(&study), "another time zone");
    std::fs::write(study.out(), b"not an MCAP file").unwrap();
    assert!(fresh(&study), "a damaged MCAP file");
}

#[test]
fn overlapping_and_jumping_files_still_come_back_in_order_of_time() {
    let study = Study::new("csv");
    let rows = |start_s: i64, count: i64| {
        let row = |i| format!("{}.{:03},0.0,-1.0,0.0\n", start_s + i / 100, i % 100 * 10);
        format!("time_s,x_g,y_g,z_g\n{}", (0..count).map(row).collect::<String>())
    };
    study.write("accel1.csv", rows(NOON_S, 60_000).as_bytes());
    study.write("accel2.csv", rows(NOON_S + 300, 60_000).as_bytes());
    // A clock that stood at 1970 for a while, in the middle of a file.
    study.write("accel3.csv", format!("{}5.0,0.0,-1.0,0.5\n6.0,,,\n", rows(NOON_S + 600, 10)).as_bytes());
    let (summary, mut reader) = study.ingest();
    assert_eq!(summary.counts.acceleration, 120_010);
    let misplaced = summary.problems.iter().find(|problem| problem.code.code() == "misplaced_packets").unwrap();
    assert!(misplaced.fact.contains("(1 samples)") && misplaced.fact.contains("1970-01-01"), "{}", misplaced.fact);
    let samples = samples(&mut reader);
    assert_eq!(samples.len(), 120_010);
    assert!(samples.is_sorted_by_key(Sample::time));
    assert_eq!(samples[0].time(), UtcNs(NOON_S * SECOND));
}

#[test]
fn exif_times_in_the_study_s_zone() {
    let mut study = Study::new("csv");
    let text = toml::to_string(&study.source.profile).unwrap();
    let exif = text
        .replace("from = \"name\"", "from = \"exif\"")
        .lines()
        .filter(|l| !l.starts_with("pattern"))
        .fold(String::new(), |text, line| text + line + "\n");
    study.source.profile = toml::from_str::<Profile>(&exif).unwrap();
    study.source.time_zone = jiff::tz::TimeZone::get("America/Chicago").unwrap();
    study.write("images/a.jpg", &jpeg_with_exif(Some("2025:06:01 12:00:00"), Some("5"), None));
    study.write("images/b.jpg", &jpeg_with_exif(Some("2025:06:01 12:00:00"), None, Some("+00:00")));
    let (_, mut reader) = study.ingest();
    let times: Vec<_> = reader.images().unwrap().into_iter().map(|image| (image.file, image.time.0)).collect();
    let noon = NOON_S * SECOND;
    assert_eq!(times, [("images/b.jpg".to_owned(), noon), ("images/a.jpg".to_owned(), noon + 18_000_500_000_000)]);
}

#[test]
fn rows_that_share_a_second_are_spread_and_told() {
    let study = Study::new("csv");
    let row = |i: i64| format!("{}.0,0.0,1.0,0.0\n", NOON_S + i / 100);
    let rows: String = (0..1000).map(row).collect();
    study.write("accel.csv", format!("time_s,x_g,y_g,z_g\n{rows}").as_bytes());
    study.write("IMAGES/20250601T120005.000Z.JPG", &jpeg(32, 24, 20));
    let (summary, mut reader) = study.ingest();
    let of_stamps: Vec<_> = summary.problems.iter().filter(|p| p.place.ends_with("accel.csv")).collect();
    assert_eq!(of_stamps.iter().map(|p| p.code.code()).collect::<Vec<_>>(), ["stamps_shared"], "{of_stamps:?}");
    assert!(of_stamps[0].fact.starts_with("100 rows each share a stamp, 1 s apart"), "{}", of_stamps[0].fact);
    let times: Vec<i64> = samples(&mut reader).iter().map(|sample| sample.time().0 - NOON_S * SECOND).collect();
    let expected: Vec<i64> = (0..1000).map(|i| i * 10_000_000 + 5_000_000).collect();
    assert_eq!(times, expected);
}
