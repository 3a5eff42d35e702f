//! The arguments of `run`.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use crate::commands::place::PlaceArgs;
use crate::commands::settings::SettingsArgs;

/// The arguments of `run`. The headings are those of `aim-batch run --help`.
#[derive(Debug, clap::Args)]
pub struct RunArgs {
    /// Folder of the study (docs/study.md)
    pub study: PathBuf,
    /// Where results go, and what is kept between runs
    #[command(flatten)]
    pub place: PlaceArgs,
    /// Settings in place of study.toml's
    #[command(flatten)]
    pub settings: SettingsArgs,
    /// Also write the report to this folder: index.html, and the tables as CSV, Markdown and LaTeX
    #[arg(long, env = "AIM_BATCH_REPORT", help_heading = "Report and other output")]
    pub report: Option<PathBuf>,
    /// Also write the rims that were found as LabelMe files, DIR/auto/SESSION/IMAGE.json, to check and correct; files that are
    /// there stay as they are
    #[arg(long, value_name = "DIR", help_heading = "Report and other output")]
    pub write_marks: Option<PathBuf>,
    /// Also write recordings with marks, sizes and signals for Foxglove and Rerun (docs/viewers.md):
    /// WORK/annotated/SESSION.annotated.mcap
    #[arg(long, help_heading = "Report and other output")]
    pub annotate: bool,
    /// Sessions at a time; default: the cores that this process may use (affinity, control group, SLURM_CPUS_PER_TASK)
    #[arg(short, long, env = "AIM_BATCH_JOBS", help_heading = "Work and resources")]
    pub jobs: Option<NonZeroUsize>,
    /// Bound of all pictures in memory at once, such as 512M or 2G; one is always let through
    #[arg(long, env = "AIM_BATCH_MEMORY", value_name = "SIZE", default_value = "256M", value_parser = parse_bytes)]
    #[arg(help_heading = "Work and resources")]
    pub memory: u64,
    /// Do everything again, changed or not
    #[arg(long, help_heading = "Work and resources")]
    pub force: bool,
    /// Stop at the first session that fails; what was done is kept, and no results are written
    #[arg(long, help_heading = "Work and resources")]
    pub fail_fast: bool,
    /// Delete from the work folder what belongs to sessions that the study no longer has
    #[arg(long, help_heading = "Work and resources")]
    pub prune: bool,
    /// Compare the tables with those in this folder, and fail where they differ
    #[arg(long, value_name = "DIR", help_heading = "Check")]
    pub expect: Option<PathBuf>,
    /// Largest difference allowed by --expect: percentage points of an error, per cent of a size
    #[arg(long, value_name = "PCT", default_value_t = 0.15, requires = "expect", help_heading = "Check")]
    pub tolerance: f64,
}

/// The number of bytes that a text such as `512M` stands for; K, M, G and T are powers of 1024. Fails where the text is no
/// whole number with such a unit, or the number of bytes is zero or does not fit 64 bits.
fn parse_bytes(text: &str) -> Result<u64, String> {
    let text = text.trim();
    let digits = text.trim_end_matches(|c: char| !c.is_ascii_digit());
    let power = match text[digits.len()..].trim().to_ascii_uppercase().as_str() {
        "" | "B" => 0,
        "K" | "KB" | "KIB" => 1,
        "M" | "MB" | "MIB" => 2,
        "G" | "GB" | "GIB" => 3,
        "T" | "TB" | "TIB" => 4,
        _ => return Err("expected a number of bytes, or one with K, M, G or T, such as 512M".to_owned()),
    };
    let number: u64 = digits.parse().map_err(|_| "expected a whole number, such as 512M".to_owned())?;
    let bytes = number.checked_mul(1024_u64.pow(power)).filter(|bytes| *bytes > 0);
    bytes.ok_or_else(|| "expected between 1 and 16 million T".to_owned())
}

#[cfg(test)]
mod tests {
    use super::parse_bytes;

    #[test]
    fn sizes_with_and_without_a_unit() {
        assert_eq!(parse_bytes("1"), Ok(1));
        assert_eq!(parse_bytes("512M"), Ok(512 << 20));
        assert_eq!(parse_bytes("2 gib"), Ok(2 << 30));
        for wrong in ["", "M", "0", "-1", "1.5G", "2X", "99999999999T"] {
            assert!(parse_bytes(wrong).is_err(), "{wrong}");
        }
    }
}
