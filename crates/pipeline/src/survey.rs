//! Surveys sessions into a temporary folder. Nothing is written into the study, or beside it.

use std::num::NonZeroUsize;

use tempfile::TempDir;

use crate::parallel::in_parallel;
use crate::reporter::{Reporter, Totals};
use crate::session::SessionOptions;
use crate::stop::Stop;
use crate::study::{SessionDir, Study};

/// Settings of a survey.
#[derive(Debug, Clone)]
pub struct SurveyOptions {
    /// The number of worker threads; none for one per core that this process may use.
    pub jobs: Option<NonZeroUsize>,
    /// The program and its version, for messages.
    pub program: String,
    /// The wish to stop, from a signal or from inside.
    pub stop: Stop,
}

/// The reason why a survey stopped. What concerns one session never stops it.
#[derive(Debug, thiserror::Error)]
pub enum SurveyError {
    /// The temporary folder cannot be made.
    #[error("cannot make a temporary folder: {0}; the environment variable TMPDIR says where")]
    TempDir(#[from] std::io::Error),
    /// The worker threads cannot be started.
    #[error("cannot start the worker threads: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// A signal came.
    #[error("stopped by a signal before all sessions were looked at")]
    Stopped {
        /// The number of the signal.
        signal: usize,
    },
}

/// The temporary folder of a survey, which is gone with all its content when this is dropped.
pub(crate) struct Survey {
    folder: TempDir,
    pub options: SessionOptions,
}

impl Survey {
    pub fn new(options: &SurveyOptions) -> Result<Self, SurveyError> {
        let folder = tempfile::Builder::new().prefix("aim-batch-survey-").tempdir()?;
        let options = SessionOptions {
            mcap_dir: folder.path().canonicalize()?,
            survey: true,
            is_bench: false,
            program: options.program.clone(),
            stop: options.stop.clone(),
        };
        Ok(Self { folder, options })
    }

    /// The results of `one` for all sessions, in the order of their names, unless a signal comes.
    pub fn for_each_session<R: Send>(
        &self,
        study: &Study,
        jobs: Option<NonZeroUsize>,
        reporter: &dyn Reporter,
        one: impl Fn(&SessionDir) -> R + Sync + Send,
    ) -> Result<Vec<R>, SurveyError> {
        let stop = &self.options.stop;
        reporter.begin(&Totals { sessions: study.sessions.len(), ..Totals::default() });
        let results = in_parallel(&study.sessions, jobs, |dir| {
            let result = (!stop.is_set()).then(|| one(dir));
            self.forget(dir);
            result
        })?;
        match stop.signal() {
            Some(signal) => Err(SurveyError::Stopped { signal }),
            None => Ok(results.into_iter().flatten().collect()),
        }
    }

    /// Removes the file of a session, so that the folder never holds more than the sessions at work.
    fn forget(&self, dir: &SessionDir) {
        let file = self.folder.path().join(format!("{}.mcap", dir.name));
        if let Err(error) = std::fs::remove_file(&file)
            && error.kind() != std::io::ErrorKind::NotFound
        {
            tracing::debug!(session = dir.name, "survey not removed yet: {error}");
        }
    }
}
