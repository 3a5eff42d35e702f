//! `calibrate`: learns the corrections of a device from a bench with objects of known size.

use std::fmt::Write as _;
use std::num::NonZeroUsize;
use std::path::PathBuf;

use anyhow::anyhow;
use model::SessionStatus;
use pipeline::calibrate;
use pipeline::calibration::{CalibrationFile, EmpiricalEntry, HeldOutEntry, PhysicalEntry};
use pipeline::{Study, SurveyOptions};

use super::{PROGRAM, outcome, print, print_message, stop_on_signals, survey_failure};
use crate::exit::{Failure, Outcome};
use crate::progress::Bars;

/// The arguments of `calibrate`.
#[derive(Debug, clap::Args)]
pub struct CalibrateArgs {
    /// Folder of the study (docs/study.md), with true sizes in objects.csv; nothing is written into it
    pub study: PathBuf,
    /// The file to write
    #[arg(short, long, default_value = "calibration.toml")]
    pub out: PathBuf,
    /// Sessions at a time; default: the cores that this process may use
    #[arg(short, long, env = "AIM_BATCH_JOBS")]
    pub jobs: Option<NonZeroUsize>,
}

/// Learns the corrections, prints a table of the errors before and after them, and writes the calibration file. Fails where
/// nothing could be learned.
pub fn run(args: &CalibrateArgs, bars: &Bars) -> Result<Outcome, Failure> {
    if args.out.extension().is_none_or(|extension| extension != "toml") {
        return Err(Failure::Usage(anyhow!("--out {}: expected a name that ends in .toml", args.out.display())));
    }
    let study = Study::load(&args.study, calibrate::adjust).map_err(Failure::usage)?;
    let options = SurveyOptions { jobs: args.jobs, program: PROGRAM.to_owned(), stop: stop_on_signals()? };
    let (file, sessions) = calibrate::calibrate(&study, &options, &bars.for_run()).map_err(survey_failure)?;
    print(&text(&file))?;
    if file.physical.is_none() && file.empirical.is_empty() {
        return Err(Failure::Failed(anyhow!(
            "nothing could be learned: a calibration needs objects with true sizes (objects.csv), marked in several setups"
        )));
    }
    ::report::write_file(&args.out, file.to_toml()?.as_bytes())?;
    print_message(&format!("wrote {}\n", args.out.display()));
    for session in sessions.iter().filter(|session| session.has_losses()) {
        tracing::warn!(session = session.session, "not all of it could be used; aim-batch check tells what and why");
    }
    Ok(outcome(sessions.iter().any(SessionStatus::has_losses)))
}

/// A table of the errors before and after, and below it the corrections that were learned, for people.
fn text(file: &CalibrationFile) -> String {
    let mut text = String::new();
    let _ = writeln!(
        text,
        "Root mean square errors in per cent; after: of what was left out of the fit\n\n\
         {:<26} {:>4}  {:>8} {:>8} {:>8}  {:>8}",
        "", "n", "before", "object", "setup", "used"
    );
    if let Some(physical) = &file.physical {
        let used = if physical.determined.is_empty() { "nothing" } else { "yes" };
        line(&mut text, "physical corrections", &physical.without_object, &physical.without_setup, used);
    }
    for entry in &file.empirical {
        let what = format!("paper, {} {}", entry.kind, if entry.height { "heights" } else { "mouths" });
        let used = if entry.used { "yes" } else { "no" };
        line(&mut text, &what, &entry.without_object, &entry.without_setup, used);
        if let (Some(object), Some(setup)) = (&entry.mended_without_object, &entry.mended_without_setup) {
            line(&mut text, "  the same, slips mended", object, setup, "no");
        }
    }
    if let Some(physical) = &file.physical {
        parameters(&mut text, physical);
    }
    file.empirical.iter().for_each(|entry| scale(&mut text, entry));
    if let Some(p) = &file.protractor {
        let _ = writeln!(
            text,
            "\npitch measured = {:.2} + {:.4} x declared, in degrees; difference {:+.2} +- {:.2} over {} images",
            p.offset_deg, p.slope, p.mean_difference_deg, p.sd_difference_deg, p.n
        );
    }
    for note in &file.notes {
        let _ = writeln!(text, "note: {note}");
    }
    text
}

fn line(text: &mut String, what: &str, object: &HeldOutEntry, setup: &HeldOutEntry, used: &str) {
    let number = |value: Option<f64>| value.map_or("-".to_owned(), |v| format!("{v:.2}"));
    let _ = writeln!(
        text,
        "{what:<26} {:>4}  {:>8} {:>8} {:>8}  {used:>8}",
        object.n,
        number(Some(object.before_rmse_pct)),
        number(object.after_rmse_pct),
        number(setup.after_rmse_pct),
    );
}

fn parameters(text: &mut String, p: &PhysicalEntry) {
    let _ = writeln!(
        text,
        "\nmount {:+.3} +- {:.3} degrees; range x {:.4} +- {:.4}, {:+.1} +- {:.1} mm; focal length x {:.4} +- {:.4}",
        p.mount_deg,
        p.mount_sd_deg,
        1.0 + p.range_scale_pct / 100.0,
        p.range_scale_sd_pct / 100.0,
        p.range_offset_mm,
        p.range_offset_sd_mm,
        1.0 + p.focal_pct / 100.0,
        p.focal_sd_pct / 100.0,
    );
}

fn scale(text: &mut String, entry: &EmpiricalEntry) {
    let what = if entry.height { "heights" } else { "mouths" };
    let _ = writeln!(
        text,
        "paper, {} {what}: predicted = true x ({:.4} + {:.4} tan(pitch)), scatter {:.3}",
        entry.kind, entry.a, entry.b, entry.scatter
    );
}
