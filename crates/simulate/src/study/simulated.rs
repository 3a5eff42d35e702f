//! What a preset gives back.

use model::results::TruthRow;

/// What was written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Summary {
    /// Sessions.
    pub sessions: usize,
    /// Images that the marks refer to (and, if drawn, that are on the cards).
    pub images: usize,
    /// Files of marks.
    pub mark_files: usize,
}

/// A study that was written, and what is true of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Simulated {
    /// How much it is.
    pub summary: Summary,
    /// For `truth.parquet`: sessions in their order, images in the order of time, containers in that of their names; an image
    /// without a container has one row.
    pub truth: Vec<TruthRow>,
}
