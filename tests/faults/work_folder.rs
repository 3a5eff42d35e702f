//! The state between runs is damaged, lost, or of another program.

use super::Bench;
use super::bench::flip_byte;
use crate::support::{assert_exit, stderr};

/// Something happens to the work folder of a study that was run; the next run mends it.
#[track_caller]
fn mended(harm: impl FnOnce(&Bench)) -> Bench {
    let bench = Bench::new();
    std::thread::sleep(std::time::Duration::from_millis(2_100)); // what was just made counts as changing still
    let before = bench.run_well();
    harm(&bench);
    assert_eq!(bench.run_well(), before);
    assert_eq!(bench.run_well(), before);
    bench
}

fn truncate(path: &std::path::Path) {
    let bytes = std::fs::read(path).unwrap();
    std::fs::write(path, &bytes[..bytes.len() / 2]).unwrap();
}

#[test]
fn a_truncated_recording() {
    let bench = mended(|bench| truncate(&bench.mcap("S00002")));
    assert!(ingest::SessionReader::open(&bench.mcap("S00002")).is_ok());
}

#[test]
fn a_recording_that_was_deleted() {
    let bench = mended(|bench| std::fs::remove_file(bench.mcap("S00002")).unwrap());
    assert!(ingest::SessionReader::open(&bench.mcap("S00002")).is_ok());
}

#[test]
fn a_recording_with_a_flipped_byte_is_made_again_when_it_is_read() {
    let bench = Bench::new();
    bench.run_well();
    for session in ["S00001", "S00002"] {
        let path = bench.mcap(session);
        let mut bytes = std::fs::read(&path).unwrap();
        bytes[2_000] ^= 0xff; // in a chunk of samples; index and metadata are whole
        std::fs::write(&path, bytes).unwrap();
    }
    bench.edit("study.toml", |text| format!("{text}\n[signals]\ngravity_cutoff_hz = 0.5\n"));
    assert_eq!(bench.run_well(), bench.undisturbed());
}

/// SQL by other hands, on the state.
fn sql(bench: &Bench, text: &str) {
    rusqlite::Connection::open(bench.work().join("state.sqlite")).unwrap().execute_batch(text).unwrap();
}

#[test]
fn a_state_with_other_tables() {
    for text in ["DROP TABLE written", "DROP TABLE stage", "ALTER TABLE output RENAME COLUMN json TO text"] {
        let bench = mended(|bench| sql(bench, text));
        assert!(bench.work().join("state.sqlite.old").exists(), "{text}");
    }
}

#[test]
fn a_state_with_a_column_more() {
    let bench = mended(|bench| sql(bench, "ALTER TABLE stage ADD COLUMN remark TEXT"));
    bench.edit("cards/S00003/session.toml", |text| text.replacen("participant = \"", "participant = \"x", 1));
    assert_eq!(bench.run_well(), bench.undisturbed());
    assert!(!bench.work().join("state.sqlite.old").exists());
}

#[test]
fn values_of_other_types_in_the_state() {
    for text in
        ["UPDATE stage SET seconds = 'long'", "UPDATE written SET key = x'ff00'", "UPDATE output SET json = x'ff00'"]
    {
        mended(|bench| {
            sql(bench, text);
            std::fs::remove_file(bench.out()).unwrap(); // so that rows are needed
            let marks = std::fs::read_dir(bench.study().join("marks/R1/S00002")).unwrap().next().unwrap().unwrap();
            let now = std::fs::FileTimes::new().set_modified(std::time::SystemTime::now());
            std::fs::File::options().write(true).open(marks.path()).unwrap().set_times(now).unwrap();
        });
    }
}

#[test]
fn a_journal_of_a_killed_run_does_not_keep_status_from_looking() {
    let bench = Bench::new();
    bench.run_well();
    let state = bench.work().join("state.sqlite");
    let db = rusqlite::Connection::open(&state).unwrap();
    db.execute_batch("PRAGMA cache_size = 1; BEGIN EXCLUSIVE; UPDATE output SET json = json || 'xxxxxxxxxxxx'")
        .unwrap();
    // What lies there at this moment is what a kill would leave.
    let [torn, journal] =
        [state.clone(), bench.work().join("state.sqlite-journal")].map(|path| std::fs::read(path).unwrap());
    drop(db);
    std::fs::write(&state, torn).unwrap();
    std::fs::write(bench.work().join("state.sqlite-journal"), journal).unwrap();
    assert!(bench.status(&[]).contains("6 sessions"));
    assert_eq!(bench.run_well(), bench.undisturbed());
}

