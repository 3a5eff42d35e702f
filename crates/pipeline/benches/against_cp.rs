//! A card of images, ingested and copied.

use std::process::Command;

use ingest::{NoProgress, ingest_session};

use crate::{card, turns};

/// Images of the card; 360 are an hour.
const IMAGES: i64 = 720;

/// Ingest of a card against `cp -r` of the same files to the same disk, and against `cp -r` that is made durable as ingest
/// makes its file.
pub fn run() {
    // Beside the target folder, so on a disk and not in memory.
    let folder = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).unwrap();
    let (from, copy, mcap) = (folder.path().join("card"), folder.path().join("copy"), folder.path().join("card.mcap"));
    card::sensors(&from, 10 * IMAGES);
    card::images(&from, IMAGES);
    let source = card::source(&from);
    let megabytes = card::bytes_in(&from) as f64 / 1e6;
    let mut ingest = || {
        let summary = ingest_session(&source, &mcap, &NoProgress).unwrap();
        assert_eq!(summary.images, IMAGES as u64);
        std::fs::remove_file(&mcap).unwrap();
    };
    let mut plain_copy = || {
        assert!(Command::new("cp").arg("-r").args([&from, &copy]).status().unwrap().success());
        std::fs::remove_dir_all(&copy).unwrap();
    };
    let title =
        format!("Ingest of {IMAGES} images and their sensors, {megabytes:.0} MB, seconds (least, median, most)");
    turns::compare(&title, ("ingest, hashed and made durable", &mut ingest), ("cp -r", &mut plain_copy));
    let mut durable_copy = || {
        assert!(Command::new("cp").arg("-r").args([&from, &copy]).status().unwrap().success());
        assert!(Command::new("sync").arg("-f").arg(&copy).status().unwrap().success());
        std::fs::remove_dir_all(&copy).unwrap();
    };
    turns::compare(&title, ("ingest, hashed and made durable", &mut ingest), ("cp -r; sync -f", &mut durable_copy));
}
