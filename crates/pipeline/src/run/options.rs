//! Settings of a run.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use crate::stop::Stop;

/// Settings of a run that are not the study's.
#[derive(Debug, Clone)]
pub struct RunOptions {
    /// The number of sessions at a time; none for [`default_jobs`](crate::default_jobs).
    pub jobs: Option<NonZeroUsize>,
    /// The bound of the images in memory at once, over all sessions at work. One image is always let through.
    pub image_memory_bytes: u64,
    /// The work folder: recordings and state, which can all be made anew.
    pub work_dir: PathBuf,
    /// Whether to do everything again, whether it has changed or not.
    pub force: bool,
    /// Whether to stop at the first session that fails.
    pub fail_fast: bool,
    /// Whether to delete from the work folder the sessions that the study no longer has.
    pub prune: bool,
    /// The program and its version, for provenance.
    pub program: String,
    /// The commit that the program was built from, where that is known.
    pub commit: Option<String>,
    /// The wish to stop, from a signal or from inside.
    pub stop: Stop,
}

impl RunOptions {
    /// The program, its version and its commit: a part of every key of a stage.
    pub(super) fn program_and_commit(&self) -> String {
        program_and_commit(&self.program, self.commit.as_deref())
    }
}

/// The program, its version and its commit: a part of every key of a stage.
pub(crate) fn program_and_commit(program: &str, commit: Option<&str>) -> String {
    format!("{program} {}", commit.unwrap_or("unknown commit"))
}
