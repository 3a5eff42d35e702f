//! Makes a report from a made-up study, to look at and to test in a browser: every number in it is made up.
//!
//! `cargo run --example page -- small DIR` has names that mean something to HTML, JSON and file systems, a failed session,
//! and pictures with marks. `... large DIR` has 10,000 measurements and 50,000 images. Both write DIR/results.parquet
//! with its ledger, from which `aim-batch report` makes a report without pictures, and DIR/report with pictures.

#![allow(clippy::print_stdout, reason = "says what it made")]

mod drawn;
mod rows;

use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Context as _, bail};
use model::{GallerySink as _, ResultSink as _};
use report::{
    Page, ParquetSink, Pictures, Results, figures, frames_file, read_run_log, run_file, write_figures, write_report,
};
use rows::Study;

fn main() -> anyhow::Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [size, dir] = arguments.as_slice() else { bail!("expected: small|large DIR") };
    let study = match size.as_str() {
        "small" => rows::small(),
        "large" => rows::large(),
        other => bail!("expected small or large, got '{other}'"),
    };
    let dir = PathBuf::from(dir);
    std::fs::create_dir_all(&dir).with_context(|| format!("cannot make {}", dir.display()))?;
    let results = write_results(&study, &dir.join("results.parquet"))?;
    let begun = Instant::now();
    let report = dir.join("report");
    let pictures = write_pictures(&study, &report)?;
    println!("{} pictures in {:.1} s", pictures.len(), begun.elapsed().as_secs_f64());
    let begun = Instant::now();
    let log = read_run_log(&run_file(&dir.join("results.parquet")), &results.metadata);
    let frames: Vec<_> = study.sessions.iter().flat_map(|(_, frames)| frames.clone()).collect();
    let figures = figures(&results, &frames)?;
    write_figures(&figures, &report)?;
    let page = Page { results: &results, log: log.as_ref(), figures: &figures, pictures: &pictures };
    let file = write_report(&page, &report)?;
    println!("{} rows: {} in {:.1} s", results.rows.len(), file.display(), begun.elapsed().as_secs_f64());
    Ok(())
}

fn write_results(study: &Study, out: &Path) -> anyhow::Result<Results> {
    let frames = frames_file(out);
    let mut sink = ParquetSink::create(out, &frames)?;
    for (results, frames) in &study.sessions {
        sink.session(results.clone(), frames.clone())?;
    }
    sink.finish(&study.metadata, &study.log)?;
    let mut results = Results::read(out)?;
    results.read_flow(&frames)?;
    Ok(results)
}

/// Writes one picture per measured image, and for the first of them two more views.
fn write_pictures(study: &Study, report: &Path) -> anyhow::Result<Pictures> {
    let mut pictures = Pictures::new(report);
    let mut scene = drawn::Scene::new()?;
    for (results, _) in &study.sessions {
        for picture in scene.pictures(results) {
            pictures.picture(picture)?;
        }
    }
    Ok(pictures)
}
