//! Why there are no pictures.

use std::path::PathBuf;

use crate::work::WorkError;

/// Why there are no pictures.
#[derive(Debug, thiserror::Error)]
pub enum GalleryError<E: std::error::Error + 'static> {
    /// They cannot be made.
    #[error(transparent)]
    Halted(#[from] GalleryHalted),
    /// The sink refused one.
    #[error(transparent)]
    Sink(E),
}

/// Why no pictures can be made.
#[derive(Debug, thiserror::Error)]
pub enum GalleryHalted {
    /// There is nothing to make them from.
    #[error("expected the work folder of the run, which holds the recordings: {}", .0.display())]
    NoWork(PathBuf),
    /// It cannot be read.
    #[error(transparent)]
    Work(#[from] WorkError),
    /// The worker threads.
    #[error("cannot start the worker threads: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// A signal came.
    #[error("stopped by a signal before all pictures were made")]
    Stopped {
        /// Its number.
        signal: usize,
    },
}
