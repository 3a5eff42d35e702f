//! Sessions surveyed into a temporary folder: nothing is written into the study, or beside it.

use std::num::NonZeroUsize;

use tempfile::TempDir;

use crate::session::SessionOptions;
use crate::study::SessionDir;

/// Settings of a survey.
#[derive(Debug, Clone)]
pub struct SurveyOptions {
    /// Worker threads; none for one per core that this process may use.
    pub jobs: Option<NonZeroUsize>,
    /// Program and version, for messages.
    pub program: String,
}

/// Why a survey stopped. What concerns one session never stops it.
#[derive(Debug, thiserror::Error)]
pub enum SurveyError {
    /// The temporary folder.
    #[error("cannot make a temporary folder: {0}; the environment variable TMPDIR says where")]
    TempDir(#[from] std::io::Error),
    /// The worker threads.
    #[error("cannot start the worker threads: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
}

/// The temporary folder of a survey; gone with all that is in it when this is dropped.
pub(crate) struct Survey {
    folder: TempDir,
    pub options: SessionOptions,
}

impl Survey {
    pub fn new(options: &SurveyOptions) -> Result<Self, SurveyError> {
        let folder = tempfile::Builder::new().prefix("aim-batch-survey-").tempdir()?;
        let options = SessionOptions {
            mcap_dir: folder.path().canonicalize()?,
            force: false,
            survey: true,
            program: options.program.clone(),
        };
        Ok(Self { folder, options })
    }

    /// Removes what was written of a session, so that the folder never holds more than the sessions at work.
    pub fn forget(&self, dir: &SessionDir) {
        let file = self.folder.path().join(format!("{}.mcap", dir.name));
        if let Err(error) = std::fs::remove_file(&file)
            && error.kind() != std::io::ErrorKind::NotFound
        {
            tracing::debug!(session = dir.name, "survey not removed yet: {error}");
        }
    }
}
