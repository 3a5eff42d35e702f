//! The places where a run may write: not over the ledger of another run, and not among the cards and marks.

use std::path::{Path, PathBuf};

use anyhow::anyhow;
use pipeline::Study;

use crate::exit::Failure;

/// Where results go, and what is kept between runs.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Input and output")]
pub struct PlaceArgs {
    /// File for the sizes, X.parquet; beside it are written the ledger of images, X.frames.parquet, and where all came from,
    /// X.run.json (frames.parquet and run.json for results.parquet)
    #[arg(short, long, env = "AIM_BATCH_OUT", default_value = "results.parquet")]
    pub out: PathBuf,
    /// Folder for what can be made anew (recordings as MCAP files, and the state of every session), and may be deleted;
    /// default: X.work beside the output
    #[arg(long, env = "AIM_BATCH_WORK")]
    pub work: Option<PathBuf>,
}

impl PlaceArgs {
    /// The work folder: the one given, or X.work beside X.parquet.
    pub fn work_dir(&self) -> PathBuf {
        self.work.clone().unwrap_or_else(|| self.out.with_extension("work"))
    }
}

/// Refuses an output whose name does not end in `.parquet`, has nothing before it, or is that of the ledger of another output.
pub fn check_name(out: &Path) -> Result<(), Failure> {
    let refuse = |fact: &str| Err(Failure::Usage(anyhow!("--out {}: {fact}", out.display())));
    if out.extension().is_none_or(|extension| extension != "parquet") {
        return refuse("expected a name that ends in .parquet");
    }
    let stem = out.file_stem().unwrap_or_default().to_string_lossy();
    if stem == "." {
        return refuse("expected a name before .parquet");
    }
    if stem == "frames" || stem.ends_with(".frames") {
        return refuse("this is what the ledger of another output is called; give another name");
    }
    Ok(())
}

/// Refuses an output or a work folder among the cards or marks: the next run would take it for a session, or for a file of a
/// card.
pub fn check_apart(place: &PlaceArgs, study: &Study) -> Result<(), Failure> {
    for (option, path) in [("--out", &place.out), ("--work", &place.work_dir())] {
        for part in ["cards", "marks"] {
            check_outside(option, path, study, part)?;
        }
    }
    Ok(())
}

/// Refuses a folder for the marks of found rims that is a file or lies among the cards, and any where the settings do not ask
/// for rims to be found.
pub fn check_marks(folder: &Path, study: &Study) -> Result<(), Failure> {
    let refuse = |fact: &str| Err(Failure::Usage(anyhow!("--write-marks {}: {fact}", folder.display())));
    if !study.spec.marks.source.searches() {
        return refuse("nothing is looked for in pictures: give --marks auto or --marks both");
    }
    check_outside("--write-marks", folder, study, "cards")?;
    if folder.exists() && !folder.is_dir() {
        return refuse("there is a file of this name; expected a folder");
    }
    Ok(())
}

/// Refuses the value `path` of the flag `option` where it lies in this part of the study (`cards`, `marks`).
pub fn check_outside(option: &str, path: &Path, study: &Study, part: &str) -> Result<(), Failure> {
    let whole = whole(path);
    if study.dir.join(part).canonicalize().is_ok_and(|part| whole.starts_with(part)) {
        let path = path.display();
        return Err(Failure::Usage(anyhow!("{option} {path}: expected a place outside the study's {part}/")));
    }
    Ok(())
}

/// The absolute path, with links followed as far as it exists.
fn whole(path: &Path) -> PathBuf {
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let there =
        path.ancestors().find_map(|folder| Some((folder.canonicalize().ok()?, path.strip_prefix(folder).ok()?)));
    there.map_or_else(|| path.clone(), |(folder, rest)| folder.join(rest))
}
