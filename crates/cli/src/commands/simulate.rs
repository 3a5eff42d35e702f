//! `simulate`: a study with known truth.

use ::simulate::{Options, published_bench};

use super::tell;
use crate::args::{Preset, SimulateArgs};
use crate::exit::{Failure, Outcome};
use crate::progress::Bars;

/// Makes the study.
pub fn run(args: &SimulateArgs, bars: &Bars) -> Result<Outcome, Failure> {
    let options = Options { seed: args.seed, render: !args.no_pictures };
    let summary = match args.preset {
        Preset::PublishedBench => published_bench(&args.out, &options, &bars.counter("pictures"))?,
    };
    tell(&format!(
        "wrote {}: {} sessions, {} images, {} files of marks\n",
        args.out.display(),
        summary.sessions,
        summary.images,
        summary.mark_files,
    ))?;
    Ok(Outcome::Well)
}
