//! Sensor files.

use model::FrameReason::{NoAcceleration, NoRange, Selected};

use super::study::{ACC_PACKET, DamagedStudy, IMAGES, RNG_PACKET, SECONDS};

const ACC: &str = "S/ACC0.BIN";
const RNG: &str = "S/RNG0.BIN";

#[test]
fn truncated_inside_a_packet() {
    let study = DamagedStudy::new();
    study.corrupt(ACC, |file| file.drop(55..SECONDS).truncate(100));
    let told = study.run();
    assert_eq!((told.exit, told.losses()), (3, vec!["truncated_packet"]));
    assert!(told.fact("truncated_packet").contains("at byte 21384: expected 396 bytes, got 296, of which 14 samples"));
    assert_eq!(told.reasons, [Selected; IMAGES], "the last image is at 50 s");
}

#[test]
fn truncated_to_nothing() {
    let study = DamagedStudy::new();
    study.write(RNG, b"");
    let told = study.run();
    assert_eq!(told.exit, 3);
    assert!(told.losses().contains(&"no_samples") && told.losses().contains(&"no_image_with_pose"));
    assert_eq!(told.reasons, [NoRange; IMAGES]);
}

#[test]
fn bytes_lost_inside_a_packet() {
    let study = DamagedStudy::new();
    study.corrupt(ACC, |file| file.drop_bytes(20 * ACC_PACKET + 77..20 * ACC_PACKET + 90));
    let told = study.run();
    assert_eq!((told.exit, told.losses()), (3, vec!["lost_alignment"]));
    assert!(told.fact("lost_alignment").contains("383 bytes are left out"), "{}", told.fact("lost_alignment"));
    assert_eq!(told.notes(), ["gaps"]);
    assert_eq!(told.reasons[0], Selected);
    assert_eq!(told.reasons[2..], [Selected; 3]);
}

#[test]
fn a_stamp_with_a_flipped_bit() {
    let study = DamagedStudy::new();
    study.corrupt(ACC, |file| file.flip(30 * ACC_PACKET + 7));
    let told = study.run();
    assert_eq!((told.exit, told.losses()), (3, vec!["bad_stamp"]));
    assert!(told.fact("bad_stamp").starts_with("1 packets (396 bytes)"));
}

#[test]
fn blocks_of_zeros() {
    let study = DamagedStudy::new();
    study.corrupt(RNG, |file| file.zero(18 * RNG_PACKET..23 * RNG_PACKET));
    let told = study.run();
    assert_eq!((told.exit, told.losses()), (3, vec!["zero_blocks", "marked_image_without_pose"]));
    assert!(told.fact("zero_blocks").starts_with("700 bytes are blocks of zeros, the first at byte 2520"));
    assert_eq!(told.reasons, [Selected, NoRange, Selected, Selected, Selected]);
}

#[test]
fn packets_that_were_never_written_are_a_gap_that_nothing_bridges() {
    let study = DamagedStudy::new();
    study.corrupt(ACC, |file| file.drop(17..24));
    let told = study.run();
    assert_eq!((told.exit, told.notes()), (3, vec!["gaps"]));
    assert!(told.fact("gaps").starts_with("1 gaps of more than 0.5 s in the accelerometer's samples, 7.0 s in all"));
    assert_eq!(told.reasons, [Selected, NoAcceleration, Selected, Selected, Selected]);
}

#[test]
fn packets_that_are_there_twice_are_used_once() {
    let study = DamagedStudy::new();
    study.corrupt(ACC, |file| file.duplicate(28..32));
    let told = study.run();
    assert_eq!((told.exit, told.losses(), told.notes()), (0, vec![], vec!["duplicate_packets"]));
    assert!(told.fact("duplicate_packets").starts_with("4 packets of the accelerometer"));
    assert_eq!(told.frames.iter().map(|frame| frame.pitch_deg).collect::<Vec<_>>(), whole_pitch());
}

