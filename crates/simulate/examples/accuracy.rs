//! Runs the simulated bench of docs/accuracy.md, which compares sizes and their uncertainties with known truth.
//!
//!     cargo run -p aim-batch-simulate --example accuracy -- [SEED [SESSIONS [IMAGES]]]

use std::error::Error;
use std::io::Write as _;

use aim_batch_simulate::trial::{Options, run, score};

fn main() -> Result<(), Box<dyn Error>> {
    let mut options = Options::default();
    let mut arguments = std::env::args().skip(1);
    if let Some(seed) = arguments.next() {
        options.seed = seed.parse()?;
    }
    if let Some(sessions) = arguments.next() {
        options.sessions = sessions.parse()?;
    }
    if let Some(images) = arguments.next() {
        options.images = images.parse()?;
    }
    let trials = run(&options);
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "seed {}, {} sessions of each subject, {} images each: {} sizes\n",
        options.seed,
        options.sessions,
        options.images,
        trials.len()
    )?;
    out.write_all(score(&trials).markdown().as_bytes())?;
    Ok(())
}
