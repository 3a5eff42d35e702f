//! The error of a gallery that was not finished.

use std::path::PathBuf;

use crate::work::WorkError;

/// The error of a gallery that was not finished.
#[derive(Debug, thiserror::Error)]
pub enum GalleryError<E: std::error::Error + 'static> {
    /// The pictures cannot be made.
    #[error(transparent)]
    Halted(#[from] GalleryHalted),
    /// The sink refused a picture.
    #[error(transparent)]
    Sink(E),
}

/// The reason why no pictures can be made.
#[derive(Debug, thiserror::Error)]
pub enum GalleryHalted {
    /// There is no work folder to make them from.
    #[error("expected the work folder of the run, which holds the recordings: {}", .0.display())]
    NoWork(PathBuf),
    /// The work folder cannot be read.
    #[error(transparent)]
    Work(#[from] WorkError),
    /// The worker threads cannot be started.
    #[error("cannot start the worker threads: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// A signal came.
    #[error("stopped by a signal before all pictures were made")]
    Stopped {
        /// The number of the signal.
        signal: usize,
    },
}