#[test]
fn packets_that_were_written_late_are_put_in_order() {
    let study = DamagedStudy::new();
    study.corrupt(ACC, |file| file.reorder(19, 22));
    let told = study.run();
    assert_eq!((told.exit, told.losses(), told.notes()), (0, vec![], vec!["packets_out_of_order"]));
    assert_eq!(told.frames.iter().map(|frame| frame.pitch_deg).collect::<Vec<_>>(), whole_pitch());
}

fn whole_pitch() -> Vec<Option<f64>> {
    DamagedStudy::new().run().frames.iter().map(|frame| frame.pitch_deg).collect()
}

#[test]
fn several_files_in_any_order_and_one_of_them_twice() {
    let study = DamagedStudy::new();
    let bytes = std::fs::read(study.file(ACC)).unwrap();
    let (first, second) = bytes.split_at(25 * ACC_PACKET);
    study.write("S/ACC0.BIN", second);
    study.write("S/ACC1.BIN", first);
    study.write("S/ACC2.BIN", second);
    let told = study.run();
    assert_eq!((told.exit, told.losses(), told.notes()), (0, vec![], vec!["duplicate_file"]));
    assert_eq!(told.frames.iter().map(|frame| frame.pitch_deg).collect::<Vec<_>>(), whole_pitch());
}

#[test]
fn images_without_sensor_data() {
    let study = DamagedStudy::new();
    std::fs::remove_dir_all(study.file("S")).unwrap();
    let told = study.run();
    assert_eq!(told.exit, 3);
    assert!(told.losses().contains(&"no_files"), "{:?}", told.losses());
    assert_eq!(told.reasons, [NoAcceleration; IMAGES]);
}

#[test]
fn sensor_data_without_images() {
    let study = DamagedStudy::new();
    std::fs::remove_dir_all(study.file("I")).unwrap();
    let told = study.run();
    assert_eq!(told.exit, 3);
    assert!(told.fact("no_files").contains("camera"));
    assert!(told.reasons.is_empty() && told.losses().contains(&"marks_without_image"));
}

#[cfg(unix)]
#[test]
fn a_file_that_cannot_be_read() {
    let study = DamagedStudy::new();
    std::os::unix::fs::symlink(study.file("S/nowhere"), study.file("S/ACC1.BIN")).unwrap();
    let told = study.run();
    assert_eq!((told.exit, told.losses()), (3, vec!["unreadable_file"]));
    assert_eq!(told.reasons, [Selected; IMAGES]);
}

/// Ten gigabytes that take no room on the disk: run by night, since they are read.
#[cfg(unix)]
#[test]
#[ignore = "slow: reads 10 GB"]
fn a_sensor_file_of_ten_gigabytes_of_zeros() {
    let study = DamagedStudy::new();
    let file = std::fs::OpenOptions::new().write(true).open(study.file(ACC)).unwrap();
    file.set_len(10_000_000_000).unwrap();
    let told = study.run();
    assert_eq!(told.losses()[0], "zero_blocks");
    assert_eq!(told.reasons, [Selected; IMAGES]);
}

/// A logger that writes a filler once a second, on one axis or on all, must not make every image 'moving'.
#[test]
fn accelerations_that_no_sensor_has() {
    for (filler, axes) in [(-9999_i16, 1), (-9999, 3), (32_767, 3), (i16::MIN, 1)] {
        let study = DamagedStudy::new();
        let mut bytes = std::fs::read(study.file(ACC)).unwrap();
        for packet in bytes.chunks_exact_mut(ACC_PACKET) {
            for axis in 0..axes {
                let at = 12 + axis * 64 * 2 + 2 * 5;
                packet[at..at + 2].copy_from_slice(&filler.to_le_bytes());
            }
        }
        std::fs::write(study.file(ACC), bytes).unwrap();
        let told = study.run();
        assert_eq!((told.exit, told.losses()), (3, vec!["impossible_acceleration"]), "{filler}");
        let fact = told.fact("impossible_acceleration");
        assert!(fact.starts_with("60 of 3840 samples") && fact.contains("at byte 0, sample 5"), "{fact}");
        assert_eq!(told.reasons, [Selected; IMAGES], "{filler}");
        assert!(told.frames.iter().all(|frame| (frame.pitch_deg.unwrap() - 55.0).abs() < 0.1), "{filler}");
    }
}
