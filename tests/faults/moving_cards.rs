//! A card that changes while it is read: somebody is copying it still.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

use model::{SessionStatus, Stage};
use pipeline::{Reporter, RunOptions, Stop, Study, Totals};

use super::Bench;

/// Does something to a file as soon as its session is being read.
struct Meddler<F> {
    change: F,
    is_done: AtomicBool,
}

impl<F: Fn() + Sync> Reporter for Meddler<F> {
    fn begin(&self, _totals: &Totals) {}
    fn stage(&self, _session: &str, _stage: Stage) {}
    fn bytes_to_read(&self, _session: &str, _bytes: u64) {}
    fn done(&self, _status: &SessionStatus) {}

    fn bytes_read(&self, session: &str, _bytes: u64) {
        if session == "S00002" && !self.is_done.swap(true, Ordering::SeqCst) {
            (self.change)();
        }
    }
}

fn run_while(bench: &Bench, change: impl Fn() + Sync) -> Vec<SessionStatus> {
    let study = Study::load(&bench.study(), |_| {}).unwrap();
    let options = RunOptions {
        jobs: None,
        image_memory_bytes: 1 << 28,
        work_dir: bench.work(),
        force: false,
        fail_fast: false,
        prune: false,
        program: "test".to_owned(),
        commit: None,
        stop: Stop::default(),
    };
    std::fs::create_dir_all(bench.path("out")).unwrap();
    let frames = report::frames_file(&bench.out());
    let mut sink = report::ParquetSink::create(&bench.out(), &frames).unwrap();
    let meddler = Meddler { change, is_done: AtomicBool::new(false) };
    let ran = pipeline::run(&study, &options, &meddler, &mut sink).unwrap();
    assert!(meddler.is_done.into_inner());
    ran.sessions
}

/// Changes a file of S00002 while that is read; the session says so, and the next run reads it anew.
fn told_and_read_anew(file: impl Fn(&Bench) -> PathBuf, change: fn(&mut Vec<u8>)) {
    let bench = Bench::new();
    let path = file(&bench);
    let sessions = run_while(&bench, || {
        let mut bytes = std::fs::read(&path).unwrap();
        change(&mut bytes);
        std::fs::write(&path, bytes).unwrap();
    });
    let told = |status: &SessionStatus| status.problems.iter().any(|problem| problem.code.code() == "card_changed");
    let told: Vec<&str> = sessions.iter().filter(|status| told(status)).map(|status| status.session.as_str()).collect();
    assert_eq!(told, ["S00002"]);
    let output = bench.run();
    assert!([Some(0), Some(3)].contains(&output.status.code()));
    assert!(bench.losses().iter().all(|(_, codes)| !codes.contains(&"card_changed".to_owned())));
    assert_eq!(bench.files(), bench.undisturbed());
}

#[test]
fn a_picture_that_shrinks_while_it_is_read() {
    told_and_read_anew(last_picture, |bytes| bytes.truncate(bytes.len() / 2));
}

#[test]
fn a_sensor_file_that_grows_while_it_is_read() {
    told_and_read_anew(|bench| bench.card_file("S00002", "SENSORS"), |bytes| bytes.extend(bytes.clone()));
}

fn last_picture(bench: &Bench) -> PathBuf {
    let folder = bench.study().join("cards/S00002/IMAGES");
    std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).max().unwrap()
}
