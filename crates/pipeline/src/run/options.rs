//! Settings of a run.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use crate::stop::Stop;

/// Settings of a run that are not the study's.
#[derive(Debug, Clone)]
pub struct RunOptions {
    /// Sessions at a time; none for [`default_jobs`](crate::default_jobs).
    pub jobs: Option<NonZeroUsize>,
    /// Bound of the images in memory at once, over all sessions at work. One image is always let through.
    pub image_memory_bytes: u64,
    /// Folder for what can be made anew: recordings and state.
    pub work_dir: PathBuf,
    /// Whether to do everything again, changed or not.
    pub force: bool,
    /// Whether to stop at the first session that fails.
    pub fail_fast: bool,
    /// Whether to delete what the work folder has of sessions that the study no longer has.
    pub prune: bool,
    /// Program and version, for provenance.
    pub program: String,
    /// Commit that the program was built from, where that is known.
    pub commit: Option<String>,
    /// A wish to stop.
    pub stop: Stop,
}

impl RunOptions {
    /// What readings and sizes were made by.
    pub(super) fn program_and_commit(&self) -> String {
        program_and_commit(&self.program, self.commit.as_deref())
    }
}

/// What readings and sizes were made by.
pub(crate) fn program_and_commit(program: &str, commit: Option<&str>) -> String {
    format!("{program} {}", commit.unwrap_or("unknown commit"))
}
