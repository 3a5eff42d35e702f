//! Seven days of samples to pitch and stillness.

use std::time::Instant;

use aim_batch_pipeline::signals::{self, PoseSettings, ReadingSettings};
use ingest::{NoProgress, SessionReader, ingest_session};
use model::UtcNs;

use crate::card;

const WEEK_S: i64 = 7 * 24 * 3600;

/// Ingests a week of sensors, then takes pitch, stillness and range at an image every 10 s.
pub fn run() {
    let folder = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).unwrap();
    let (from, mcap) = (folder.path().join("card"), folder.path().join("week.mcap"));
    card::sensors(&from, WEEK_S);
    let start = Instant::now();
    let summary = ingest_session(&card::source(&from), &mcap, &NoProgress).unwrap();
    let ingested_s = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let frames = pitch_at_images(&mcap, WEEK_S);
    let signals_s = start.elapsed().as_secs_f64();
    println!("\nSeven days, {} + {} samples, {frames} images", summary.counts.acceleration, summary.counts.range);
    println!("  card to MCAP                  {ingested_s:8.2} s");
    println!("  MCAP to pitch, stillness, range {signals_s:6.2} s");
}

/// Images of which the pitch is known.
pub fn pitch_at_images(mcap: &std::path::Path, seconds: i64) -> usize {
    let mut reader = SessionReader::open(mcap).unwrap();
    let times: Vec<UtcNs> = (1..seconds / 10).map(|i| UtcNs((card::START_S + 10 * i) * 1_000_000_000)).collect();
    let found = signals::at_images(&mut reader, &times, &ReadingSettings::default()).unwrap();
    let settings = PoseSettings::with_mount(21_f64.to_radians());
    found.readings.iter().filter(|reading| reading.judge(&settings).pitch_roll_rad.is_some()).count()
}
