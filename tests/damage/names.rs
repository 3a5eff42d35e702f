//! Names and links.

#![cfg(unix)]

use std::ffi::OsStr;
use std::os::unix::ffi::OsStrExt;

use model::FrameReason::Selected;

use super::study::{DamagedStudy, IMAGES, stem};

#[test]
fn that_are_not_utf8_are_used() {
    let study = DamagedStudy::new();
    let odd = study.file("S").join(OsStr::from_bytes(b"ACC\xff.BIN"));
    std::fs::rename(study.file("S/ACC0.BIN"), odd).unwrap();
    let told = study.run();
    assert_eq!((told.exit, told.losses(), told.notes()), (0, vec![], vec!["name_not_utf8"]));
    assert_eq!(told.reasons, [Selected; IMAGES]);
}

#[test]
fn that_differ_only_in_case_are_both_used() {
    let study = DamagedStudy::new();
    study.edit("devices/unit.toml", "\"I/*.jpg\"", "\"I/*.jpg\", \"I/*.JPG\"");
    std::fs::copy(study.file(&format!("I/{}.jpg", stem(10))), study.file(&format!("I/{}.JPG", stem(10)))).unwrap();
    let told = study.run_with_other_profile();
    assert!(told.contains("names_differ_in_case"), "{told}");
}

#[test]
fn that_are_links_out_of_the_card_are_refused() {
    let study = DamagedStudy::new();
    let elsewhere = tempfile::tempdir().unwrap();
    std::fs::write(elsewhere.path().join("secret"), b"secret").unwrap();
    std::os::unix::fs::symlink(elsewhere.path().join("secret"), study.file("S/ACC1.BIN")).unwrap();
    let told = study.run();
    assert_eq!((told.exit, told.losses()), (3, vec!["link_leaves_card"]));
    assert_eq!(told.reasons, [Selected; IMAGES]);
}

impl DamagedStudy {
    /// The output of the program with -v, where the profile of both sessions was changed.
    fn run_with_other_profile(&self) -> String {
        let out = self.folder.path().join("other/results.parquet");
        let arguments = ["-v", "run", self.folder.path().to_str().unwrap(), "--out", out.to_str().unwrap()];
        crate::support::stderr(&crate::support::run(arguments))
    }
}