#[test]
fn a_state_of_garbage() {
    let bench = mended(|bench| std::fs::write(bench.work().join("state.sqlite"), vec![0xa5; 10_000]).unwrap());
    assert!(bench.work().join("state.sqlite.old").exists(), "it is set aside");
}

#[test]
fn a_truncated_state() {
    mended(|bench| truncate(&bench.work().join("state.sqlite")));
}

#[test]
fn an_empty_state() {
    mended(|bench| std::fs::write(bench.work().join("state.sqlite"), b"").unwrap());
}

#[test]
fn bytes_flipped_anywhere_in_the_state() {
    let bench = Bench::new();
    std::thread::sleep(std::time::Duration::from_millis(2_100));
    let before = bench.run_well();
    let path = bench.work().join("state.sqlite");
    let whole = std::fs::read(&path).unwrap();
    for part in 1..12 {
        let mut bytes = whole.clone();
        let at = whole.len() * part / 12;
        bytes[at..(at + 64).min(whole.len())].iter_mut().for_each(|byte| *byte ^= 0x15);
        std::fs::write(&path, bytes).unwrap();
        std::fs::remove_file(bench.out()).unwrap(); // so that rows are needed
        assert_eq!(bench.run_well(), before, "64 bytes from {at} on of {}", whole.len());
    }
}

#[test]
fn a_state_that_was_deleted_costs_hashes_and_no_ingest() {
    let bench = Bench::new();
    let before = bench.run_well();
    let recorded = || std::fs::metadata(bench.mcap("S00001")).unwrap().modified().unwrap();
    let then = recorded();
    std::fs::remove_file(bench.work().join("state.sqlite")).unwrap();
    assert_eq!(bench.run_well(), before);
    assert_eq!(recorded(), then);
}

#[test]
fn a_state_of_a_newer_program_is_left_alone() {
    let bench = Bench::new();
    bench.run_well();
    let path = bench.work().join("state.sqlite");
    let mut bytes = std::fs::read(&path).unwrap();
    bytes[60..64].copy_from_slice(&99_u32.to_be_bytes()); // user_version, by SQLite's file format
    std::fs::write(&path, &bytes).unwrap();
    let output = bench.run();
    assert_exit(&output, 1);
    assert!(stderr(&output).contains("state version 99, expected 1"), "{}", stderr(&output));
    assert_eq!(std::fs::read(&path).unwrap(), bytes);
}

#[test]
fn results_that_were_damaged_or_deleted_are_written_again() {
    let bench = mended(|bench| flip_byte(&bench.out()));
    let before = bench.files();
    std::fs::remove_file(bench.out().with_file_name("frames.parquet")).unwrap();
    assert_eq!(bench.run_well(), before);
    std::fs::remove_file(bench.out().with_file_name("run.json")).unwrap();
    assert_eq!(bench.run_well(), before);
    assert_eq!(bench.done(), [0, 0, 0]);
}

#[test]
fn a_work_folder_that_was_moved_is_still_good() {
    let bench = Bench::new();
    std::thread::sleep(std::time::Duration::from_millis(2_100));
    let before = bench.run_well();
    crate::support::copy_folder(&bench.path("out"), &bench.path("moved"));
    std::fs::remove_dir_all(bench.path("out")).unwrap();
    std::fs::rename(bench.path("moved"), bench.path("out")).unwrap();
    assert_eq!(bench.run_well(), before);
    assert_eq!(bench.done(), [0, 0, 0]);
}

#[test]
fn what_a_killed_run_left_is_removed() {
    let bench = mended(|bench| {
        std::fs::write(bench.work().join("mcap/.ingest-abc.partial"), b"half").unwrap();
        std::fs::write(bench.out().with_file_name(".results.parquet.aim-batch-part"), b"half").unwrap();
    });
    assert_eq!(bench.leftovers(), Vec::<String>::new());
}
