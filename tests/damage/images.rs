//! Pictures.

use model::FrameReason::{DamagedImage, EmptyImage, NotAnImage, Selected, TimesDisagree, WrongSize};

use super::corrupt::Corruptible;
use super::study::{DamagedStudy, IMAGES, picture, stem};

fn third() -> String {
    format!("I/{}.jpg", stem(30))
}

/// Damages the third picture.
fn corrupt_third(damage: impl FnOnce(&mut Corruptible) -> &mut Corruptible) -> DamagedStudy {
    let study = DamagedStudy::new();
    let mut file = Corruptible::new(std::fs::read(study.file(&third())).unwrap(), 1);
    damage(&mut file);
    study.write(&third(), &file.bytes);
    study
}

#[test]
fn cut_off() {
    let told = corrupt_third(|file| file.truncate(200)).run();
    assert_eq!((told.exit, told.losses()), (3, vec!["damaged_image", "marked_image_dropped"]));
    assert!(told.fact("damaged_image").contains("end marker"), "{}", told.fact("damaged_image"));
    assert_eq!(told.reasons.iter().filter(|reason| **reason == DamagedImage).count(), 1);
    assert_eq!(told.reasons.iter().filter(|reason| **reason == Selected).count(), IMAGES - 1);
}

#[test]
fn zeros_to_the_end() {
    let told = corrupt_third(|file| {
        let end = file.bytes.len();
        file.zero(end - 500..end)
    })
    .run();
    assert_eq!((told.exit, told.losses()), (3, vec!["damaged_image", "marked_image_dropped"]));
}

#[test]
fn bytes_after_the_end_marker_harm_nothing() {
    let told = corrupt_third(|file| file.append(&[0xaa; 1234])).run();
    assert_eq!((told.exit, told.losses(), told.notes()), (0, vec![], vec!["bytes_after_image"]));
    assert_eq!(told.reasons, [Selected; IMAGES]);
}

#[test]
fn of_no_bytes_and_of_ten_gigabytes() {
    let study = DamagedStudy::new();
    study.write(&third(), b"");
    let large = std::fs::OpenOptions::new().write(true).open(study.file(&format!("I/{}.jpg", stem(40)))).unwrap();
    large.set_len(10_000_000_000).unwrap();
    let told = study.run();
    assert_eq!((told.exit, told.losses()), (3, vec!["empty_image", "not_an_image", "marked_image_dropped"]));
    let dropped: Vec<_> = told.reasons.iter().filter(|reason| **reason != Selected).collect();
    assert_eq!(dropped, [&EmptyImage, &NotAnImage]);
}

#[test]
fn of_another_camera_and_no_picture_at_all() {
    let study = DamagedStudy::new();
    let mut other = std::io::Cursor::new(Vec::new());
    image::RgbImage::new(10, 10).write_to(&mut other, image::ImageFormat::Jpeg).unwrap();
    study.write(&third(), other.into_inner());
    study.write(&format!("I/{}.jpg", stem(40)), b"shopping list");
    let told = study.run();
    let dropped: Vec<_> = told.reasons.iter().filter(|reason| **reason != Selected).collect();
    assert_eq!((told.exit, dropped), (3, vec![&WrongSize, &NotAnImage]));
}

#[test]
fn under_a_wrong_extension() {
    let study = DamagedStudy::new();
    std::fs::rename(study.file(&third()), study.file(&third()).with_extension("jpeg")).unwrap();
    let told = study.run();
    assert!(told.fact("unread_files").contains("1 "), "{}", told.fact("unread_files"));
    assert_eq!(told.reasons.len(), IMAGES - 1);
}

#[test]
fn with_exif_that_says_another_time_than_the_name() {
    let study = DamagedStudy::new();
    study.edit("devices/unit.toml", "from = \"name\"", "from = \"both\", tolerance_s = 2.0");
    study.write(&third(), with_exif(&picture(3), "2024:01:01 00:00:31"));
    study.write(&format!("I/{}.jpg", stem(40)), with_exif(&picture(4), "2024:01:01 01:00:40"));
    let told = study.run_beside_one_profile();
    assert_eq!(told.iter().filter(|reason| **reason == TimesDisagree).count(), 1);
    assert_eq!(told.iter().filter(|reason| **reason == Selected).count(), IMAGES - 1);
}

impl DamagedStudy {
    /// Reasons of the damaged session, where the profile of both sessions was changed.
    fn run_beside_one_profile(&self) -> Vec<model::FrameReason> {
        let out = self.folder.path().join("other/results.parquet");
        let output = crate::support::run(["run", self.folder.path().to_str().unwrap(), "--out", out.to_str().unwrap()]);
        crate::support::assert_exit(&output, 3);
        let frames = report::read_frames(&out.with_file_name("frames.parquet")).unwrap();
        frames.into_iter().filter(|frame| frame.session == "bad").map(|frame| frame.reason).collect()
    }
}

/// The picture with an EXIF segment that has DateTimeOriginal.
fn with_exif(jpeg: &[u8], time: &str) -> Vec<u8> {
    let mut tiff = b"II*\0\x08\0\0\0\x01\0".to_vec();
    tiff.extend(
        [&0x8769_u16.to_le_bytes()[..], &4_u16.to_le_bytes(), &1_u32.to_le_bytes(), &26_u32.to_le_bytes()].concat(),
    );
    tiff.extend([0; 4]);
    tiff.extend(1_u16.to_le_bytes());
    tiff.extend(
        [&0x9003_u16.to_le_bytes()[..], &2_u16.to_le_bytes(), &20_u32.to_le_bytes(), &44_u32.to_le_bytes()].concat(),
    );
    tiff.extend([0; 4]);
    tiff.extend(time.as_bytes());
    tiff.push(0);
    let length = (2 + 6 + tiff.len()) as u16;
    [&jpeg[..2], &[0xff, 0xe1], &length.to_be_bytes(), b"Exif\0\0", &tiff, &jpeg[2..]].concat()
}
