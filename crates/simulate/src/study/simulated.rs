//! The result of making a study.

use model::results::TruthRow;

/// The extent of a study that was written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Summary {
    /// Number of sessions.
    pub sessions: usize,
    /// Number of images that the marks refer to. They are on the cards where pictures are drawn.
    pub images: usize,
    /// Number of files of marks.
    pub mark_files: usize,
}

/// A study that was written, and its truth.
#[derive(Debug, Clone, PartialEq)]
pub struct Simulated {
    /// Its extent.
    pub summary: Summary,
    /// The rows of `truth.parquet`: sessions in their order, images in the order of time, containers in that of their names. An
    /// image without a container has one row.
    pub truth: Vec<TruthRow>,
}
