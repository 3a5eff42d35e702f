//! One worker against two, and a second run against the first.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use aim_batch_pipeline::{RunOptions, Silent, Stop, Study, run};
use model::{FrameRow, ResultRow, ResultSink, RunLog, RunMetadata};

use crate::{card, turns};

const SESSIONS: i64 = 8;
/// Images of each: a quarter of an hour.
const IMAGES: i64 = 90;

/// A study of eight cards with one worker and with two, each into a fresh work folder; then again into the same.
pub fn run_jobs() {
    let folder = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).unwrap();
    let study = study(&folder.path().join("study"));
    let megabytes = card::bytes_in(&study.dir) as f64 / 1e6;
    let mut folders = 0;
    let mut fresh = |jobs: usize| {
        folders += 1;
        let work = folder.path().join(format!("work{folders}"));
        measure_jobs(&study, &work, jobs);
        std::fs::remove_dir_all(work).unwrap();
    };
    let fresh = std::cell::RefCell::new(&mut fresh);
    let (mut two, mut one) = (|| fresh.borrow_mut()(2), || fresh.borrow_mut()(1));
    let title = format!("{SESSIONS} cards of {IMAGES} images and their sensors, {megabytes:.0} MB, seconds");
    turns::compare(&title, ("run --jobs 2", &mut two), ("run --jobs 1", &mut one));
    let kept = folder.path().join("kept");
    measure_jobs(&study, &kept, 2);
    let mut again = || measure_jobs(&study, &kept, 2);
    turns::compare(&title, ("second run --jobs 2", &mut again), ("first run --jobs 2", &mut two));
}

fn study(dir: &Path) -> Study {
    for session in 0..SESSIONS {
        let card = dir.join(format!("cards/S{session}"));
        card::sensors(&card, 10 * IMAGES);
        card::images(&card, IMAGES);
    }
    let spec = "schema_version = 1\nname = \"bench\"\ndevice_profile = \"aim2-packets\"\ncamera = \"aim2-raw\"\n";
    std::fs::write(dir.join("study.toml"), spec).unwrap();
    std::fs::write(dir.join("objects.csv"), "object,kind,shape\nplate,plate,circle\n").unwrap();
    Study::load(dir, |_| {}).unwrap()
}

fn measure_jobs(study: &Study, work_dir: &Path, jobs: usize) {
    let options = RunOptions {
        jobs: NonZeroUsize::new(jobs),
        image_memory_bytes: 256 << 20,
        work_dir: work_dir.to_owned(),
        force: false,
        fail_fast: false,
        prune: false,
        program: "benchmark".to_owned(),
        commit: None,
        stop: Stop::default(),
    };
    let ran = run(study, &options, &Silent, &mut NoSink).unwrap();
    assert!(ran.sessions.iter().all(|session| !session.has_losses() && session.images == IMAGES as usize));
}

/// Rows are made, and written by nobody.
struct NoSink;

impl ResultSink for NoSink {
    type Error = std::io::Error;

    fn session(&mut self, _results: Vec<ResultRow>, _frames: Vec<FrameRow>) -> Result<(), Self::Error> {
        Ok(())
    }

    fn finish(&mut self, _metadata: &RunMetadata, _log: &RunLog) -> Result<(), Self::Error> {
        Ok(())
    }

    fn files(&self) -> Vec<PathBuf> {
        Vec::new()
    }
}
